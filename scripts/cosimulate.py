"""Runs the exported FMU in fmpy over the measured records and draws it over the measurement.

    python scripts/cosimulate.py RESULT RECORD.csv...

RESULT is the folder that `iwan diagnose` wrote. Every sample of a record is one communication
point. Leaves cosimulation.svg there and the same picture inside report.html, between markers, so
that a second run replaces it. Exit status 1 where fmpy finds fault with the FMU, 2 on bad input.
"""

import argparse
import base64
import csv
import html
import json
import re
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

import fmpy
import fmpy.fmi2
import fmpy.validation
import matplotlib as mpl
import numpy as np

mpl.use("svg")
import matplotlib.pyplot as plt

# Units as the record format has them in brackets, in SI.
SI = {
    **{"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6},
    **{"N": 1.0, "kN": 1e3, "mN": 1e-3, "MN": 1e6, "lbf": 4.4482216152605, "dyn": 1e-5},
    **{"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9, "in": 0.0254},
}

# Colours of the report for the same things.
MEASURED, FMU = "#8a8f98", "#0072b2"

MARKERS = ("<!-- co-simulation -->", "<!-- /co-simulation -->")


class BadInput(Exception):
    """An input that cannot be used; the text says which and why."""


@dataclass
class Record:
    """A measured record in SI: time [s], force [N], displacement [m]."""

    name: str
    time: np.ndarray
    force: np.ndarray
    displacement: np.ndarray


@dataclass
class Run:
    """One record beside the FMU's answer, in the unit of the FMU's output."""

    record: Record
    measured: np.ndarray
    simulated: np.ndarray
    offset: float

    @property
    def difference(self) -> np.ndarray:
        """Measured minus simulated, the sensor's zero taken out."""
        return self.measured - self.simulated - self.offset


def read_record(path: Path) -> Record:
    """Reads one record; comments, any of three separators, units in brackets."""
    with path.open(encoding="utf-8-sig") as file:
        lines = [line for line in file if line.strip() and not line.lstrip().startswith("#")]
    if len(lines) < 2:
        raise BadInput(f"{path}: no samples")
    separator = max(",;\t", key=lines[0].count)
    rows = list(csv.reader(lines, delimiter=separator))
    columns = {}
    for index, title in enumerate(rows[0]):
        match = re.fullmatch(r"\s*(\w+)[^\[(]*[\[(]\s*(\S+?)\s*[\])]\s*", title)
        if match:
            columns[match[1].lower()] = (index, SI.get(match[2].replace("μ", "µ")))
    channels = {}
    for name in ("time", "force", "displacement"):
        index, scale = columns.get(name, (None, None))
        if scale is None:
            raise BadInput(f"{path}: no column `{name}` with a known unit among {rows[0]}")
        channels[name] = scale * np.array([float(row[index]) for row in rows[1:]])
    return Record(path.stem, **channels)


def simulate(fmu: Path, records: list[Record]) -> tuple[str, list[np.ndarray]]:
    """Output of the FMU at every sample of every record, and its name.

    The input set before a step is the value at the step's end: the joint answers the sequence of
    samples, so that output and measurement belong to the same instants.
    """
    description = fmpy.read_model_description(fmu)
    references = {v.name: v.valueReference for v in description.modelVariables}
    inputs = [v.name for v in description.modelVariables if v.causality == "input"]
    drive = "displacement" if "displacement" in inputs else "force"
    answer = "force" if drive == "displacement" else "displacement"
    unpacked = fmpy.extract(str(fmu))
    answers = []
    try:
        for record in records:
            driven = getattr(record, drive)
            answered = np.empty_like(driven)
            instance = fmpy.fmi2.FMU2Slave(
                guid=description.guid,
                unzipDirectory=unpacked,
                modelIdentifier=description.coSimulation.modelIdentifier,
                instanceName=record.name,
            )
            instance.instantiate()
            instance.setupExperiment(startTime=record.time[0])
            instance.enterInitializationMode()
            instance.setReal([references[drive]], [driven[0]])
            instance.exitInitializationMode()
            answered[0] = instance.getReal([references[answer]])[0]
            for i in range(1, len(driven)):
                instance.setReal([references[drive]], [driven[i]])
                instance.doStep(record.time[i - 1], record.time[i] - record.time[i - 1])
                answered[i] = instance.getReal([references[answer]])[0]
            instance.terminate()
            instance.freeInstance()
            answers.append(answered)
    finally:
        shutil.rmtree(unpacked, ignore_errors=True)
    return answer, answers


def compare(record: Record, answer: str, simulated: np.ndarray) -> Run:
    """Puts the answer beside the measurement; a record's zero is the sensor's, not the joint's."""
    measured = getattr(record, answer)
    return Run(record, measured, simulated, float(np.median(measured - simulated)))


def draw(runs: list[Run], answer: str, path: Path) -> None:
    """Per record: trajectory over the measurement, difference, hysteresis."""
    scale, unit = (1e6, "µm") if answer == "displacement" else (1.0, "N")
    mpl.rcParams.update(
        {"svg.fonttype": "none", "svg.hashsalt": "iwan", "font.size": 9, "axes.grid": True}
    )
    mpl.rcParams.update({"grid.alpha": 0.3, "path.simplify_threshold": 0.5})
    figure, axes = plt.subplots(
        3, len(runs), squeeze=False, figsize=(max(7.0, 5.0 * len(runs)), 9.0), layout="constrained"
    )
    for (trajectory, difference, loops), run in zip(axes.T, runs, strict=True):
        record, fmu = run.record, run.simulated + run.offset
        trajectory.set_title(record.name)
        trajectory.plot(record.time, scale * run.measured, color=MEASURED, lw=2.0, label="measured")
        trajectory.plot(record.time, scale * fmu, color=FMU, lw=0.8, label="FMU in fmpy")
        trajectory.set(xlabel="time [s]", ylabel=f"{answer} [{unit}]")
        trajectory.legend(loc="upper left")
        difference.plot(record.time, scale * run.difference, color="#1d2430", lw=0.6)
        difference.set(xlabel="time [s]", ylabel=f"measured − FMU [{unit}]")
        pair = (record.force, run.measured, fmu)
        if answer == "displacement":
            loops.plot(scale * pair[1], pair[0], color=MEASURED, lw=2.0)
            loops.plot(scale * pair[2], pair[0], color=FMU, lw=0.8)
            loops.set(xlabel=f"displacement [{unit}]", ylabel="force [N]")
        else:
            loops.plot(1e6 * record.displacement, pair[1], color=MEASURED, lw=2.0)
            loops.plot(1e6 * record.displacement, pair[2], color=FMU, lw=0.8)
            loops.set(xlabel="displacement [µm]", ylabel="force [N]")
    write(path, lambda part: figure.savefig(part, format="svg", metadata={"Date": None}))
    plt.close(figure)


def describe(runs: list[Run], answer: str, result: Path) -> list[str]:
    """One sentence per record, and what of the difference is not the joint's."""
    unit, scale = ("µm", 1e6) if answer == "displacement" else ("N", 1.0)
    sentences = []
    for run in runs:
        left = float(np.sqrt(np.mean(run.difference**2)))
        swing = float(np.std(run.measured))
        sentences.append(
            f"{run.record.name}: measured − FMU {scale * left:.3g} {unit} rms, "
            f"{100 * left / swing:.2g} % of the measured {answer} "
            f"({len(run.measured)} samples; offset {scale * run.offset:.3g} {unit} taken out)."
        )
    diagnosis = json.loads((result / "diagnosis.json").read_text(encoding="utf-8"))
    chain = [c["name"] for c in diagnosis["causes"] if c["kind"] == "measurement"]
    if chain:
        sentences.append(
            "The difference contains what the measuring chain adds, which is no part of the joint: "
            + ", ".join(chain)
            + "."
        )
    return sentences


def put_into_report(report: Path, picture: Path, sentences: list[str]) -> None:
    """Places the picture at the end of the report, or in place of an earlier one.

    As an image with its data inside: the page stays one file, and the picture's style rules and
    identifiers cannot touch the page's.
    """
    page = report.read_text(encoding="utf-8")
    data = base64.b64encode(picture.read_bytes()).decode("ascii")
    text = "".join(f"<p>{html.escape(sentence)}</p>\n" for sentence in sentences)
    section = (
        f'{MARKERS[0]}\n<section id="co-simulation">\n<h2>Co-simulation of joint.fmu</h2>\n{text}'
        f'<img style="max-width:100%" alt="FMU over the measurement" '
        f'src="data:image/svg+xml;base64,{data}">\n</section>\n{MARKERS[1]}\n'
    )
    begin, end = page.find(MARKERS[0]), page.find(MARKERS[1])
    if 0 <= begin < end:
        page = page[:begin] + section + page[end + len(MARKERS[1]) :].removeprefix("\n")
    else:
        places = [page.rfind(tag) for tag in ("<footer", "</main>", "</body>")]
        place = next((found for found in places if found >= 0), None)
        if place is None:
            raise BadInput(f"{report}: no </body> to place the co-simulation before")
        page = page[:place] + section + page[place:]
    write(report, lambda part: part.write_text(page, encoding="utf-8"))


def write(path: Path, fill) -> None:
    """Writes beside the target and renames, so that no half file is ever left."""
    part = path.with_name(path.name + ".part")
    fill(part)
    part.replace(path)


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("result", type=Path, help="folder written by `iwan diagnose`")
    parser.add_argument("records", type=Path, nargs="+", help="the measured records (CSV)")
    arguments = parser.parse_args()
    result = arguments.result
    fmu = result / "joint.fmu"
    try:
        problems = fmpy.validation.validate_fmu(str(fmu))
        for problem in problems:
            print(f"fmpy on {fmu}: {problem}", file=sys.stderr)
        if problems:
            return 1
        records = [read_record(path) for path in arguments.records]
        answer, answers = simulate(fmu, records)
        runs = [compare(r, answer, a) for r, a in zip(records, answers, strict=True)]
        draw(runs, answer, result / "cosimulation.svg")
        sentences = describe(runs, answer, result)
        put_into_report(result / "report.html", result / "cosimulation.svg", sentences)
    except (BadInput, OSError) as error:
        print(f"cosimulate: {error}", file=sys.stderr)
        return 2
    print("fmpy validates joint.fmu with no remark.")
    print("\n".join(sentences))
    return 0


if __name__ == "__main__":
    sys.exit(main())
