"""The blind test of every continuous-integration run: strong effects only, a fresh seed.

    python tests/blind/run.py --iwan target/release/iwan [--seed S] [--ratio R] [--jobs N]

Every effect leaves five times the noise after the best refit of an ideal joint: a wrong answer is
a defect, not bad luck. Still a single wrong answer condemns nobody, because a law of the
laboratory may differ from the catalogue's by more than the noise. Three questions are put, each by
Wald's sequential test between a finder that works and one that does not:

    question                                     wrong answers of a working  of a broken finder
    a catalogue effect: in the stated set?                           1 in 33             2 in 5
    a clean record: called clean?                                    1 in 50             2 in 5
    a foreign effect: not asserted explained?                        9 in 20           19 in 20

A right answer adds log((1 - broken)/(1 - working)) to the log-likelihood ratio, a wrong one
log(broken/working); cases are drawn until it leaves (log BETA, -log ALPHA). By Wald's bounds a
working finder fails a question in less than ALPHA = 1/4000 of all runs, hence a run in less than
3/4000, and one that names three effects of five passes in less than BETA = 1/300. The tests of a
working finder need about 15, 13 and 6 cases. What stands under `working` must be no better than
what scripts/scorecard.sh measures at this ratio; otherwise the promise does not hold.

The same seed puts the same cases. Ends with status 1 when a question is failed, a diagnosis fails
or breaks its contract, or a case cannot be drawn.
"""

import argparse
import json
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from math import ceil, log
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from laboratory.bench import Bench, Task  # noqa: E402
from laboratory.effects import FOREIGN  # noqa: E402
from laboratory.effects_catalogue import FIRST  # noqa: E402
from laboratory.quality import calibration, parameters, separability  # noqa: E402
from laboratory.score import matrix, print_matrix, print_totals, totals  # noqa: E402

ALPHA, BETA = 1 / 4000, 1 / 300
MOST = 60  # cases of one question; undecided by then is decided by the likelier


class Question:
    """One sequential test over the cases of one kind."""

    def __init__(self, name, effects, working, broken, is_wrong):
        self.name, self.effects, self.is_wrong = name, effects, is_wrong
        self.right = log((1 - broken) / (1 - working))
        self.wrong = log(broken / working)
        self.ratio, self.asked, self.mistakes = 0.0, 0, 0

    def undecided(self):
        """True while more cases are needed."""
        return log(BETA) < self.ratio < -log(ALPHA) and self.asked < MOST

    def failed(self):
        """True where the broken finder is the better account."""
        return self.ratio > 0.0

    def still(self):
        """Cases after which it may first be decided well, and never fewer than it takes."""
        return min(ceil((log(BETA) - self.ratio) / self.right), MOST - self.asked)

    def answer(self, mark):
        """Takes one case; none after the decision, so that the order of work changes nothing."""
        if self.undecided():
            self.asked += 1
            wrong = self.is_wrong(mark)
            self.mistakes += wrong
            self.ratio += self.wrong if wrong else self.right


def questions():
    """The three questions."""
    known = [effect.name for effect in FIRST]
    return [
        Question("effects in the stated set", known, 0.03, 0.40, lambda m: not m["in_set"]),
        Question("foreign not explained", [*FOREIGN], 0.45, 0.95, lambda m: m["wrong_explained"]),
        Question("clean called clean", ["clean"], 0.02, 0.40, lambda m: m["false_alarm"]),
    ]


def run(seed, iwan, ratio, jobs, folder):
    """Puts the questions; (questions, marks of the cases, cases that could not be drawn)."""
    asked, marks, not_drawn = questions(), [], []
    drawn = [0] * len(asked)
    bench = Bench(iwan, folder)
    with ProcessPoolExecutor(max_workers=jobs) as pool:
        while any(question.undecided() for question in asked):
            work, owners = [], []
            for kind, question in enumerate(asked):
                for _ in range(question.still() if question.undecided() else 0):
                    number = len(asked) * drawn[kind] + kind
                    # Begins elsewhere for every seed, so that runs cover all effects.
                    effect = question.effects[(seed + drawn[kind]) % len(question.effects)]
                    work.append(Task(seed, number, (effect,), (ratio, ratio)))
                    owners.append(question)
                    drawn[kind] += 1
            for question, mark in zip(owners, pool.map(bench, work), strict=True):
                if "not_drawn" in mark:
                    print(f"case {mark['case']}: {mark['not_drawn']}", flush=True)
                    not_drawn.append(mark)
                    question.asked += 1
                    continue
                said = mark["failed"] or " ".join([mark["verdict"], *mark["named"]])
                print(f"{mark['case']:4d} {mark['effect']:<20} -> {said}", flush=True)
                marks.append(mark)
                question.answer(mark)
    return asked, marks, not_drawn


def main():
    """Run, print, judge; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--iwan", required=True)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--ratio", type=float, default=5.0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("-o", "--output", default=None, help="keep records and findings here")
    given = parser.parse_args()
    seed = int(time.time()) if given.seed is None else given.seed
    iwan = Path(given.iwan).resolve()
    print(f"seed {seed}, misfit after refit {given.ratio:g} times the noise", flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(given.output or scratch)
        asked, marks, not_drawn = run(seed, iwan, given.ratio, given.jobs, folder)
        (folder / "blind.json").write_text(json.dumps(marks, indent=1) + "\n", encoding="utf-8")
    print()
    print_matrix(matrix(marks), sys.stdout)
    print()
    print_totals(totals(marks), sys.stdout)
    # Too few to be judged by; told so that a run shows where these stand.
    error = calibration(marks)["first_name"]["expected_error"]
    figures = parameters(marks)["same_law"]
    print_totals(
        {
            "expected_error_of_probability": error,
            "median_error_of_parameters": figures["median_error"],
            "intervals_that_hold_the_truth": figures["covered"],
            "single_name_right": separability(marks)["single_name_right"],
        },
        sys.stdout,
    )
    print()
    missed = [question.name for question in asked if question.failed()]
    for question in asked:
        wrong = f"{question.mistakes} wrong of {question.asked}"
        print(f"{question.name:<28} {wrong}: {'FAILED' if question.failed() else 'passed'}")
    if any(mark["failed"] for mark in marks):
        missed.append("a diagnosis failed")
    if not_drawn:
        missed.append("a case could not be drawn")
    print(f"seed {seed}: " + (f"FAILED: {', '.join(missed)}" if missed else "passed"))
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
