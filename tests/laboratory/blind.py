"""The blind test: draw cases, let the finder see the files alone, judge what it says."""

import json
import sys
from pathlib import Path

from .bench import Bench, Task, run
from .effects import EFFECTS, in_turn
from .marks import Marks, fingerprint
from .score import matrix, print_matrix, print_totals, totals


def blind_test(
    seed, cases, iwan, directory, effects=None, span=(1.0, 5.0), jobs=2, more=(), noise=None
):
    """Run the whole test afresh; returns and writes DIR/blind.json."""
    unknown = set(effects or []) - set(EFFECTS)
    if unknown:
        raise SystemExit(
            f"no such effect: {', '.join(sorted(unknown))}; known: {', '.join(EFFECTS)}"
        )
    names = in_turn(cases, effects)
    kind = f", noise {noise}" if noise else ""
    print(f"seed {seed}, {cases} cases, ratio {span[0]:g} to {span[1]:g}{kind}", flush=True)
    tasks = [Task(seed, j, (name,), span, noise) for j, name in enumerate(names)]
    lines = Path(directory) / "blind.jsonl"
    lines.unlink(missing_ok=True)
    with Marks(lines, seed, fingerprint(iwan)) as known:
        marked = run(tasks, Bench(iwan, directory, more), jobs, known)
    marks = [mark for mark in marked if "not_drawn" not in mark]
    not_drawn = [mark for mark in marked if "not_drawn" in mark]
    table, sums = matrix(marks), totals(marks)
    result = {
        "schema": "laboratory-blind/1",
        "seed": seed,
        "ratio": list(span),
        "noise": noise,
        "effects": sorted(set(names)),
        "totals": sums,
        "matrix": table,
        "cases": marks,
        "not_drawn": not_drawn,
    }
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
