"""The parts that measure the finder, checked against answers known beforehand."""

import contextlib
import io
import json
import sys
import tempfile
import unittest
import xml.etree.ElementTree as tree
from pathlib import Path

import numpy as np

from . import loads, parameters, plan, quality
from .bench import Bench, Task, run
from .case import Gauge, Sampled
from .effects import CATALOGUE, FOREIGN
from .follow_up import follow_up_totals
from .joints import draw_joint
from .marks import Foreign, Marks, read
from .noise import KINDS, Noise
from .observed import observe, ranking
from .pair import Together, candidates, draw_names, likeness, places
from .scene import Scene
from .score import judge
from .scorecard import MARKERS, card

# The interpreter's own path may hold spaces, which no first line of a script can.
LAUNCHER = """#!/bin/sh
exec '{python}' "$0.py" "$@"
"""
FINDER = """import json, pathlib, sys
out = pathlib.Path(sys.argv[sys.argv.index("-o") + 1])
out.mkdir(parents=True)
(out / "diagnosis.json").write_text(json.dumps({said}))
"""


def estimate(value, half):
    return {"value": value, "interval": [value - half, value + half], "unit": "1"}


def diagnosis(*causes, verdict="explained", probability=0.9, judged="displacement"):
    """What a finder might say; `causes` are names, or names with what they may be instead."""
    named = [(c, []) if isinstance(c, str) else (c[0], list(c[1:])) for c in causes]
    listed = [
        {
            "name": name,
            "probability": probability if [name] == [n for n, _ in named[:1]] else 0.0,
            "evidence": -float(j),
            "lambda_sep": 30.0,
        }
        for j, name in enumerate(CATALOGUE)
    ]
    return {
        "schema": "iwan-diagnosis/1",
        "verdict": verdict,
        "judged": judged,
        "causes": [
            {
                "name": name,
                "ambiguous_with": rivals,
                "parameters": [{"name": "delay", **estimate(1.04e-3, 1e-4)}],
            }
            for name, rivals in named
        ],
        "candidates": listed,
        "separability": [],
        "noise": {"rms": 1.1e-9},
        "baseline": {"held_out_rms": 3e-9},
        "extended": {"held_out_rms": 1.02e-9},
    }


def truth(effect="sensor_delay", **more):
    return {
        "case": 0,
        "effect": effect,
        "in_catalogue": effect in CATALOGUE,
        "ratio_achieved": 1.0,
        "drive": "force",
        "noise": {"realised_rms": 1e-9},
        "parameters": {"delay_s": 1e-3, "channel": "displacement"},
        **more,
    }


def pair_truth():
    two = {
        "effects": ["pinning", "sensor_delay"],
        "kinds": ["joint", "measurement"],
        "ratio_together": 2.9,
        "ratios_achieved": [2.0, 2.0],
        "likeness": 0.05,
    }
    one = truth(**two)
    del one["effect"]
    return one


def mark(effect, said, measurement="power", strength=1.0, **more):
    told = truth(effect)
    return {
        "measurement": measurement,
        "asked": [strength, strength],
        **judge(told, said),
        **observe(told, said),
        "parameters": told["parameters"],
        "law": "lognormal",
        "drive": "force",
        "coloured": False,
        "noise_asked": "white",
        "seconds": 1.0,
        **more,
    }


def small_scene(seed, by_force=True):
    rng = np.random.default_rng(seed)
    joint = draw_joint(rng)
    history = loads.stepped(rng, [3.0], 60.0, "sine", False, 0.0)
    peak = 0.7 * (joint.full_slip if by_force else joint.full_slip / joint.series)
    return Scene.stage(joint, [history], by_force, peak), rng


