"""Noise-free records of a known power-law joint in small force, for the test of identification.

Stiffness per displacement of break-free is R d^chi up to a limit no force here reaches. Only the
elements within reach are followed one by one, the rest is one spring: no far element costs
resolution. With K_T the stiffness when all stick, a cycle of force amplitude F dissipates to
leading order  theta F^(chi+3),  theta = 4 R / ((chi+2)(chi+3) K_T^(chi+3)).
"""

import json
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from . import csvfile, rig
from .joints import Joint
from .loads import History, Tape

ELEMENTS = 3000


class PowerLaw:
    """The closed forms of a power-law joint below its limit."""

    def __init__(self, chi, weight, network_stiffness, series):
        self.chi, self.weight = chi, weight
        self.network, self.series = network_stiffness, series

    @property
    def theta(self):
        """Coefficient of the small-force dissipation [J/N^(chi+3)]."""
        c = self.chi
        return 4.0 * self.weight / ((c + 2) * (c + 3) * self.network ** (c + 3))

    @property
    def joint_stiffness(self):
        """Stiffness of network and series spring together at vanishing force [N/m]."""
        return self.network * self.series / (self.network + self.series)

    def softening(self, force):
        """Share by which slip has lowered the tangent stiffness of the network at this force."""
        c = self.chi
        return self.weight * self.slip(force) ** (c + 1) / ((c + 1) * self.network)

    def virgin(self, u):
        """Force on the first loading at slip u [N]."""
        c = self.chi
        return self.network * u - self.weight * u ** (c + 2) / ((c + 1) * (c + 2))

    def slip(self, force):
        """Slip u on the first loading at this force [m]."""
        top = force / self.network
        return brentq(lambda u: self.virgin(u) - force, 0.9 * top, 10.0 * top, xtol=1e-16 * top)

    def cycle_dissipation(self, force):
        """Heat of a steady cycle of this force amplitude, to all orders [J]."""
        c = self.chi
        return 4.0 * self.weight * self.slip(force) ** (c + 3) / ((c + 2) * (c + 3))

    def discrete(self, reach, n=ELEMENTS):
        """Equal elements at quantiles of the part below `reach` [m], the rest a spring."""
        c = self.chi
        within = self.weight * reach ** (c + 1) / (c + 1)
        edges = np.linspace(0.0, 1.0, n + 1)
        # Mean break-free displacement of each cell of equal stiffness, not its middle.
        power = (c + 2) / (c + 1)
        mean = np.diff(edges**power) * n / power
        each = within / n
        return Joint(
            "power_law", each, each * reach * mean, self.network - within, self.series, {"chi": c}
        )


def draw_power_law(rng, softening=None):
    """A joint and a peak force at which slip has softened the network by a small share."""
    chi = float(rng.uniform(-0.7, 0.2))
    network = 10 ** rng.uniform(6.5, 8.5)
    peak = 10 ** rng.uniform(1.5, 3.5)
    softening = softening or float(rng.uniform(0.005, 0.015))
    # Tangent at slip u: K_T - R u^(chi+1)/(chi+1); choose R for the softening at the peak.
    u = peak / network
    weight = softening * network * (chi + 1) / u ** (chi + 1)
    series = network * 10 ** rng.uniform(-0.2, 0.8)
    return PowerLaw(chi, float(weight), float(network), float(series)), float(peak)


def stepped(levels, rate=1.0, per_cycle=400, repeats=2):
    """Stepped sine whose turning values are sampled exactly, beginning and ending at rest."""
    tape = Tape(1.0 / (rate * per_cycle))
    for level in levels:
        tape.ramp(1.0, rate, level)
        tape.cycles(repeats, rate)
    command = tape.play()
    return History(tape.step * np.arange(len(command)), command, 1, "stepped_sine", [rate])


def single_ramp(samples=800, seconds=10.0):
    """One monotone loading to the peak."""
    time = np.linspace(0.0, seconds, samples)
    return History(time, time / seconds, 1, "monotone_ramp", [0.25 / seconds])


def make(seed, directory, softening=None):
    """Write DIR/records/*.csv without noise and DIR/truth.json."""
    law, peak = draw_power_law(np.random.default_rng([seed, 3]), softening)
    joint = law.discrete(1.05 * law.slip(peak))
    levels = np.geomspace(0.12, 1.0, 6)
    folder = Path(directory) / "records"
    folder.mkdir(parents=True, exist_ok=True)
    style = {"force": "N", "length": "m", "swap": False}
    for name, history in (("test-1", stepped(levels)), ("test-2", single_ramp())):
        trace = rig.drive(joint, history.time, peak * history.command, True)
        csvfile.write_record(
            folder / f"{name}.csv",
            trace.time,
            trace.force,
            trace.displacement,
            style,
            ["joint test"],
            digits=13,
        )
    truth = {
        "schema": "laboratory-noise-free/1",
        "seed": seed,
        "chi": law.chi,
        "theta": law.theta,
        "theta_unit": "J/N^(chi+3)",
        "series_stiffness_N_per_m": law.joint_stiffness,
        "series_stiffness_is": "K_1 K_T/(K_1+K_T): the slope at vanishing force",
        "K_1_N_per_m": law.series,
        "K_T_N_per_m": law.network,
        "weight_R": law.weight,
        "tangent_softening_at_peak": law.softening(peak),
        "peak_force_N": peak,
        "amplitudes_N": [float(peak * a) for a in levels],
        "cycle_dissipation_J": [law.cycle_dissipation(peak * a) for a in levels],
        "tolerances": {"theta_relative": 0.005, "chi": 0.01, "series_stiffness_relative": 0.001},
    }
    path = Path(directory) / "truth.json"
    path.write_text(json.dumps(truth, indent=1) + "\n", encoding="utf-8")
    return path
