"""What scripts/demo.sh must leave: the files, a report of one piece, and the planted cause named.

python tests/demo/check.py RESULT
"""

import json
import re
import sys
import unittest
import zipfile
from pathlib import Path

RESULT = Path()
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


class Demo(unittest.TestCase):
    def setUp(self):
        self.report = (RESULT / "report.html").read_text(encoding="utf-8")
        self.diagnosis = json.loads((RESULT / "diagnosis.json").read_text(encoding="utf-8"))

    def test_no_unfinished_file_is_left(self):
        left = sorted(path.name for path in RESULT.iterdir())
        self.assertEqual([name for name in left if name.endswith(".part")], [])
        wanted = {
            "report.html",
            "diagnosis.json",
            "joint.json",
            "joint.fmu",
            "cosimulation.svg",
        }
        self.assertEqual(wanted - set(left), set())

    def test_the_archive_holds_the_joint_beside_it(self):
        with zipfile.ZipFile(RESULT / "joint.fmu") as archive:
            inside = json.loads(archive.read("resources/joint.json"))
        beside = json.loads((RESULT / "joint.json").read_text(encoding="utf-8"))
        for part in ("density", "series_stiffness", "causes"):
            self.assertEqual(inside[part], beside[part])

    def test_the_report_needs_no_other_file(self):
        outside = re.findall(
            r"""(?:src|href)\s*=\s*["'](?!data:|#)([^"']*)|@import|<link""", self.report
        )
        self.assertEqual(outside, [])

    def test_the_co_simulation_stands_in_the_report_once(self):
        self.assertEqual(self.report.count('id="co-simulation"'), 1)
        for record in sorted(EXAMPLES.glob("bolt-*.csv")):
            self.assertIn(f"{record.stem}: measured − FMU", self.report)

    def test_the_planted_cause_is_named(self):
        truth = json.loads((EXAMPLES / "bolt_truth.json").read_text(encoding="utf-8"))
        # Four times the noise in both records: another answer is a defect, not bad luck.
        named = [cause["name"] for cause in self.diagnosis["causes"]]
        self.assertEqual(named, [truth["effect"]])
        self.assertEqual(self.diagnosis["causes"][0]["ambiguous_with"], [])
        self.assertEqual(self.diagnosis["schema"], "iwan-diagnosis/1")

    def test_the_extension_predicts_unseen_data_better(self):
        ratio = self.diagnosis["gain"]["held_out_rms_ratio"]
        _, upper = self.diagnosis["gain"]["interval"]
        self.assertLess(ratio, 1.0)
        self.assertLess(upper, 1.0)


if __name__ == "__main__":
    RESULT = Path(sys.argv.pop(1))
    unittest.main()