class Kinds(unittest.TestCase):
    def test_every_kind_has_its_rms_and_its_own_trait(self):
        load = np.sin(np.linspace(0.0, 400.0 * np.pi, 100_000))
        for kind in KINDS:
            rng = np.random.default_rng(1)
            x = np.concatenate([*Noise.of(kind, 0.5).files(rng, 2.0, [load, 0.5 * load])])
            both = np.abs(np.concatenate([load, 0.5 * load]))
            quiet, loud = np.std(x[both < 0.1]), np.std(x[both > 0.9])
            outside = np.mean(np.abs(x) > 8.0)  # of four deviations: 6e-5 of a Gaussian
            lag, far = (np.corrcoef(x[k:], x[:-k])[0, 1] for k in (1, 10))
            middle = np.subtract(*np.percentile(x, [75, 25])) / 1.349
            self.assertEqual(lag > 0.85, kind == "autoregressive", kind)
            self.assertEqual(loud > 3.0 * quiet, kind == "load_dependent", kind)
            self.assertEqual(outside > 5e-3, kind == "outliers", kind)
            # Of first-order noise it is the tenth power.
            self.assertEqual(
                far > 2.0 * max(lag, 0.1) ** 10 and far > 0.05, kind == KINDS[-1], kind
            )
            # Outliers come on top: it is the noise of the others that is as given.
            size = middle if kind == "outliers" else np.std(x)
            self.assertAlmostEqual(size, 2.0, delta=0.06, msg=kind)
        with self.assertRaises(ValueError):
            Noise.of("pink", 0.0)

    def test_without_a_kind_the_noise_is_as_drawn(self):
        self.assertEqual(Noise.of(None, 0.0), Noise("white", 0.0))
        self.assertEqual(Noise.of(None, 0.7), Noise("autoregressive", 0.7))


class Pairs(unittest.TestCase):
    def test_two_effects_at_once_are_each_when_the_other_vanishes(self):
        scene, rng = small_scene(4)
        for names in (("pinning", "clearance"), ("preload_loss", "ac_coupling")):
            one, other = (CATALOGUE[name](scene, rng) for name in names)
            one.strength = other.strength = 0.05
            both = Sampled(scene, scene.play(Together(one, other)), Together(one, other))
            for alone, vanishing in ((one, other), (other, one)):
                kept, vanishing.strength = vanishing.strength, 0.0
                pair = Together(one, other)
                together = Sampled(scene, scene.play(pair), pair).displacement[0]
                single = Sampled(scene, scene.play(alone), alone).displacement[0]
                size = np.max(np.abs(single))
                np.testing.assert_allclose(together, single, atol=2e-9 * size, err_msg=str(names))
                self.assertGreater(np.max(np.abs(both.displacement[0] - single)), 1e-5 * size)
                vanishing.strength = kept

    def test_pairs_act_at_two_places_and_are_drawn_from_the_seed(self):
        mixed, within = candidates()
        self.assertEqual(len(mixed), 15 * 8)
        for one, other in mixed + within:
            self.assertFalse(places(CATALOGUE[one]) & places(CATALOGUE[other]))
        drawn = [draw_names(11, n) for n in range(9)]
        self.assertEqual(drawn, [draw_names(11, n) for n in range(9)])
        for number, names in enumerate(drawn):
            self.assertIn(names, within if number % 3 == 2 else mixed)
        scene, rng = small_scene(4)
        with self.assertRaises(ValueError):
            Together(CATALOGUE["clearance"](scene, rng), CATALOGUE["creep"](scene, rng))

    def test_likeness_is_the_cosine_of_two_traces(self):
        scene, rng = small_scene(4)
        gauge = Gauge(scene)
        drift = CATALOGUE["displacement_drift"](scene, rng)
        drift.strength = 0.1
        left, _ = gauge(drift)
        drift.strength = 0.2
        twice, _ = gauge(drift)
        # Not exactly: what the refit may take is bounded by signs, and bounds do not scale.
        self.assertAlmostEqual(likeness(left, left, twice), 1.0, delta=0.1)
        self.assertAlmostEqual(likeness(3.0, 4.0, 5.0), 0.0)

    def test_marks_of_pairs(self):
        def judged(*causes, verdict="explained"):
            return judge(pair_truth(), diagnosis(*causes, verdict=verdict))

        exact = judged("sensor_delay", "pinning")
        self.assertTrue(exact["both"] and exact["both_alone"] and exact["both_by_name"])
        by_set = judged(("viscous_damping", "sensor_delay"), "pinning")
        self.assertTrue(by_set["both_alone"] and not by_set["both_by_name"])
        self.assertEqual(by_set["needless"], 0)
        # One name that may be either is one statement, not two.
        either = judged(("pinning", "sensor_delay"))
        self.assertFalse(either["both"])
        self.assertEqual(len(either["covered"]), 2)
        third = judged("pinning", "sensor_delay", "mains_hum")
        self.assertTrue(third["both"] and not third["both_alone"] and third["third"])
        self.assertEqual(third["needless"], 1)
        half = judged("pinning", "mains_hum")
        self.assertFalse(half["both"])
        self.assertEqual((half["covered"], half["needless"]), (["pinning"], 1))
        self.assertTrue(judged(verdict="clean")["missed"])


