"""Runs measured records of others through the program and writes the numbers of docs/real-*.md.

Called by scripts/real_records.sh. What stands between the marks `<!-- numbers -->` and
`<!-- end of numbers -->` of a page is written here, the prose around it by hand.
"""

import argparse
import html
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import bouc_wen
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("IWAN_REAL_DATA") or ROOT.parent / "shared" / "data")
BEGIN, END = "<!-- numbers -->", "<!-- end of numbers -->"

DAMPER = DATA / "friction_damper_backlash"
FITTED = [
    f"D2_{hz}Hz30lbtension{stroke}amplitude" for hz in ("0.25", "0.5") for stroke in (0.5, 1.5)
]
UNSEEN = [
    f"D2_{hz}Hz30lbtension{stroke}amplitude"
    for hz, stroke in [("0.25", 1), ("0.5", 1), ("1", 0.5), ("1", 1), ("1", 1.5), ("2", 0.5)]
]


def say(text):
    """A line of progress."""
    print(text, file=sys.stderr, flush=True)


def diagnose(iwan, files, folder, options=()):
    """Runs one diagnosis; its findings with exit status and time."""
    say(f"iwan diagnose {' '.join(Path(f).name for f in files)} {' '.join(options)}")
    start = time.monotonic()
    command = [iwan, "diagnose", *map(str, files), "-o", str(folder), *options]
    run = subprocess.run(command, capture_output=True, text=True)
    found = {"status": run.returncode, "seconds": time.monotonic() - start, "folder": folder}
    found["options"] = " ".join(options)
    if run.returncode == 0:
        found |= json.loads((folder / "diagnosis.json").read_text())
    else:
        found["message"] = run.stderr.strip().splitlines()[-1]
    return found


def number(value):
    """Four digits."""
    return "not told" if value is None else f"{value:.4g}"


def present(cause):
    """Parameters of a cause without the refinements that the data do not ask for."""
    return [p for p in cause["parameters"] if p["name"] not in cause["absent"]]


def with_interval(parameter):
    """A parameter with its unit and interval."""
    text = f"{parameter['name']} {number(parameter['value'])} {parameter['unit']}"
    interval = parameter["interval"]
    return text + (f" ({number(interval[0])} … {number(interval[1])})" if interval else "")


def table(found):
    """The findings as a table of the page."""
    if found["status"] != 0:
        return f"Exit status {found['status']}: {found['message']}\n"
    before, after, gain = found["baseline"], found["extended"], found["gain"]
    unit = "" if found["unit"] == "1" else f" {found['unit']}"
    interval = gain["interval"]
    percent = [
        None if e["dissipation_error"] is None else 100 * e["dissipation_error"]
        for e in (before, after)
    ]
    rows = [
        ("verdict", f"`{found['verdict']}`"),
        ("judged", found["judged"]),
        ("noise", f"{number(found['noise']['rms'])}{unit}, {found['noise']['method']}"),
        ("error on unseen data, plain Iwan joint", f"{number(before['held_out_rms'])}{unit}"),
        ("error on unseen data, extended joint", f"{number(after['held_out_rms'])}{unit}"),
        (
            "ratio",
            number(gain["held_out_rms_ratio"])
            + (f" ({number(interval[0])} … {number(interval[1])})" if interval else ""),
        ),
        ("energy per cycle off by", " → ".join(f"{number(p)} %" for p in percent)),
        ("left of the explainable misfit", f"{100 * found['unexplained']['share']:.0f} %"),
        ("time", f"{found['seconds']:.1f} s"),
    ]
    for cause in reversed(found["causes"]):
        values = "; ".join(with_interval(p) for p in present(cause))
        rivals = cause["ambiguous_with"]
        values += f"; not told from {', '.join(rivals)}" if rivals else ""
        rows.insert(1, (f"cause `{cause['name']}` ({cause['kind']})", values))
    scored = sorted(found["candidates"], key=lambda c: -(c["evidence"] or 0))[:5]
    scored = [f"{c['name']} {c['evidence']:.0f}" for c in scored if (c["evidence"] or 0) > 0]
    rows.append(("log evidence of single causes", ", ".join(scored) or "none above the baseline"))
    lines = ["| | |", "|---|---|", *(f"| {name} | {value} |" for name, value in rows)]
    return "\n".join(lines) + "\n"


