"""How often the questions of tests/blind/run.py are passed, against what that file says.

python -m unittest blind.self_test          # in tests/
"""

import re
import unittest

from blind import run

LINE = re.compile(r"^ +(none|\d+ in \d+)" + 3 * r" +([\d.]+) % +([\d.]+)" + "$", re.MULTILINE)
SAID = ("effects in the stated set", "clean called clean", "foreign not explained")


def decided(question, rate):
    """(share of the runs that pass, cases in the mean) where this share of answers is wrong.

    Every way that a run may take, by the numbers of cases and of mistakes that lead there.
    """
    question.is_wrong = bool
    ways, passed, cases = {(0, 0, 0.0): 1.0}, 0.0, 0.0
    while ways:
        ahead = {}
        for start, share in ways.items():
            cases += share
            for wrong, odds in ((True, rate), (False, 1.0 - rate)):
                question.asked, question.mistakes, question.ratio = start
                question.answer(wrong)
                asked, mistakes, ratio = question.asked, question.mistakes, question.ratio
                if question.undecided():
                    # The order of the answers shows in the last digits of the ratio alone.
                    here = (asked, mistakes, round(ratio, 9))
                    ahead[here] = ahead.get(here, 0.0) + share * odds
                elif not question.failed():
                    passed += share * odds
        ways = ahead
    return passed, cases


class Questions(unittest.TestCase):
    def test_passes_and_cases_are_as_the_page_says(self):
        asked = {question.name: question for question in run.questions()}
        lines = LINE.findall(run.__doc__)
        self.assertGreaterEqual(len(lines), 8)
        for rate, *told in lines:
            wrong, of = (0, 1) if rate == "none" else map(int, rate.split(" in "))
            for name, share, count in zip(SAID, told[::2], told[1::2], strict=True):
                passed, cases = decided(asked[name], wrong / of)
                said = f"{name}, {rate}: {100 * passed:.2f} %, {cases:.2f}"
                self.assertAlmostEqual(100 * passed, float(share), delta=0.06, msg=said)
                self.assertAlmostEqual(cases, float(count), delta=0.06, msg=said)

    def test_a_finder_as_good_as_the_card_passes_and_a_broken_one_does_not(self):
        shares = {"effects in the stated set": 0.02, "clean called clean": 0.02}
        for question in run.questions():
            good = shares.get(question.name, 0.10)
            self.assertGreater(decided(question, good)[0], 0.99, question.name)
            self.assertLess(decided(question, 0.5)[0], 0.03, question.name)


if __name__ == "__main__":
    unittest.main()
