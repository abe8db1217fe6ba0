"""The laboratory checked against closed forms and against itself.

Run with `python -m unittest laboratory.self_test` in tests/.
"""

import json
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from . import loads, noise_free, rig, speed
from .case import Gauge, Sampled, calibrate, draw_case, write_case
from .effects import CATALOGUE, EFFECTS, FOREIGN, in_turn
from .follow_up import measure
from .joints import LAWS, WEIGHTS, Joint, draw_joint
from .noise import Noise, noise
from .refit import Baseline
from .scene import Scene
from .score import Unreadable, judge, matrix, share, totals
from .self_test_begun import Begun  # noqa: F401
from .self_test_follow_up import Again, Dummy  # noqa: F401
from .self_test_measured import Card, Kinds, Pairs, Quality, Resuming  # noqa: F401


def uniform_joint(n=400, series=2.0):
    """Break-free displacements uniform on (0, 1), network stiffness one: full slip at one half."""
    limits = (np.arange(n) + 0.5) / n / n
    return Joint("uniform", 1.0 / n, limits, 0.0, series)


def cycles(levels, per_cycle=800, repeats=2):
    """Sine whose turning values lie on the grid."""
    return noise_free.stepped(levels, per_cycle=per_cycle, repeats=repeats)


def work(force, displacement):
    """Work done along a history by the trapezoidal rule [J]."""
    return float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(displacement)))