def figure(found, name, record, title):
    """Takes the drawing of that title of that record, or else of all records, out of the report."""
    if found["status"] != 0:
        return ""
    page = (found["folder"] / "report.html").read_text()
    parts = page.split(f"<h2>Record {record}</h2>")
    drawings = [
        drawing
        for part in (parts[-1], page)
        for drawing in re.findall(r"<b>([^<]*)</b>(?:(?!<b>).)*?(<svg.*?</svg>)", part, re.DOTALL)
    ]
    for caption, drawing in drawings:
        if html.unescape(caption) == title:
            path = ROOT / "docs" / "figures" / f"{name}.svg"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(drawing + "\n")
            return f"![{title} of {record}](figures/{name}.svg)\n"
    return ""


def write(page, text):
    """Puts the text between the marks of the page."""
    path = ROOT / "docs" / f"{page}.md"
    before = path.read_text()
    head, rest = before.split(BEGIN)
    tail = rest.split(END)[1]
    path.write_text(f"{head}{BEGIN}\n\n{text.strip()}\n\n{END}{tail}")


def record(name):
    """A record of the friction damper."""
    time_, displacement, force = np.loadtxt(
        DAMPER / f"{name}.csv", delimiter=",", comments="#", skiprows=3, unpack=True
    )
    return {"name": name, "time": time_, "displacement": displacement, "force": force}


def simulated(iwan, joint, name, folder):
    """The force of a joint under the displacement of a record."""
    out = folder / f"{name}.csv"
    command = [iwan, "simulate", str(joint), str(DAMPER / f"{name}.csv"), "-o", str(out)]
    subprocess.run([*command, "--drive", "displacement"], check=True, capture_output=True)
    return np.loadtxt(out, delimiter=",", skiprows=1)[:, 1]


def missed(measured, predicted):
    """rms without the mean: a load cell's offset is no property of a model."""
    error = measured - predicted
    return float(np.std(error))


def rivals(iwan, extended, folder):
    """Plain Iwan joint, extended joint and Bouc-Wen model, fitted to the same four records."""
    files = [str(DAMPER / f"{name}.csv") for name in FITTED]
    plain = folder / "plain.json"
    say("iwan identify on the same records")
    subprocess.run([iwan, "identify", *files, "-o", str(plain)], check=True, capture_output=True)
    say("Bouc-Wen model on the same records")
    predict, values = bouc_wen.fit([record(name) for name in FITTED])
    rows = []
    for name in FITTED + UNSEEN:
        measured = record(name)
        force = measured["force"]
        predicted = [
            simulated(iwan, plain, name, folder),
            simulated(iwan, extended["folder"] / "joint.json", name, folder),
            predict(measured),
        ]
        rows.append((name, force.std(), *(missed(force, p) for p in predicted)))
        say(f"{name}: " + ", ".join(f"{value:.0f} N" for value in rows[-1][1:]))
    lines = [
        "| record | use | force, rms | plain Iwan joint | extended joint | Bouc-Wen |",
        "|---|---|---|---|---|---|",
    ]
    for name, *numbers in rows:
        use = "fitted" if name in FITTED else "**unseen**"
        cells = " | ".join(f"{value:.0f} N" for value in numbers)
        lines.append(f"| {name.removeprefix('D2_')} | {use} | {cells} |")

    def whole(names, column):
        return float(np.sqrt(np.mean([row[column] ** 2 for row in rows if row[0] in names])))

    slow = [name for name in UNSEEN if "D2_0." in name]
    for label, names in [("unseen stroke, rates of the fit", slow), ("all unseen", UNSEEN)]:
        cells = " | ".join(f"{whole(names, column):.0f} N" for column in (1, 2, 3, 4))
        lines.append(f"| **{label}** | | {cells} |")
    ratio_plain = whole(UNSEEN, 3) / whole(UNSEEN, 2)
    ratio_rival = whole(UNSEEN, 3) / whole(UNSEEN, 4)
    lines += [
        "",
        f"Extended joint over plain Iwan joint, all unseen records: **{ratio_plain:.3f}**; "
        f"over Bouc-Wen: **{ratio_rival:.3f}**; on the unseen stroke at the rates of the fit: "
        f"**{whole(slow, 3) / whole(slow, 2):.3f}** and **{whole(slow, 3) / whole(slow, 4):.3f}**.",
        "",
        "Bouc-Wen: "
        + ", ".join(f"{name} = {value:.4g}" for name, value in values.items())
        + " (SI units).",
    ]
    return "\n".join(lines) + "\n"


