"""Records of no virgin joint at zero: what is changed in them, and what is counted."""

import unittest

import numpy as np

from . import begun, joints, loads, plan, quality, rig
from .refit import Baseline
from .scene import UNLOADING, Scene


class Begun(unittest.TestCase):
    def test_files_are_cut_with_their_noise_or_moved_by_one_zero(self):
        time = np.arange(200) * 0.1
        drive, response = np.sin(time), np.cos(time)
        records = [(time, 2.0 * drive, response), (time, drive, response)]
        heard = [(time, np.full(200, float(j))) for j in range(2)]
        truth, ways = {"drive": "force", "heard": heard}, set()
        for number in range(12):
            changed, told = begun.begin(5, number, records, truth)
            ways.add(told["beginning"]["way"])
            if told["beginning"]["way"] == "cut":
                for before, after, heard in zip(records, changed, told["heard"], strict=True):
                    self.assertTrue(120 <= len(after[0]) <= 180)
                    np.testing.assert_array_equal(after[0], before[0][-len(after[0]) :])
                    np.testing.assert_array_equal(heard[0], after[0])
                continue
            zero = told["beginning"]["reads_at_rest"]
            self.assertTrue(0.1 <= abs(zero) / 2.0 <= 0.301)
            for before, after in zip(records, changed, strict=True):
                np.testing.assert_allclose(after[1] - before[1], zero)
                np.testing.assert_array_equal(after[2], before[2])
        self.assertEqual(ways, {"cut", "zero"})

    def test_a_joint_that_goes_on_is_one_joint_under_one_long_test(self):
        joint = joints.draw_joint(np.random.default_rng(3))
        time = np.arange(401) * 0.01
        levels = (0.6, 0.4)
        files = [
            loads.History(time, level * np.sin(3.0 * time), 1, "sine", [0.5]) for level in levels
        ]
        scene = Scene.stage(joint, files, False, 1e-5, goes_on=True)
        ends = [1e-5 * file.command[-1] for file in files]
        way = np.linspace(ends[0], 0.0, UNLOADING + 1)[1:]
        command = np.concatenate([1e-5 * files[0].command, way, 1e-5 * files[1].command[1:]])
        long = rig.drive(joint, 0.01 * np.arange(len(command)), command, False)
        np.testing.assert_allclose(scene.clean[1].force[1:], long.force[-400:], rtol=1e-6)
        # A virgin joint answers otherwise: its refit leaves more.
        drives, answers = ([getattr(t, k) for t in scene.clean] for k in ("displacement", "force"))
        leaves = [Baseline(drives, False, goes_on).misfit(answers) for goes_on in (True, False)]
        self.assertLess(leaves[0], 0.5 * leaves[1])

    def test_as_many_clean_ones_as_with_an_effect(self):
        tasks = plan.begun(5, 1)
        names = [task.effects[0] for task in tasks]
        self.assertEqual(names.count("clean"), len(tasks) // 2)
        changed = {task.effects[0] for task in tasks if not task.goes_on}
        self.assertFalse(changed & set(begun.ONCE))
        self.assertEqual(sum(task.goes_on for task in tasks), len(tasks) // 2)
        self.assertEqual(len({task.number for task in tasks + plan.begun(5, 0)}), 2 * len(tasks))

    def test_totals_are_of_clean_ones_and_planted_ones_apart(self):
        clean = {"known": False, "false_alarm": True, "beginning": "cut"}
        right = {"known": True, "alone": True, "in_set": True, "wrong_name": False}
        told = quality.begun([clean, {**right, "beginning": "cut"}, {**right, "beginning": "zero"}])
        self.assertEqual(told["cut"]["false_alarms"]["count"], 1)
        self.assertEqual(told["cut"]["false_alarms"]["of"], 1)
        self.assertEqual(told["zero"]["false_alarms"]["of"], 0)
        self.assertEqual(told["cut"]["right_alone"]["count"], 1)