class Physics(unittest.TestCase):
    def test_virgin_curve_and_dissipation_of_the_uniform_joint(self):
        # F = u - u^2/2; a steady cycle dissipates 4 u^3 / 6.
        history, joint = cycles([1.0]), uniform_joint()
        trace = rig.drive(joint, history.time, 0.4 * history.command, True)
        u = 1.0 - np.sqrt(1.0 - 2.0 * 0.4)
        self.assertAlmostEqual(np.max(trace.slip) / u, 1.0, delta=1e-4)
        lost = trace.dissipated[-1] - trace.dissipated[-801]
        self.assertAlmostEqual(lost / (4.0 * u**3 / 6.0), 1.0, delta=1e-4)

    def test_work_of_a_closed_cycle_is_the_heat(self):
        history = cycles([1.0])
        for law_seed in range(4):
            joint = draw_joint(np.random.default_rng(law_seed))
            trace = rig.drive(joint, history.time, 0.7 * joint.full_slip * history.command, True)
            last = slice(-801, None)
            done = work(trace.force[last], trace.displacement[last])
            heat = trace.dissipated[-1] - trace.dissipated[-801]
            # The trapezoid over 800 steps is the larger error, of order (2 pi/800)^2.
            self.assertAlmostEqual(done / heat, 1.0, delta=2e-4, msg=joint.law)

    def test_masing_reloading_is_the_virgin_curve_doubled(self):
        joint = uniform_joint()
        n = 500
        up, down = np.linspace(0.0, 1.0, n), np.linspace(1.0, -1.0, 2 * n - 1)
        command = 0.45 * np.concatenate([up, down[1:], -down[1:]])
        trace = rig.drive(joint, np.arange(len(command)) * 1.0, command, True)
        virgin = trace.displacement[:n]
        again = trace.displacement[3 * n - 3 :] - trace.displacement[3 * n - 3]
        np.testing.assert_allclose(again[::2][:n], 2.0 * virgin[: len(again[::2])], atol=1e-9)
        # Return-point memory: the loop closes.
        self.assertAlmostEqual(trace.displacement[-1] / trace.displacement[n - 1], 1.0, delta=1e-9)

    def test_power_law_closed_form_well_inside_the_tolerances_of_identification(self):
        # The tests that use these records ask 0.5 % in theta, 0.01 in chi, 0.1 % in stiffness;
        # the generator must be ten times better.
        for seed in range(3):
            law, peak = noise_free.draw_power_law(np.random.default_rng(seed))
            joint = law.discrete(1.05 * law.slip(peak))
            amplitudes = np.geomspace(0.12, 1.0, 5)
            history = noise_free.stepped(amplitudes, per_cycle=200)
            trace = rig.drive(joint, history.time, peak * history.command, True)
            ends = (3 * np.arange(1, 6) * 200).astype(int)
            heat = trace.dissipated[ends] - trace.dissipated[ends - 200]
            exact = np.array([law.cycle_dissipation(peak * a) for a in amplitudes])
            np.testing.assert_allclose(heat, exact, rtol=5e-4)
            # Slope against the closed form's own slope: the finite-force part drops out.
            slope = np.polyfit(np.log(amplitudes), np.log(heat), 1)[0]
            expected = np.polyfit(np.log(amplitudes), np.log(exact), 1)[0]
            self.assertAlmostEqual(slope, expected, delta=1e-3)
            secant = trace.force[1] / trace.displacement[1]
            top = law.slip(trace.force[1]) + trace.force[1] / law.series
            self.assertAlmostEqual(secant / (trace.force[1] / top), 1.0, delta=1e-4)

    def test_small_force_law_is_the_limit_of_the_closed_form(self):
        law, peak = noise_free.draw_power_law(np.random.default_rng(5))
        tiny = 1e-6 * peak
        limit = law.theta * tiny ** (law.chi + 3.0)
        self.assertAlmostEqual(law.cycle_dissipation(tiny) / limit, 1.0, delta=1e-3)

    def test_force_drive_and_displacement_drive_agree(self):
        rng = np.random.default_rng(11)
        joint = draw_joint(rng)
        history = cycles([0.3, 0.9], per_cycle=200)
        force = 0.8 * joint.full_slip * history.command
        one = rig.drive(joint, history.time, force, True)
        other = rig.drive(joint, history.time, one.displacement, False)
        np.testing.assert_allclose(other.force, force, atol=1e-6 * joint.full_slip)

    def test_dashpot_on_an_elastic_joint_loses_pi_c_omega_u_squared(self):
        class Dashpot(rig.Effect):
            acts = frozenset({"damper"})

            def damper(self, velocity):
                return 0.05 * velocity, 0.05

        _, lost = last_cycle(Dashpot())
        self.assertAlmostEqual(lost / (np.pi * 0.05 * 2 * np.pi), 1.0, delta=1e-3)

    def test_film_behind_a_spring_loses_pi_c_omega_slip_squared(self):
        class Film(rig.Effect):
            acts = frozenset({"film"})

            def film(self, velocity):
                return 0.05 * velocity, 0.05

        trace, lost = last_cycle(Film())
        slip = np.max(np.abs(trace.slip[-3201:]))
        self.assertLess(slip, 0.9 * np.max(np.abs(trace.displacement)))
        self.assertAlmostEqual(lost / (np.pi * 0.05 * 2 * np.pi * slip**2), 1.0, delta=1e-3)

    def test_a_force_beyond_full_slip_is_refused(self):
        joint = uniform_joint()
        history = cycles([1.0], per_cycle=100)
        with self.assertRaises(rig.Infeasible):
            rig.drive(joint, history.time, 1.1 * joint.full_slip * history.command, True)


def last_cycle(effect):
    """An elastic joint with an effect in cycles of 1 m, and what the last one loses [J]."""
    joint = uniform_joint()
    joint.limits = joint.limits + 1e3
    history = cycles([1.0], per_cycle=3200)
    trace = rig.drive(joint, history.time, history.command, False, effect)
    return trace, work(trace.force[-3201:], trace.displacement[-3201:])


def small_scene(seed, by_force=True):
    """A quick scene: two rates, two amplitudes, one hold."""
    rng = np.random.default_rng(seed)
    joint = uniform_joint(120)
    tape = loads.Tape(1.0 / 600.0)
    for rate in (1.5, 6.0):
        for level in (0.5, 1.0):
            tape.ramp(1.0, rate, level)
            tape.cycles(3, rate)
            tape.hold(0.3)
    command = tape.play()
    history = loads.History(tape.step * np.arange(len(command)), command, 2, "test", [1.5, 6.0])
    peak = 0.35 if by_force else 0.9
    return Scene.stage(joint, [history], by_force, peak), rng