def counted(task):
    """Work that leaves a trace of having been done."""
    with Path(task.effects[0]).open("a", encoding="utf-8") as out:
        out.write(f"{task.number}\n")
    return {"case": task.number}


class Resuming(unittest.TestCase):
    def test_what_is_marked_is_not_done_again(self):
        with tempfile.TemporaryDirectory() as folder:
            done, path = Path(folder) / "done", Path(folder) / "marks.jsonl"
            tasks = [Task(1, n, (str(done),)) for n in range(4)]
            with contextlib.redirect_stdout(io.StringIO()), Marks(path, 1, "abc") as marks:
                run(tasks[:2], counted, 1, marks, str)
                with self.assertRaises(Foreign):  # a second run at the same time
                    Marks(path, 1, "abc")
            with path.open("a", encoding="utf-8") as out:
                out.write('{"key": "cut sh')  # interrupted while writing
            with contextlib.redirect_stdout(io.StringIO()) as told, Marks(path, 1, "abc") as known:
                marks = run(tasks, counted, 1, known, str)
            self.assertIn("2 of 4 cases are already marked", told.getvalue())
            self.assertEqual([m["case"] for m in marks], [0, 1, 2, 3])
            self.assertEqual(sorted(done.read_text().split()), ["0", "1", "2", "3"])
            self.assertEqual(len(read(path)[1]), 4)
            with self.assertRaises(Foreign):
                Marks(path, 1, "another finder")
            with self.assertRaises(Foreign):
                Marks(path, 2, "abc")

    def test_no_two_cases_of_a_scorecard_share_a_scene(self):
        tasks = [t for turn in range(3) for one in plan.PLANS.values() for t in one(1, turn)]
        self.assertEqual(len({t.number for t in tasks}), len(tasks))
        self.assertEqual(len({t.key for t in tasks}), len(tasks))
        hidden = {(t.effects[0], t.span[0]) for t in tasks if t.measurement == "power"}
        self.assertEqual(len(hidden), len(CATALOGUE) * len(plan.STRENGTHS))
        self.assertEqual({t.noise for t in tasks if t.measurement == "clean"}, set(KINDS))

    def test_the_bench_draws_asks_and_judges(self):
        with tempfile.TemporaryDirectory() as folder:
            finder = Path(folder) / "finder"
            said = diagnosis("displacement_drift")
            finder.write_text(LAUNCHER.format(python=sys.executable), encoding="utf-8")
            script = finder.with_name("finder.py")
            script.write_text(FINDER.format(said=said), encoding="utf-8")
            finder.chmod(0o755)
            bench = Bench(str(finder), folder, keep=False)
            got = bench(Task(5, 7, ("displacement_drift",), (2.0, 2.0), "outliers"))
            self.assertIsNone(got["failed"])
            self.assertTrue(got["alone"])
            self.assertEqual((got["noise"], got["asked"]), ("outliers", [2.0, 2.0]))
            self.assertEqual(got["ranks"], {"displacement_drift": 1})
            self.assertFalse((Path(folder) / "case-0007").exists())
            json.dumps(got)


