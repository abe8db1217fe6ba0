"""What is measured after the first tests: of the same case, through the same chain."""

import json
import tempfile
import unittest
from pathlib import Path

import numpy as np

from . import csvfile
from .bench import Task
from .case import record, stage_case, write_case
from .follow_up import DARED, _limits, measure_dummy, restage, run_load

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def read(path):
    """(time, force, displacement) of a record that the laboratory wrote in SI."""
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    table = [line.split(",") for line in lines if line[0] not in "#t"]
    return np.array(table, dtype=float).T


def written(folder, task):
    """The truth of a case on file: path and values."""
    write_case(folder, *task.draw())
    path = Path(folder) / "truth.json"
    return path, json.loads(path.read_text(encoding="utf-8"))


class Dummy(unittest.TestCase):
    def test_that_of_the_example_is_a_spring_and_noise(self):
        truth = EXAMPLES / "bolt_truth.json"
        told = json.loads(truth.read_text(encoding="utf-8"))
        with tempfile.TemporaryDirectory() as folder:
            _, force, displacement = read(measure_dummy(truth, folder))
        spring = np.polyfit(force, displacement, 1)
        left = np.std(displacement - np.polyval(spring, force))
        # The effect is the joint's: the dummy shows noise alone, that of the example's records.
        self.assertAlmostEqual(left / told["noise"]["response_rms"], 1.0, delta=0.1)
        joint = told["joint"]
        soft = 1.0 / joint["network_stiffness_N_per_m"] + 1.0 / joint["series_stiffness_N_per_m"]
        self.assertAlmostEqual(spring[0] / soft, 1.0, delta=0.01)

    def test_a_fault_of_the_chain_shows_in_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path, truth = written(folder, Task(5, 2, ("sensor_delay",), (5.0, 5.0)))
            time, force, displacement = read(measure_dummy(path, folder))
        late = truth["parameters"]["delay_s"]
        if truth["parameters"]["channel"] == "force":
            late = -late
        # displacement(t) = s force(t - late): to first order s force - s late dforce/dt.
        rows = np.column_stack([force, np.gradient(force, time)])
        (soft, back), *_ = np.linalg.lstsq(rows, displacement, rcond=None)
        self.assertAlmostEqual(-back / soft / late, 1.0, delta=0.2)


class Again(unittest.TestCase):
    def test_a_joint_that_goes_on_is_drawn_again_as_one(self):
        seed, number = 6, 1
        staged = stage_case(seed, number, "pinning", 3.0, goes_on=True)
        _, measured, _ = record(staged)
        truth = {"seed": seed, "case": number, "effect": "pinning", "ratio_asked": 3.0, **measured}
        again = restage(truth)
        self.assertTrue(again.scene.goes_on)
        for one, other in zip(staged.sampled.response, again.sampled.response, strict=True):
            np.testing.assert_array_equal(one, other)

    def test_a_zero_of_the_drive_stays_in_the_next_test(self):
        tasks = (Task(5, n, ("clean",), measurement="begun") for n in range(20))
        with tempfile.TemporaryDirectory() as folder:
            for task in tasks:
                path, truth = written(folder, task)
                if truth["drive"] == "force" and truth["beginning"]["way"] == "zero":
                    break
            else:
                self.fail("no zero of a force among twenty")
            time = np.linspace(0.0, 1.0, 201)
            force = 0.5 * truth["peak"] * np.sin(2.0 * np.pi * time)
            load = Path(folder) / "load.csv"
            style = {"force": "N", "length": "m", "swap": False}
            csvfile.write_record(load, time, force, 0.0 * force, style)
            _, read_force, _ = read(run_load(path, load, folder))
        zero = truth["beginning"]["reads_at_rest"]
        np.testing.assert_allclose(read_force - force, zero, atol=1e-6 * truth["peak"])

    def test_the_limit_that_is_told_is_no_multiple_of_full_slip(self):
        truth = {
            "files": [{"rates_Hz": [1.0], "duration_s": 5.0}],
            "drive": "force",
            "seed": 3,
            "peak": 40.0,
            "peak_share_of_full_slip": 0.4,
        }
        told = [_limits({**truth, "case": case}) for case in range(40)]
        self.assertEqual(told[0], _limits({**truth, "case": 0}))
        most = [float(words[words.index("--limit-force") + 1]) / 100.0 for words in told]
        self.assertTrue(DARED[0] <= min(most) < 0.83 and 0.92 < max(most) <= DARED[1])
        # A joint that bore more than that in the first tests bears it again.
        bold = _limits({**truth, "case": 0, "peak": 99.0, "peak_share_of_full_slip": 0.99})
        self.assertEqual(float(bold[bold.index("--limit-force") + 1]), 99.0)