class FollowUp(unittest.TestCase):
    def test_the_same_load_gives_the_same_answer_again(self):
        scene, rng = small_scene(4)
        effect = CATALOGUE["viscous_damping"](scene, rng)
        effect.strength = 0.1
        first = Sampled(scene, scene.play(effect), effect)
        still = SimpleNamespace(
            scene=scene, effect=effect, rms=0.0, level=0.0, noise=Noise("white")
        )
        again = measure(still, rng, first.time[0], first.drive[0], True, fine_steps=2)
        size = np.max(np.abs(first.displacement[0]))
        # The program is known at the samples only; between them the rig follows a curve.
        np.testing.assert_allclose(again[2], first.displacement[0], atol=5e-3 * size)
        clean = Sampled(scene, scene.clean, rig.Effect())
        moved = np.max(np.abs(clean.displacement[0] - first.displacement[0]))
        # The effect is more than that curve may miss.
        self.assertGreater(moved, 4 * 5e-3 * size)


class Effects(unittest.TestCase):
    def test_a_fault_of_one_channel_leaves_the_other_alone(self):
        reads = {"read_force": "force", "read_displacement": "displacement"}
        for by_force in (True, False):
            scene, rng = small_scene(1, by_force)
            true = Sampled(scene, scene.clean, rig.Effect())
            for name, effect in CATALOGUE.items():
                drawn = effect(scene, rng)
                if not drawn.acts <= set(reads):
                    continue
                drawn.strength = 0.5
                read = Sampled(scene, scene.clean, drawn)
                for hook, channel in reads.items():
                    both = zip(getattr(read, channel), getattr(true, channel), strict=True)
                    same = all(np.array_equal(one, other) for one, other in both)
                    self.assertEqual(same, hook not in drawn.acts, f"{name}, {channel}")

    def test_a_load_cell_fails_whichever_drives(self):
        for by_force in (True, False):
            scene, rng = small_scene(1, by_force)
            drawn = [CATALOGUE["mains_hum"](scene, rng) for _ in range(40)]
            cells = [hum for hum in drawn if hum.acts == {"read_force"}]
            self.assertTrue(0 < len(cells) < 40)
            for hum in cells:
                hum.strength = 0.5
                (force,) = Sampled(scene, scene.clean, hum).force
                (true,) = Sampled(scene, scene.clean, rig.Effect()).force
                self.assertAlmostEqual(np.max(np.abs(force - true)) / hum.most, 0.5, delta=0.2)

    def test_a_filter_turns_a_sine_by_its_angle(self):
        scene, rng = small_scene(5)
        drawn = [CATALOGUE["sensor_delay"](scene, rng) for _ in range(40)]
        self.assertEqual({effect.law for effect in drawn}, {"pure", "filter"})
        late = next(effect for effect in drawn if effect.law == "filter")
        late.strength, late.most = 0.5, 0.1
        time = 1e-4 * np.arange(50_000)
        read = late.read(SimpleNamespace(time=time), np.sin(7.0 * time))
        angle = np.arctan(7.0 * 0.05)
        exact = np.cos(angle) * np.sin(7.0 * time - angle)
        self.assertLess(np.max(np.abs(read - exact)[20_000:]), 1e-6)

    def test_every_effect_vanishes_at_no_strength_and_shows_at_full(self):
        for name, make in {**CATALOGUE, **FOREIGN}.items():
            scene, rng = small_scene(1)
            effect = make(scene, rng)
            clean = Sampled(scene, scene.clean, rig.Effect())
            effect.strength = 0.0
            none = Sampled(scene, scene.play(effect), effect)
            for a, b in ((clean.force, none.force), (clean.displacement, none.displacement)):
                size = np.max(np.abs(a[0]))
                np.testing.assert_allclose(b[0], a[0], atol=2e-9 * size, err_msg=name)
            # A joint must still carry its load; a sensor may be as bad as it likes.
            effect.strength = 0.5 if effect.acts <= {"read_force", "read_displacement"} else 0.05
            some = Sampled(scene, scene.play(effect), effect)
            change = np.max(np.abs(some.displacement[0] - clean.displacement[0])) + np.max(
                np.abs(some.force[0] - clean.force[0])
            )
            self.assertGreater(change, 1e-6, name)
            json.dumps(effect.describe())

    def test_a_refit_swallows_any_ideal_joint_but_not_an_effect(self):
        for by_force in (True, False):
            scene, rng = small_scene(2, by_force)
            gauge = Gauge(scene)
            self.assertLess(gauge.floor, 1e-3 * gauge.rms)  # the least noise drawn
            # A plain play of the sensor is an ideal joint in series: no refit can see it.
            if by_force:
                hidden = _played(gauge.clean.displacement[0], 0.1 * scene.largest("displacement"))
                self.assertLess(gauge.baseline.misfit([hidden]), 3e-3 * gauge.rms)
            effect = CATALOGUE["displacement_drift"](scene, rng)
            effect.strength = 0.2
            found, _ = gauge(effect)
            self.assertGreater(found, 5e-3 * gauge.rms)

    def test_calibration_reaches_its_target(self):
        scene, rng = small_scene(3)
        gauge = Gauge(scene)
        effect = CATALOGUE["pinning"](scene, rng)
        target = 0.004 * gauge.rms
        found, sampled = calibrate(gauge, effect, target)
        self.assertAlmostEqual(found / target, 1.0, delta=0.03)
        independent = Baseline(sampled.drive, True).misfit(sampled.response)
        self.assertAlmostEqual(independent / found, 1.0, delta=1e-6)

    def test_noise_has_its_level_and_its_colour(self):
        rng = np.random.default_rng(0)
        for colour in (0.0, 0.8):
            x = noise(rng, 200_000, 2.0, colour)
            self.assertAlmostEqual(np.std(x), 2.0, delta=0.05)
            self.assertAlmostEqual(np.corrcoef(x[1:], x[:-1])[0, 1], colour, delta=0.01)


