"""The card: what all marks of a folder say, as JSON, as drawings and as text for the README."""

import json
from pathlib import Path

from . import drawings, quality
from .follow_up import follow_up_totals
from .markdown import block
from .marks import read
from .noise import KINDS

MEASUREMENTS = ("power", "foreign", "clean", "pairs", "begun", "follow_up")
MARKERS = ("<!-- scorecard -->", "<!-- /scorecard -->")


class Mixed(Exception):
    """Marks of several finders or seeds do not make one card."""


def gather(directory):
    """(seed, finder, {measurement: marks}) of the marks in a folder."""
    headers, marks = [], {}
    for name in MEASUREMENTS:
        path = Path(directory) / f"{name}.jsonl"
        if path.exists():
            header, marks[name] = read(path)
            headers.append((header["seed"], header["finder"]))
    if len(set(headers)) != 1:
        raise Mixed(f"{directory} holds marks of {sorted(set(headers))}")
    return *headers[0], marks


def summarise(directory, commit=None):
    """Everything that is stated about the finder, as plain values."""
    seed, finder, marks = gather(directory)
    drawn = {k: [m for m in v if "not_drawn" not in m] for k, v in marks.items()}
    power, foreign = drawn.get("power", []), drawn.get("foreign", [])
    clean, two = drawn.get("clean", []), drawn.get("pairs", [])
    single = power + foreign + clean
    strengths = sorted({c["asked"][0] for c in power + foreign})
    return {
        "schema": "laboratory-scorecard/2",
        "seed": seed,
        "commit": commit,
        "finder": finder,
        "cases": {k: len(v) for k, v in drawn.items()},
        "not_drawn": {
            k: [[m["effect"], m["asked"][0]] for m in v if "not_drawn" in m]
            for k, v in marks.items()
        },
        "failed": [m["key"] for v in drawn.values() for m in v if m.get("failed")],
        "seconds": sum(m.get("seconds") or 0.0 for v in drawn.values() for m in v),
        "by_strength": {
            f"{s:g}": quality.rates([c for c in power + foreign if c["asked"][0] == s])
            for s in strengths
        },
        "power": quality.power(power),
        "false_alarms": quality.false_alarms(clean),
        "unknown": quality.unknowns(foreign),
        "pairs": quality.pairs(two),
        "begun": quality.begun(drawn.get("begun", [])),
        "calibration": quality.calibration(single),
        "separability": quality.separability(single),
        "parameters": quality.parameters(power),
        "held_out": quality.held_out(power),
        "follow_up": follow_up_totals(marks.get("follow_up", [])),
        "noise_kinds": list(KINDS),
    }


def draw(summary, directory):
    """matrix.svg, power.svg and reliability.svg."""
    directory = Path(directory)
    seed = summary["seed"]
    tables = [
        (f"misfit {s} of the noise, seed {seed}", one["matrix"])
        for s, one in summary["by_strength"].items()
    ]
    if tables:
        drawings.matrices(tables, directory / "matrix.svg")
        drawings.power(summary["power"], directory / "power.svg")
    calibration = summary["calibration"]
    diagrams = [
        ("First name, effects of the catalogue", calibration["first_name"]),
        ("First name, all cases", calibration["first_name_of_all_cases"]),
        ("Every candidate", calibration["every_candidate"]),
    ]
    drawings.reliability(diagrams, directory / "reliability.svg")


def card(directory, output=None, commit=None, readme=None, figures=None):
    """Write scorecard.json, scorecard.md and the drawings; fill the README's block if asked."""
    summary = summarise(directory, commit)
    output = Path(output or directory)
    output.mkdir(parents=True, exist_ok=True)
    text = json.dumps(summary, indent=1) + "\n"
    (output / "scorecard.json").write_text(text, encoding="utf-8")
    written = block(summary, figures)
    (output / "scorecard.md").write_text(written, encoding="utf-8")
    draw(summary, output)
    if figures:
        Path(figures).mkdir(parents=True, exist_ok=True)
        for name in ("matrix", "power", "reliability"):
            if (output / f"{name}.svg").exists():
                drawing = (output / f"{name}.svg").read_text(encoding="utf-8")
                target = Path(figures) / f"scorecard-{name}.svg"
                target.write_text(drawing, encoding="utf-8")
    if readme:
        fill(readme, written)
    return summary, written


def fill(readme, written):
    """Replace what stands between the markers of the README."""
    readme = Path(readme)
    text = readme.read_text(encoding="utf-8")
    begin, end = (text.index(marker) for marker in MARKERS)
    kept = text[: begin + len(MARKERS[0])], text[end:]
    readme.write_text(f"{kept[0]}\n{written}{kept[1]}", encoding="utf-8")
