"""Runs an archive in fmpy as scripts/platforms/host.c runs its library, and prints the same rows.

    python scripts/platforms/in_fmpy.py JOINT.fmu LOAD.txt values|slopes OUT.txt

LOAD.txt is as `load.py write` leaves it. First the archive is validated; exit status 1, with
what fmpy finds, where it finds a fault.
"""

import sys
from pathlib import Path

import fmpy
from fmpy.fmi2 import FMU2Slave
from fmpy.validation import validate_fmu
from load import SIGNALS, bits, read

ORDERS = [1, 2, 3]


def run(archive: str, load: list[list[float]], slopes: bool) -> list[list[float]]:
    """Every signal at every sample."""
    description = fmpy.read_model_description(archive)
    references = {v.name: v.valueReference for v in description.modelVariables}
    (known,) = [v.valueReference for v in description.modelVariables if v.causality == "input"]
    signals = [references[name] for name in SIGNALS]
    unit = FMU2Slave(
        guid=description.guid,
        unzipDirectory=fmpy.extract(archive),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="fmpy",
    )
    unit.instantiate()
    unit.setupExperiment(startTime=load[0][0])
    unit.enterInitializationMode()
    unit.setReal([known], [load[0][1]])
    unit.exitInitializationMode()
    rows = [unit.getReal(signals)]
    for (before, value, *derivatives), (now, end, *_) in zip(load, load[1:], strict=False):
        unit.setReal([known], [value if slopes else end])
        if slopes:
            unit.setRealInputDerivatives([known] * len(ORDERS), ORDERS, derivatives)
        unit.doStep(before, now - before)
        rows.append(unit.getReal(signals))
    unit.terminate()
    unit.freeInstance()
    return rows


def main() -> int:
    """Command line."""
    archive, load, way, out = sys.argv[1:]
    faults = validate_fmu(archive)
    if faults:
        print("\n".join(faults))
        return 1
    rows = run(archive, read(Path(load)), way == "slopes")
    Path(out).write_text("".join(" ".join(map(bits, row)) + "\n" for row in rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
