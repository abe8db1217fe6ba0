"""The coupled example: energy balance, damping by the closed form, and the package.

    PYTHONPATH=tests python -m unittest resonator_decay

Uses the program that the environment variable IWAN names, else target/release/iwan.
"""

import os
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from fmpy.ssp.ssd import read_ssd
from fmpy.validation import validate_fmu

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "examples" / "resonator"))

import masters  # noqa: E402
import resonator  # noqa: E402
from resonator import Cycles  # noqa: E402


class Coupled:
    """Either coupling: runs once, asked often."""

    drive: str
    # What a master that never repeats a step may miss: see the tests that use them.
    package_apart: float
    package_imbalance: float

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        folder = Path(cls.folder.name)
        iwan = Path(os.environ.get("IWAN", ROOT / "target/release/iwan")).resolve()
        cls.joint = resonator.export_joint(iwan, folder, cls.drive)
        cls.bodies = resonator.build_bodies(folder, cls.drive)
        cls.package = resonator.package(cls.joint, cls.bodies, folder, cls.drive)
        cls.decay = masters.decay(cls.joint)
        cls.law = resonator.ClosedForm.read(resonator.HERE / "joint.json")
        cls.cycles = Cycles.of(cls.decay)
        cls.by_displacement = (
            cls.decay
            if cls.drive == "displacement"
            else masters.decay(resonator.export_joint(iwan, folder))
        )

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_energy_is_conserved_to_the_order_of_the_master(self):
        # Velocity Verlet at omega h = 0.03 errs by (omega h)^2 / 4, and so at twice the step four
        # times as much: what is missing is the master's, not the joint's.
        fine = self.decay.imbalance()
        coarse = masters.decay(self.joint, step=2.0 * masters.STEP).imbalance()
        self.assertLess(fine, 0.25 * (2.0 * np.pi * 200.0 * masters.STEP) ** 2 * 1.2)
        self.assertGreater(fine, 0.0)
        self.assertAlmostEqual(coarse / fine, 4.0, delta=0.8)

    def test_dissipation_is_that_of_the_closed_form(self):
        # Exact for a closed loop of constant amplitude; a cycle of a decay of 1 % damping loses
        # 6 % of its amplitude, whose mean enters: a second-order remainder.
        expected = self.law.of_slip(self.cycles.slip)
        self.assertGreater(len(expected), 80)
        np.testing.assert_allclose(self.cycles.dissipation, expected, rtol=6e-3)
        # over two decades of dissipation in one run
        self.assertGreater(expected[0] / expected[-1], 100.0)

    def test_damping_falls_and_frequency_rises_as_the_joint_comes_to_rest(self):
        energy = 0.5 * self.cycles.force**2
        damping = self.cycles.dissipation / energy
        self.assertTrue(np.all(np.diff(damping) < 0.0))
        self.assertGreater(damping[0] / damping[-1], 6.0)
        periods = np.diff(self.decay.time[np.isin(self.decay.time, self.cycles.peaks)])
        self.assertLess(periods[-10:].mean(), 0.97 * periods[:3].mean())

    def test_both_units_are_valid(self):
        self.assertEqual(validate_fmu(str(self.joint)), [])
        self.assertEqual(validate_fmu(str(self.bodies)), [])

    def test_the_package_is_valid_and_gives_the_same_run(self):
        structure = read_ssd(str(self.package), validate=True)
        self.assertEqual({e.name for e in structure.system.elements}, {"joint", "bodies"})
        result = masters.decay_of_package(self.package)
        answer = resonator.ANSWER[self.drive]
        self.assertEqual(len(result), 20001)
        apart = masters.difference(result[f"joint.{answer}"], self.decay, answer)
        self.assertLess(apart, self.package_apart)
        self.assertLess(masters.imbalance_of_package(result), self.package_imbalance)


class DrivenInForce(Coupled, unittest.TestCase):
    """The force is sought that moves the joint as far as the bodies have moved."""

    drive = "force"
    # Secants over the last step instead of a solved equation.
    package_apart = 0.004
    package_imbalance = 0.006

    def test_the_run_is_that_of_the_joint_driven_in_displacement(self):
        # The same equations of the same master: what differs is where Newton's method stops.
        other = self.by_displacement
        for name in ("force", "displacement", "velocity", "dissipation", "stored_energy"):
            one, two = getattr(self.decay, name), getattr(other, name)
            self.assertLess(np.abs(one - two).max(), 1e-9 * np.abs(two).max(), name)
        mismatch = np.abs(self.decay.displacement - self.decay.strain).max()
        self.assertLess(mismatch, 5e-10 * np.abs(self.decay.strain).max())

    def test_newton_needs_few_steps(self):
        # The derivative is the joint's own: one trial, one correction, a third at reversals.
        each = self.decay.steps_of_the_unit / (len(self.decay.time) - 1)
        self.assertLess(each, 2.2)
        self.assertGreater(each, 1.0)


class DrivenInDisplacement(Coupled, unittest.TestCase):
    """The natural coupling: the joint answers the bodies' motion with a force."""

    drive = "displacement"
    # The joint's first step sees no displacement yet: a kick of (omega h)^2 = 0.1 % of the
    # velocity, 0.2 % of the energy, and as much again while the next step waits for the force.
    package_apart = 0.002
    package_imbalance = 0.005

    def test_dissipation_rises_with_force_to_the_power_chi_plus_3(self):
        # D = theta F^(chi+3) is the limit of small forces; the network's softening departs from it
        # by (chi+3) R u^(chi+1) / ((chi+1)(chi+2) K_T), the first term of G's series.
        chi = self.law.exponent
        weak = Cycles.of(masters.decay(self.joint, start_velocity=0.01 * masters.START_VELOCITY))
        self.assertLess(weak.force.max(), 2.0)
        departure = self.law.coefficient() * (weak.force / self.law.stiffness) ** (chi + 1)
        departure *= (chi + 3) / ((chi + 1) * (chi + 2) * self.law.stiffness)
        self.assertLess(departure.max(), 0.03)
        expected = self.law.of_force(weak.force) * (1.0 + departure)
        np.testing.assert_allclose(weak.dissipation, expected, rtol=2e-3)
        strong = self.cycles.force < 40.0
        slopes = [
            np.polyfit(np.log(force), np.log(dissipation), 1)[0]
            for force, dissipation in (
                (weak.force, weak.dissipation),
                (self.cycles.force[strong], self.cycles.dissipation[strong]),
            )
        ]
        self.assertAlmostEqual(slopes[0], chi + 3.0, delta=0.02)
        self.assertGreater(slopes[1], slopes[0])
        # over the slip of the network the power law has no remainder at all
        slip = np.polyfit(np.log(self.cycles.slip), np.log(self.cycles.dissipation), 1)[0]
        self.assertAlmostEqual(slip, chi + 3.0, delta=0.003)

    def test_a_harder_blow_is_damped_more(self):
        weak = Cycles.of(masters.decay(self.joint, start_velocity=0.2 * masters.START_VELOCITY))
        first = lambda cycles: cycles.dissipation[0] / cycles.force[0] ** 2  # noqa: E731
        self.assertGreater(first(self.cycles), 1.5 * first(weak))


if __name__ == "__main__":
    unittest.main()
