"""Records of no virgin joint at zero: what is changed in them, and what is counted."""

import unittest

import numpy as np

from . import begun, plan, quality


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

    def test_as_many_clean_ones_as_with_an_effect_that_lasts(self):
        tasks = plan.begun(5, 1)
        names = [task.effects[0] for task in tasks]
        self.assertEqual(names.count("clean"), len(tasks) // 2)
        self.assertFalse(set(names) & set(begun.ONCE))
        self.assertEqual(len({task.number for task in tasks + plan.begun(5, 0)}), 2 * len(tasks))

    def test_totals_are_of_clean_ones_and_planted_ones_apart(self):
        clean = {"known": False, "false_alarm": True, "beginning": "cut"}
        right = {"known": True, "alone": True, "in_set": True, "wrong_name": False}
        told = quality.begun([clean, {**right, "beginning": "cut"}, {**right, "beginning": "zero"}])
        self.assertEqual(told["cut"]["false_alarms"]["count"], 1)
        self.assertEqual(told["cut"]["false_alarms"]["of"], 1)
        self.assertEqual(told["zero"]["false_alarms"]["of"], 0)
        self.assertEqual(told["cut"]["right_alone"]["count"], 1)
