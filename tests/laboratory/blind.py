"""The blind test: draw cases, let the finder see the files alone, judge what it says."""

import json
import shutil
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from .case import draw_case, write_case
from .effects import EFFECTS, in_turn
from .score import Unreadable, failure, judge, matrix, print_matrix, print_totals, totals

LIMIT = 600.0  # [s] a diagnosis may take


def diagnose(iwan, records, folder, more=()):
    """Run the command line on the files alone; (diagnosis or None, reason, seconds)."""
    shutil.rmtree(folder, ignore_errors=True)
    began = time.monotonic()
    try:
        done = subprocess.run(
            [str(iwan), "diagnose", *map(str, records), "-o", str(folder), *more],
            capture_output=True,
            text=True,
            timeout=LIMIT,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return None, f"no answer in {LIMIT:.0f} s", LIMIT
    except OSError as error:
        return None, str(error), 0.0
    took = time.monotonic() - began
    if done.returncode != 0:
        return None, f"exit status {done.returncode}: {done.stderr.strip()[-300:]}", took
    try:
        return json.loads((folder / "diagnosis.json").read_text(encoding="utf-8")), None, took
    except (OSError, ValueError) as error:
        return None, f"diagnosis.json: {error}", took


def one_case(work):
    """Draw, diagnose and judge one case."""
    seed, number, name, span, iwan, directory, more = work
    folder = Path(directory) / f"case-{number:04d}"
    try:
        records, truth, style = draw_case(seed, number, name, span=span)
    except RuntimeError as reason:
        return {"case": number, "effect": name, "not_drawn": str(reason)}
    paths = write_case(folder, records, truth, style)
    diagnosis, reason, took = diagnose(iwan, paths, folder / "found", more)
    if diagnosis is None:
        marks = failure(truth, reason)
    else:
        try:
            marks = judge(truth, diagnosis)
        except (Unreadable, KeyError, TypeError, AttributeError) as broken:
            marks = failure(truth, f"contract: {broken!r}")
    marks.update(
        seconds=took,
        drive=truth["drive"],
        load=[f["kind"] for f in truth["files"]],
        coloured=truth["noise"]["lag_one_correlation"] > 0.0,
        law=truth["joint"]["law"],
    )
    return marks


def blind_test(seed, cases, iwan, directory, effects=None, span=(1.0, 5.0), jobs=2, more=()):
    """Run the whole test; returns and writes DIR/blind.json."""
    unknown = set(effects or []) - set(EFFECTS)
    if unknown:
        raise SystemExit(
            f"no such effect: {', '.join(sorted(unknown))}; known: {', '.join(EFFECTS)}"
        )
    names = in_turn(cases, effects)
    print(f"seed {seed}, {cases} cases, ratio {span[0]:g} to {span[1]:g}", flush=True)
    work = [(seed, j, name, span, iwan, directory, more) for j, name in enumerate(names)]
    marks, not_drawn = [], []
    with ProcessPoolExecutor(max_workers=jobs) as pool:
        for mark in pool.map(one_case, work):
            if "not_drawn" in mark:
                not_drawn.append(mark)
                continue
            marks.append(mark)
            said = mark["failed"] or f"{mark['verdict']} {' '.join(mark['named'])}"
            also = f" (or {', '.join(mark['ambiguous_with'])})" if mark["ambiguous_with"] else ""
            print(
                f"{mark['case']:4d} {mark['effect']:<24} x{mark['ratio']:.2f} "
                f"{mark['drive'][:5]} -> {said}{also}  {mark['seconds']:.1f} s",
                flush=True,
            )
    table, sums = matrix(marks), totals(marks)
    result = {
        "schema": "laboratory-blind/1",
        "seed": seed,
        "ratio": list(span),
        "effects": sorted(set(names)),
        "totals": sums,
        "matrix": table,
        "cases": marks,
        "not_drawn": not_drawn,
    }
    Path(directory).mkdir(parents=True, exist_ok=True)
    path = Path(directory) / "blind.json"
    path.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    print()
    print_matrix(table, sys.stdout)
    print()
    print_totals(sums, sys.stdout)
    if not_drawn:
        print(f"not drawn: {len(not_drawn)} (see {path})")
    print(f"seed {seed}")
    return result
