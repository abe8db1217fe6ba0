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

import resonator  # noqa: E402


class Resonator(unittest.TestCase):
    """Runs once, asked often."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        folder = Path(cls.folder.name)
        iwan = Path(os.environ.get("IWAN", ROOT / "target/release/iwan")).resolve()
        cls.joint = resonator.export_joint(iwan, folder)
        cls.bodies = resonator.build_bodies(folder)
        cls.package = resonator.package(cls.joint, cls.bodies, folder)
        cls.decay = resonator.decay(cls.joint)
        cls.law = resonator.ClosedForm.read(resonator.HERE / "joint.json")
        cls.cycles = cls.decay.cycles()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_energy_is_conserved_to_the_order_of_the_master(self):
        # Velocity Verlet at omega h = 0.03 errs by (omega h)^2 / 4, and so at twice the step four
        # times as much: what is missing is the master's, not the joint's.
        fine = self.decay.imbalance()
        coarse = resonator.decay(self.joint, step=2.0 * resonator.STEP).imbalance()
        self.assertLess(fine, 0.25 * (2.0 * np.pi * 200.0 * resonator.STEP) ** 2 * 1.2)
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

    def test_dissipation_rises_with_force_to_the_power_chi_plus_3(self):
        # D = theta F^(chi+3) is the limit of small forces; the network's softening departs from it
        # by (chi+3) R u^(chi+1) / ((chi+1)(chi+2) K_T), the first term of G's series.
        chi = self.law.exponent
        weak = resonator.decay(self.joint, start_velocity=0.01 * resonator.START_VELOCITY).cycles()
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

    def test_damping_falls_and_frequency_rises_as_the_joint_comes_to_rest(self):
        energy = 0.5 * self.cycles.force**2
        damping = self.cycles.dissipation / energy
        self.assertTrue(np.all(np.diff(damping) < 0.0))
        self.assertGreater(damping[0] / damping[-1], 4.0)
        periods = np.diff(self.decay.time[np.isin(self.decay.time, self.cycles.peaks)])
        self.assertLess(periods[-10:].mean(), 0.99 * periods[:3].mean())

    def test_a_harder_blow_is_damped_more(self):
        weak = resonator.decay(self.joint, start_velocity=0.2 * resonator.START_VELOCITY).cycles()
        first = lambda cycles: cycles.dissipation[0] / cycles.force[0] ** 2  # noqa: E731
        self.assertGreater(first(self.cycles), 1.5 * first(weak))

    def test_both_units_are_valid(self):
        self.assertEqual(validate_fmu(str(self.joint)), [])
        self.assertEqual(validate_fmu(str(self.bodies)), [])

    def test_the_package_is_valid_and_gives_the_same_run(self):
        structure = read_ssd(str(self.package), validate=True)
        self.assertEqual({e.name for e in structure.system.elements}, {"joint", "bodies"})
        force = resonator.decay_of_package(self.package)
        # Another master: all units at once, the displacement one step ahead. The joint's first step
        # sees no displacement yet: a kick of (omega h)^2 = 0.1 % of the velocity.
        self.assertEqual(len(force), 20001)
        self.assertLess(resonator.difference(force, self.decay), 0.002)


if __name__ == "__main__":
    unittest.main()