def damper(iwan, out):
    """The friction damper with backlash."""
    found = diagnose(iwan, [DAMPER / f"{name}.csv" for name in FITTED], out / "damper")
    text = "### 30 lb, 0.25 and 0.5 Hz, 0.5 and 1.5 in together\n\n" + table(found)
    text += "\n" + figure(found, "real-friction-damper", FITTED[0], "Hysteresis")
    if found["status"] == 0:
        text += "\n### Prediction of other strokes and rates\n\n" + rivals(iwan, found, out)
    text += "\n### One record at each tension\n\n"
    text += "| record | verdict | causes | error on unseen data, before → after | time |\n"
    text += "|---|---|---|---|---|\n"
    for file in sorted(DAMPER.glob("D1_*.csv")):
        one = diagnose(iwan, [file], out / file.stem)
        if one["status"] != 0:
            text += f"| {file.stem} | exit {one['status']} | {one['message']} | | |\n"
            continue
        named = "; ".join(
            f"{c['name']} ("
            + ", ".join(f"{p['name']} {number(p['value'])} {p['unit']}" for p in present(c))
            + ")"
            for c in one["causes"]
        )
        errors = [one[key]["held_out_rms"] for key in ("baseline", "extended")]
        text += f"| {file.stem} | `{one['verdict']}` | {named or 'none'} "
        text += f"| {errors[0]:.0f} N → {errors[1]:.0f} N | {one['seconds']:.0f} s |\n"
    write("real-friction-damper", text)


def rubber(iwan, out):
    """The rubber bearing."""
    found = diagnose(iwan, sorted((DATA / "rubber_bearing").glob("*.csv")), out / "rubber")
    drawn = figure(found, "real-rubber-bearing", "bearing_three_amplitudes", "Hysteresis")
    write("real-rubber-bearing", table(found) + "\n" + drawn)


def mr_damper(iwan, out):
    """The magnetorheological damper."""
    found = diagnose(iwan, sorted((DATA / "mr_damper").glob("*.csv")), out / "mr")
    write(
        "real-mr-damper",
        table(found) + "\n" + figure(found, "real-mr-damper", "A_10", "Hysteresis"),
    )


def beam(iwan, out):
    """The bolted beam's amplitude table."""
    [file] = sorted((DATA / "brake_reuss_beam").glob("*.csv"))
    text = ""
    for label, name, options in [
        ("As it is", "beam", ()),
        (
            "With a modal mass of 1 kg (modal coordinates scaled to mass)",
            "beam-mass",
            ("--modal-mass", "1"),
        ),
    ]:
        found = diagnose(iwan, [file], out / name, options)
        text += f"### {label}\n\n{table(found)}\n"
        if found["status"] == 0:
            text += "".join(f"- {note}\n" for note in found["notes"]) + "\n"
            text += "".join(f"- {place}\n" for place in found["unexplained"]["where"]) + "\n"
        text += figure(found, f"real-{name}", file.stem, "Loss over amplitude") + "\n"
    write("real-beam-table", text)


def main():
    """Runs what the command line names; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--iwan", default=str(ROOT / "target" / "release" / "iwan"))
    parser.add_argument("--output", type=Path, default=ROOT / "result" / "real")
    parser.add_argument("only", nargs="*", help="damper, rubber, mr, beam; all by default")
    arguments = parser.parse_args()
    if not DATA.is_dir():
        say(f"{DATA} is not there: the records are no part of the repository, docs/real-*.md say")
        say("whose they are; IWAN_REAL_DATA names the folder that holds them")
        return 2
    arguments.output.mkdir(parents=True, exist_ok=True)
    pages = {"beam": beam, "mr": mr_damper, "damper": damper, "rubber": rubber}
    for name, page in pages.items():
        if not arguments.only or name in arguments.only:
            page(arguments.iwan, arguments.output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