def _played(x, r):
    out, p = np.empty_like(x), 0.0
    for i, value in enumerate(x):
        p = min(max(p, value - r), value + r)
        out[i] = 0.5 * p + 0.5 * value
    return out


class Cases(unittest.TestCase):
    def test_a_case_is_repeatable_and_keeps_its_truth_apart(self):
        records, truth, style = draw_case(5, 0, "pinning", 3.0)
        again, other, _ = draw_case(5, 0, "pinning", 3.0)
        for heard, anew in zip(truth.pop("heard"), other.pop("heard"), strict=True):
            np.testing.assert_array_equal(heard, anew)
        self.assertEqual(truth, other)
        np.testing.assert_array_equal(records[0][2], again[0][2])
        self.assertAlmostEqual(truth["ratio_achieved"], 3.0, delta=0.1)
        with tempfile.TemporaryDirectory() as folder:
            paths = write_case(folder, records, truth, style)
            inside = sorted(p.name for p in (Path(folder) / "records").iterdir())
            self.assertEqual(inside, [p.name for p in paths])
            text = paths[0].read_text(encoding="utf-8").lower()
            for name in EFFECTS:
                self.assertNotIn(name, text)
            self.assertTrue((Path(folder) / "truth.json").exists())

    def test_baselines_and_loads_are_of_many_kinds(self):
        self.assertEqual(len(LAWS), len(WEIGHTS))
        rng = np.random.default_rng(0)
        kinds = set()
        for _ in range(30):
            campaign = loads.draw_campaign(rng)
            total = sum(h.samples for h in campaign)
            self.assertTrue(2900 <= total <= 8000, total)
            for history in campaign:
                self.assertEqual(history.command[0], 0.0)
                self.assertAlmostEqual(np.max(np.abs(history.command)), 1.0)
                kinds.add(history.kind)
        self.assertGreaterEqual(len(kinds), 3)


class Straight(unittest.TestCase):
    def test_a_straight_test_keeps_its_samples_and_turns_at_them(self):
        smooth = loads.one_rate(np.random.default_rng(3), 1.0, (2000, 3000))
        straight = smooth.straight()
        self.assertTrue(straight.is_straight and not smooth.is_straight)
        every = slice(None, None, smooth.fine)
        scale = straight.command[every] @ smooth.command[every]
        scale /= smooth.command[every] @ smooth.command[every]
        np.testing.assert_allclose(
            straight.command[every], scale * smooth.command[every], atol=1e-12
        )
        self.assertAlmostEqual(np.max(np.abs(straight.command[every])), 1.0, places=12)
        bends = np.abs(np.diff(straight.command, 2))
        at_samples = np.zeros(len(straight.command), bool)
        at_samples[every] = True
        self.assertLess(np.max(bends[~at_samples[1:-1]]), 1e-12)


