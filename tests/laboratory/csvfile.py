"""Record files: comma separated, units in the header, comments that give nothing away."""

import numpy as np

FORCE = {"N": 1.0, "kN": 1e3}
LENGTH = {"m": 1.0, "mm": 1e-3, "um": 1e-6}


def draw_style(rng):
    """Units and column order of one laboratory."""
    force = str(rng.choice(["N", "kN"], p=[0.75, 0.25]))
    length = str(rng.choice(["m", "mm", "um"], p=[0.6, 0.25, 0.15]))
    swap = bool(rng.random() < 0.2)
    return {"force": force, "length": length, "swap": swap}


def write_record(path, time, force, displacement, style, comments=(), digits=8):
    """One test as a file of the record contract; values in SI are converted to its units."""
    names = [f"force [{style['force']}]", f"displacement [{style['length']}]"]
    columns = [force / FORCE[style["force"]], displacement / LENGTH[style["length"]]]
    if style["swap"]:
        names.reverse()
        columns.reverse()
    with open(path, "w", encoding="utf-8") as out:
        for line in comments:
            out.write(f"# {line}\n")
        out.write(", ".join(["time [s]", *names]) + "\n")
        np.savetxt(out, np.column_stack([time, *columns]), fmt=f"%.{digits}g", delimiter=",")