class Quality(unittest.TestCase):
    def test_ranking_is_by_probability_then_evidence(self):
        order = ranking(
            {
                "candidates": [
                    {"name": "a", "probability": 0.0, "evidence": 5.0},
                    {"name": "b", "probability": 0.7, "evidence": 1.0},
                    {"name": "c", "probability": 0.0, "evidence": None},
                    {"name": "d", "probability": 0.0, "evidence": 9.0},
                ]
            }
        )
        self.assertEqual(order, ["b", "d", "a", "c"])

    def test_reliability_of_a_calibrated_and_of_a_boasting_finder(self):
        honest = [(0.75, j % 4 != 0) for j in range(40)] + [(0.05, j % 20 == 0) for j in range(60)]
        self.assertAlmostEqual(quality.reliability(honest)["expected_error"], 0.0)
        boasting = quality.reliability([(1.0, j % 4 != 0) for j in range(40)])
        self.assertAlmostEqual(boasting["expected_error"], 0.25)
        self.assertEqual([b["true"]["of"] for b in boasting["bins"]], [40])
        mixed = quality.reliability([(1.0, False)] + [(0.5, True)] * 3)
        self.assertAlmostEqual(mixed["expected_error"], 0.25 * 1.0 + 0.75 * 0.5)
        self.assertIsNone(quality.reliability([])["expected_error"])
        # One case of even odds is off by a half whatever comes; certain ones never are.
        self.assertAlmostEqual(quality.reliability([(0.5, True)])["of_right_ones"], 0.5)
        self.assertEqual(quality.reliability([(1.0, True)] * 9)["most_of_right_ones"], 0.0)
        # The mean of |k/n - p| of 400 at even odds is sqrt(2 p (1 - p) / (pi n)).
        many = quality.reliability([(0.5, k < 200) for k in range(400)])
        self.assertAlmostEqual(many["of_right_ones"], 0.0199, delta=0.002)

    def test_every_cause_is_compared_or_said_why_not(self):
        compared = {quantity.cause for quantity in parameters.QUANTITIES}
        self.assertEqual(compared | set(parameters.NOT_COMPARABLE), set(CATALOGUE))
        self.assertFalse(compared & set(parameters.NOT_COMPARABLE))
        same = {quantity.cause for quantity in parameters.QUANTITIES if quantity.same_law}
        self.assertLessEqual(same, set(parameters.SAME_FORM))
        self.assertLess(set(parameters.SAME_FORM), set(CATALOGUE))
        for page in (
            Path(__file__).with_name("README.md"),
            Path(__file__).parents[2] / "README.md",
        ):
            text = page.read_text(encoding="utf-8")
            self.assertIn(f"or {len(parameters.SAME_FORM)} of the {len(CATALOGUE)}", text, page)
        scenes = [small_scene(6, by_force) for by_force in (True, False)]
        for quantity in parameters.QUANTITIES:
            values = []
            for scene, rng in 20 * scenes:  # laws differ by the draw, channels by the drive
                effect = CATALOGUE[quantity.cause](scene, rng)
                effect.strength = 0.3
                values.append(quantity.truth(effect.describe()))
            told = [value for value in values if value is not None]
            self.assertTrue(told and np.all(np.isfinite(told)) and np.all(told), quantity.name)

    def test_errors_and_coverage(self):
        right = mark("sensor_delay", diagnosis("sensor_delay"))
        (row,) = parameters.compare(right)
        self.assertAlmostEqual(row["error"], 0.04)
        self.assertTrue(row["covered"])
        none = [0.0, None]
        for lag, cell in (([1.1e-3, [9e-4, 1.3e-3]], none), (none, [1.1e-3, [9e-4, 1.3e-3]])):
            right["found"]["sensor_delay"] = {"delay": none, "lag": lag, "cell_lag": cell}
            right["parameters"]["channel"] = "force" if lag == none else "displacement"
            (row,) = parameters.compare(right)
            self.assertAlmostEqual(row["error"], 0.1)
            self.assertTrue(row["covered"])
        hum = mark("mains_hum", diagnosis("mains_hum"), parameters={"amplitude_m": 5.0})
        hum["found"]["mains_hum"] = {"sine": [3.0, [2.8, 3.2]], "cosine": [-4.0, [-4.1, -3.9]]}
        (row,) = parameters.compare(hum)
        self.assertAlmostEqual(row["error"], 0.0)
        # Half widths 0.2 and 0.1 at weights 3/5 and 4/5.
        self.assertAlmostEqual(row["interval"][1] - 5.0, np.hypot(0.12, 0.08))
        silent = mark("mains_hum", diagnosis("mains_hum"), parameters={"amplitude_m": 5.0})
        self.assertIsNone(parameters.compare(silent)[0]["error"])
        self.assertEqual(quality.parameters([right, silent])["same_law"]["covered"]["of"], 1)

    def test_weaker_side_of_friction_by_the_sign_of_the_asymmetry(self):
        (quantity,) = (q for q in parameters.QUANTITIES if q.name == "asymmetry")
        told = {"weaker": "positive", "weak_factor": 0.8, "strong_factor": 1.2}
        self.assertAlmostEqual(quantity.truth(told), -0.2)
        self.assertAlmostEqual(quantity.truth({**told, "weaker": "negative"}), 0.2)

    def test_held_out_error_counts_only_in_the_channel_of_the_noise(self):
        one = mark("sensor_delay", diagnosis("sensor_delay"))
        other = mark("sensor_delay", diagnosis("sensor_delay", judged="force"))
        held = quality.held_out([one, other])
        self.assertEqual((held["all"]["within"]["count"], held["all"]["within"]["of"]), (1, 1))
        self.assertEqual(held["not_comparable"], 1)

    def test_noise_is_that_of_the_samples_held_out(self):
        time = np.arange(10.0)
        told = truth(heard=[(time, np.where(time < 5, 1e-9, 2e-9)), (time, np.full(10, 4e-9))])
        said = diagnosis("sensor_delay")
        self.assertEqual(observe(told, said)["held_out_over_noise"], 1.02)
        said["records"] = [{"held_out": [[5.0, 6.0], [8.001, 8.999]]}, {"held_out": []}]
        self.assertAlmostEqual(observe(told, said)["held_out_over_noise"], 0.51)
        self.assertAlmostEqual(observe(told, said)["baseline_over_noise"], 1.5)

    def test_follow_up_counts_what_stayed_open(self):
        before = judge(truth(), diagnosis(("viscous_damping", "sensor_delay")))
        after = judge(truth(), diagnosis("sensor_delay"))
        sums = follow_up_totals(
            [
                {"before": before, "after": after, "failed": None},
                {"before": before, "after": None, "failed": None},  # not with this rig
                {"before": after, "after": None, "failed": None},  # nothing was open
                {"before": before, "after": None, "failed": "exit status 3"},
                {
                    "before": before,
                    "after": before,
                    "failed": None,
                    "promised": {"settles": True},
                },
                {
                    "before": before,
                    "after": after,
                    "failed": None,
                    "promised": {"settles": False},
                },
            ]
        )
        self.assertEqual(sums["ambiguous_before"], 5)
        self.assertEqual((sums["first_after"]["count"], sums["first_after"]["of"]), (2, 4))
        kept = sums["first_where_settlement_was_promised"]
        self.assertEqual((kept["count"], kept["of"]), (0, 1))


