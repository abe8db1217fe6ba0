"""The remaining effects of the measuring chain in the finder's catalogue."""

import numpy as np
from scipy.signal import lfilter

from .effects_catalogue import Scaled
from .rig import Infeasible

HALVINGS = 3  # of the rig's steps, until they do not show
FOLLOW_UP_FINE = 4  # steps of the rig between two samples of a test that is not of the campaign


def _one_sample(fine):
    """Weights of a mean over the time of `fine` steps, symmetric about a point of the grid."""
    if fine % 2:
        return np.full(fine, 1.0 / fine)
    ends = np.ones(fine + 1)
    ends[[0, -1]] = 0.5
    return ends / fine


CELLS = 0.4  # share of the rigs whose load cell has the fault


class Instrument(Scaled):
    """An effect of one channel alone, of the sensor or of the load cell, whichever drives."""

    kind = "measurement"

    def draw(self, scene, rng):
        of_cell = rng.random() < CELLS
        self.channel = "force" if of_cell else "displacement"
        self.unit = "N" if of_cell else "m"
        self.acts = frozenset({f"read_{self.channel}"})
        self.begin(scene, rng)

    def begin(self, scene, rng):
        """Draw what is the effect's own."""
        raise NotImplementedError

    def read(self, trace, values):
        """The channel as it is read."""
        raise NotImplementedError

    def read_force(self, trace):
        return self.read(trace, trace.force) if self.channel == "force" else trace.force

    def read_displacement(self, trace):
        if self.channel == "displacement":
            return self.read(trace, trace.displacement)
        return trace.displacement

    def describe(self):
        return {"channel": self.channel} | self.own()

    def own(self):
        """Its own parameters as plain values."""
        raise NotImplementedError


class FixtureInertia(Scaled):
    """Mass between load cell and specimen: the cell reads its inertia as well.

    Where the load turns a corner the acceleration is an impulse, whose value at a point hangs on
    the rig's step; the cell's amplifier reads its mean over the time from sample to sample.
    """

    name = "fixture_inertia"
    kind = "measurement"
    acts = frozenset({"read_force"})

    def draw(self, scene, rng):
        fastest = (2 * np.pi * scene.fastest) ** 2 * scene.largest("displacement")
        self.most = 0.5 * scene.largest("force") / fastest
        self.fine = {
            2**halved * (len(h.time) - 1) + 1: 2**halved * h.fine
            for h in scene.histories
            for halved in range(HALVINGS + 1)
        }

    def read_force(self, trace):
        velocity = np.gradient(trace.displacement, trace.time)
        acceleration = np.gradient(velocity, trace.time)
        fine = self.fine.get(len(trace.time), FOLLOW_UP_FINE)
        mean = np.convolve(acceleration, _one_sample(fine), mode="same")
        return trace.force + self.strength * self.most * mean

    def describe(self):
        return {"mass_kg": self.strength * self.most}


FILTERS = 0.4  # share of the late channels that a filter of first order makes late


class SensorDelay(Instrument):
    """One channel comes late, as it is or through a filter of first order."""

    name = "sensor_delay"

    def begin(self, scene, rng):
        self.most = 0.1 / scene.fastest
        self.law = "filter" if rng.random() < FILTERS else "pure"

    def read(self, trace, values):
        late = self.strength * self.most
        if self.law == "pure" or late == 0.0:
            return np.interp(trace.time - late, trace.time, values)
        # Trapezoidal steps of the rig, from rest at the first value.
        step = (trace.time[-1] - trace.time[0]) / (len(trace.time) - 1)
        b, a = 0.5 * step / late, 1.0
        read, _ = lfilter([b, b], [a + b, b - a], values - values[0], zi=[0.0])
        return values[0] + read

    def own(self):
        return {"law": self.law, "delay_s": self.strength * self.most}


