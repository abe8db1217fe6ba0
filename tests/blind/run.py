"""The blind test of every continuous-integration run: few cases, strong effects, fresh seed.

    python tests/blind/run.py --iwan target/release/iwan [--seed S] [--cases N] [--ratio R]

Prints its seed, so that a failure can be repeated; ends with status 1 when a bar is missed.
The bars are those of a finder that works, not of a lucky draw: each is compared with the upper
(or lower) end of the 95 % Wilson interval of what was seen, so that a few cases cannot condemn a
finder that is as good as the bar, while one that names at random fails.
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from laboratory.blind import blind_test  # noqa: E402
from laboratory.effects import FOREIGN  # noqa: E402
from laboratory.effects_catalogue import FIRST  # noqa: E402

# At five times the noise: least share in the stated set; most false alarms on clean cases; most
# foreign effects asserted to be explained. A diagnosis that fails is a defect whatever its case.
IN_SET, FALSE_ALARMS, WRONG_EXPLAINED = 0.9, 0.05, 0.34


def main():
    """Run, print, judge; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--iwan", required=True)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--cases", type=int, default=16)
    parser.add_argument("--ratio", type=float, default=5.0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("-o", "--output", default=None)
    asked = parser.parse_args()
    seed = int(time.time()) if asked.seed is None else asked.seed
    effects = []  # every second case is one of the catalogue, every fourth clean, every fourth not
    known, foreign = [effect.name for effect in FIRST], list(FOREIGN)
    for j in range(asked.cases):
        k = j // 4 + seed  # begins elsewhere for every seed, so that runs cover all effects
        effects.append(
            (known[(2 * k) % len(known)], "clean", known[(2 * k + 1) % len(known)],
             foreign[k % len(foreign)])[j % 4]
        )  # fmt: skip
    with tempfile.TemporaryDirectory() as scratch:
        result = blind_test(
            seed,
            asked.cases,
            Path(asked.iwan).resolve(),
            asked.output or scratch,
            effects,
            (asked.ratio, asked.ratio),
            asked.jobs,
        )
    sums = result["totals"]
    bars = [
        ("in stated set", sums["in_stated_set"], lambda i: i[1] >= IN_SET),
        ("false alarms", sums["false_alarms"], lambda i: i[0] <= FALSE_ALARMS),
        ("wrongly explained", sums["wrong_explained"], lambda i: i[0] <= WRONG_EXPLAINED),
    ]
    missed = [name for name, seen, holds in bars if seen["of"] and not holds(seen["interval"])]
    if sums["failed"]["count"]:
        missed.append("a diagnosis failed")
    if result["not_drawn"]:
        missed.append("a case could not be drawn")
    print(f"seed {seed}: " + (f"FAILED: {', '.join(missed)}" if missed else "passed"))
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