class Card(unittest.TestCase):
    def test_the_card_of_known_marks(self):
        power = [
            mark("sensor_delay", diagnosis("sensor_delay"), strength=1.0),
            mark("sensor_delay", diagnosis("viscous_damping"), strength=1.0),
            mark("sensor_delay", diagnosis(verdict="clean"), strength=0.1),
        ]
        foreign = [mark([*FOREIGN][0], diagnosis("creep"), "foreign")]
        clean = [mark("clean", diagnosis(verdict="clean"), "clean")]
        clean.append(mark("clean", diagnosis("pinning"), "clean", noise_asked="outliers"))
        said = diagnosis("pinning", "sensor_delay")
        two = [{**judge(pair_truth(), said), "asked": [2.0, 2.0], "seconds": 1.0}]
        lost = {"effect": "creep", "asked": [0.1, 0.1], "not_drawn": "no draft would do"}
        marks = {"power": power + [lost], "foreign": foreign, "clean": clean, "pairs": two}
        with tempfile.TemporaryDirectory() as folder:
            for name, some in marks.items():
                with Marks(Path(folder) / f"{name}.jsonl", 7, "abc") as kept:
                    for j, one in enumerate(some):
                        kept.add(str(j), one)
            readme = Path(folder) / "README.md"
            readme.write_text(f"before\n{MARKERS[0]}\nformer\n{MARKERS[1]}\nafter\n")
            summary, written = card(folder, None, "1234567", readme, Path(folder) / "figures")
            text = readme.read_text()
            self.assertTrue(text.startswith("before\n") and text.endswith("after\n"))
            self.assertIn(written, text)
            self.assertNotIn("former", text)
            for name in ("matrix", "power", "reliability"):
                tree.parse(Path(folder) / "figures" / f"scorecard-{name}.svg")
            json.loads((Path(folder) / "scorecard.json").read_text())
        one = summary["by_strength"]["1"]
        self.assertEqual((one["right_alone"]["count"], one["right_alone"]["of"]), (1, 2))
        self.assertEqual(summary["by_strength"]["0.1"]["missed"]["count"], 1)
        self.assertEqual(summary["power"]["sensor_delay"]["1"]["in_set"]["count"], 1)
        self.assertEqual(summary["false_alarms"]["outliers"]["all"]["count"], 1)
        self.assertEqual(summary["false_alarms"]["white"]["joint of another form"]["count"], 0)
        self.assertEqual(summary["unknown"]["all"]["wrong_explained"]["count"], 1)
        self.assertEqual(summary["pairs"]["all"]["both_and_no_third"]["count"], 1)
        error = summary["calibration"]["first_name"]["expected_error"]
        self.assertAlmostEqual(error, 0.9 - 0.5)
        sure = summary["separability"]
        self.assertEqual(sure["single_name_right"]["of"], 2)
        self.assertEqual(sure["single_name_right_of_all_cases"]["of"], 4)
        self.assertEqual(summary["not_drawn"]["power"], [["creep", 0.1]])
        self.assertIn("Seed 7, commit 1234567, program abc", written)