class OffsetStep(Instrument):
    """The sensor slips on its mount: a lasting jump, over a few milliseconds or at once."""

    name = "offset_step"

    def begin(self, scene, rng):
        self.file = int(rng.integers(len(scene.histories)))
        length = float(scene.histories[self.file].time[-1])
        self.duration = length
        self.when = length * rng.uniform(0.2, 0.8)
        self.rise = length * 10 ** rng.uniform(-5.0, -3.0)
        self.most = 0.5 * scene.largest(self.channel) * rng.choice([-1.0, 1.0])

    def read(self, trace, values):
        if trace.time[-1] != self.duration:  # happens in one of the files only
            return values
        x = np.clip((trace.time - self.when) / self.rise, -40.0, 40.0)
        return values + self.strength * self.most / (1.0 + np.exp(-x))

    def own(self):
        return {
            f"step_{self.unit}": self.strength * self.most,
            "at_s": self.when,
            "file": self.file + 1,
        }


class MainsHum(Instrument):
    """Mains frequency and a little of its third harmonic."""

    name = "mains_hum"

    def begin(self, scene, rng):
        self.frequency = float(rng.choice([50.0, 60.0])) * (1.0 + 1e-3 * rng.uniform(-1.0, 1.0))
        rates = [1.0 / (h.fine * (h.time[1] - h.time[0])) for h in scene.histories]
        if min(rates) < 2.5 * self.frequency:
            raise Infeasible("sampled too slowly for mains hum")
        self.phase = rng.uniform(0.0, 2 * np.pi, 2)
        self.third = rng.uniform(0.0, 0.3) if min(rates) > 8.0 * self.frequency else 0.0
        self.most = 0.3 * scene.largest(self.channel)

    def read(self, trace, values):
        angle = 2 * np.pi * self.frequency * trace.time
        hum = np.sin(angle + self.phase[0]) + self.third * np.sin(3 * angle + self.phase[1])
        return values + self.strength * self.most * hum

    def own(self):
        return {f"amplitude_{self.unit}": self.strength * self.most, "frequency_Hz": self.frequency}


class AcCoupling(Instrument):
    """A high-pass in an amplifier, of first or second order."""

    name = "ac_coupling"

    def begin(self, scene, rng):
        self.order = int(rng.choice([1, 2], p=[0.7, 0.3]))
        self.most = 0.5 * scene.slowest

    def read(self, trace, values):
        dt = trace.time[1] - trace.time[0]
        half = np.pi * self.strength * self.most * dt  # bilinear transform
        b = np.array([1.0, -1.0]) / (1.0 + half)
        a = np.array([1.0, -(1.0 - half) / (1.0 + half)])
        out = values
        for _ in range(self.order):
            out = lfilter(b, a, out)
        return out

    def own(self):
        return {"corner_Hz": self.strength * self.most, "order": self.order}


class SensorSaturation(Instrument):
    """The sensor bends over towards the end of its range."""

    name = "sensor_saturation"

    def begin(self, scene, rng):
        self.knee = float(rng.uniform(8.0, 30.0))
        self.peak = scene.largest(self.channel)

    def read(self, trace, values):
        x = values
        relative = np.abs(x) * (2.0 * self.strength / self.peak)
        return x / (1.0 + relative**self.knee) ** (1.0 / self.knee)

    def own(self):
        return {f"range_{self.unit}": 0.5 * self.peak / max(self.strength, 1e-9), "knee": self.knee}


class SensorNonlinearity(Instrument):
    """The sensor's scale bends along its range, alike or unlike on the two sides."""

    name = "sensor_nonlinearity"

    def begin(self, scene, rng):
        self.peak = scene.largest(self.channel)
        self.even = float(rng.uniform(-1.0, 1.0))
        self.odd = float(rng.uniform(-1.0, 1.0))

    def read(self, trace, values):
        x = values / self.peak
        bend = self.even * (1.0 - np.cos(1.5 * x)) + self.odd * (np.sin(1.5 * x) - 1.5 * x)
        return values + 0.4 * self.strength * self.peak * bend

    def own(self):
        return {
            "even_share": 0.4 * self.strength * self.even,
            "odd_share": 0.4 * self.strength * self.odd,
        }


MORE = [
    FixtureInertia,
    SensorDelay,
    OffsetStep,
    MainsHum,
    AcCoupling,
    SensorSaturation,
    SensorNonlinearity,
]