class Turns(unittest.TestCase):
    def test_every_effect_has_its_turn_and_every_fifth_case_is_clean(self):
        names = in_turn(5 * len(EFFECTS))
        self.assertEqual(set(names), set(EFFECTS))
        self.assertEqual(names.count("clean"), len(EFFECTS))
        self.assertEqual(in_turn(3, ["pinning", "clean"]), ["pinning", "clean", "pinning"])


class Scoring(unittest.TestCase):
    def truth(self, effect):
        return {
            "case": 0,
            "effect": effect,
            "in_catalogue": effect in CATALOGUE,
            "ratio_achieved": 2.0,
        }

    def say(self, verdict, *names, ambiguous=()):
        causes = [{"name": n, "ambiguous_with": list(ambiguous)} for n in names]
        return {"schema": "iwan-diagnosis/1", "verdict": verdict, "causes": causes}

    def test_marks(self):
        right = judge(self.truth("pinning"), self.say("explained", "pinning"))
        self.assertTrue(right["alone"] and right["first"] and right["in_set"])
        two = judge(self.truth("pinning"), self.say("explained", "pinning", "clearance"))
        self.assertTrue(two["first"] and not two["alone"])
        other = judge(
            self.truth("pinning"), self.say("explained", "clearance", ambiguous=["pinning"])
        )
        self.assertTrue(other["in_set"] and not other["first"] and not other["wrong_name"])
        wrong = judge(self.truth("pinning"), self.say("explained", "clearance"))
        self.assertTrue(wrong["wrong_name"] and not wrong["in_set"])
        missed = judge(self.truth("pinning"), self.say("clean"))
        self.assertTrue(missed["missed"])
        for diagnosis in (self.say("unexplained"), self.say("clean", "pinning")):
            self.assertTrue(judge(self.truth("clean"), diagnosis)["false_alarm"])
        self.assertFalse(judge(self.truth("clean"), self.say("clean"))["false_alarm"])
        asserted = judge(self.truth("thermal"), self.say("explained", "preload_loss"))
        self.assertTrue(asserted["wrong_explained"] and not asserted["first"])
        honest = judge(self.truth("thermal"), self.say("partly_explained", "preload_loss"))
        self.assertFalse(honest["wrong_explained"])
        with self.assertRaises(Unreadable):
            judge(self.truth("clean"), self.say("fine"))

    def test_totals_and_matrix(self):
        marks = [
            judge(self.truth("pinning"), self.say("explained", "pinning")),
            judge(self.truth("pinning"), self.say("clean")),
            judge(self.truth("clean"), self.say("clean")),
        ]
        sums, table = totals(marks), matrix(marks)
        self.assertEqual(sums["right_first"]["count"], 1)
        self.assertEqual(sums["right_first"]["of"], 2)
        self.assertEqual(sums["false_alarms"]["count"], 0)
        self.assertEqual(table["rows"], ["clean", "pinning"])
        self.assertEqual(np.sum(table["counts"]), 3)
        low, high = share(0, 20)["interval"]
        self.assertEqual(low, 0.0)
        self.assertAlmostEqual(high, 0.161, delta=0.01)


class Speed(unittest.TestCase):
    def test_records_of_the_length_asked_for_go_through_all_levels_at_three_rates(self):
        effect, records = speed.draw(3, 0, 1800)
        self.assertIn(effect, EFFECTS)
        self.assertEqual([len(time) for time, _, _ in records], [600, 600, 600])
        lengths = [time[-1] for time, _, _ in records]
        self.assertAlmostEqual(lengths[0] / lengths[2], 10.0)
        for record in records:
            self.assertTrue(np.all(np.isfinite(record)))


if __name__ == "__main__":
    unittest.main()
