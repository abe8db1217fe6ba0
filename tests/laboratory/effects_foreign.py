"""Effects that the finder's catalogue does not have: the honest answer is not to explain them."""

import numpy as np
from scipy.signal import cont2discrete, lfilter

from .effects_catalogue import Scaled


class Ageing(Scaled):
    """Contacts strengthen while they rest and lose the gain once they have slipped a while."""

    name = "ageing"
    acts = frozenset({"limits", "after"})

    def draw(self, scene, rng):
        self.rest = rng.uniform(0.1, 0.5) / scene.slowest
        self.renewal = scene.largest("slip") * rng.uniform(1.0, 5.0)
        self.still = 1e-3 * scene.fastest_motion()

    def reset(self):
        self.age = 0.0

    def limits(self, base):
        high = (1.0 + 0.6 * self.strength * self.age) * base
        return -high, high

    def after(self, now):
        if abs(now.moved) < self.still * now.dt:
            self.age += (1.0 - self.age) * -np.expm1(-now.dt / self.rest)
        else:
            self.age *= np.exp(-abs(now.moved) / self.renewal)

    def describe(self):
        return {
            "gain_limit": 0.6 * self.strength,
            "rest_time_s": self.rest,
            "renewal_path_m": self.renewal,
        }


class Thermal(Scaled):
    """Friction falls as its own heat warms the contact, and recovers as it cools."""

    name = "thermal"
    acts = frozenset({"limits", "after"})

    def draw(self, scene, rng):
        self.recovery = scene.duration * 10 ** rng.uniform(-2.0, -0.9)
        hottest = []
        for trace in scene.clean:  # so that the clean test would just warm to one
            keep = np.exp(-(trace.time[1] - trace.time[0]) / self.recovery)
            hottest.append(lfilter([1.0], [1.0, -keep], np.diff(trace.dissipated)).max())
        self.capacity = float(max(hottest))

    def reset(self):
        self.warmth = 0.0

    def limits(self, base):
        high = base / (1.0 + self.strength * self.warmth)
        return -high, high

    def after(self, now):
        cooling = np.exp(-now.dt / self.recovery)
        self.warmth = self.warmth * cooling + now.heat / self.capacity

    def describe(self):
        return {"softening": self.strength, "recovery_s": self.recovery}


class SensorHysteresis(Scaled):
    """The displacement sensor lags its motion: by a Dahl law, or by a play that widens along it.

    A plain play would be one more ideal joint in series, invisible by nature; these are not.
    """

    name = "sensor_hysteresis"
    kind = "measurement"
    acts = frozenset({"read_displacement"})

    def draw(self, scene, rng):
        self.law = str(rng.choice(["dahl", "widening_play"]))
        self.peak = scene.largest("displacement")
        self.length = self.peak * rng.uniform(0.3, 0.8)
        self.slope = float(rng.uniform(0.5, 0.9) * rng.choice([-1.0, 1.0]))

    def read_displacement(self, trace):
        x = trace.displacement
        lag = 0.3 * self.strength * self.peak
        out = np.empty_like(x)
        if self.law == "dahl":
            moves = np.diff(x, prepend=0.0)
            decay = np.exp(-np.abs(moves) / self.length)
            h = 0.0
            for i, (move, keep) in enumerate(zip(moves, decay, strict=True)):
                if move:
                    side = 1.0 if move > 0 else -1.0
                    h = side + (h - side) * keep
                out[i] = h
            return x - lag * out
        width = lag * (1.0 + self.slope * x / self.peak)
        p = 0.0
        for i, (low, high) in enumerate(zip(x - width, x + width, strict=True)):
            p = min(max(p, low), high)
            out[i] = p
        return out

    def describe(self):
        return {
            "law": self.law,
            "lag_m": 0.3 * self.strength * self.peak,
            "length_m": self.length,
            "slope": self.slope,
        }


class FixtureResonance(Scaled):
    """A lightly damped mode of the fixture is shaken by the force and adds its motion."""

    name = "fixture_resonance"
    kind = "measurement"
    acts = frozenset({"read_displacement"})

    def draw(self, scene, rng):
        self.mode = scene.fastest * rng.uniform(1.7, 4.5)
        self.damping = 10 ** rng.uniform(-2.5, -1.5)
        self.most = 0.5 * scene.largest("displacement") / scene.largest("force")

    def read_displacement(self, trace):
        w = 2 * np.pi * self.mode
        dt = trace.time[1] - trace.time[0]
        b, a, _ = cont2discrete(([w * w], [1.0, 2 * self.damping * w, w * w]), dt, method="foh")
        return trace.displacement + self.strength * self.most * lfilter(b[0], a, trace.force)

    def describe(self):
        return {
            "mode_Hz": self.mode,
            "damping_ratio": self.damping,
            "compliance_m_per_N": self.strength * self.most,
        }


class Settling(Scaled):
    """The specimen sets once at a high peak: a lasting displacement and a stiffer seat after it."""

    name = "settling"
    acts = frozenset({"series", "after"})

    def draw(self, scene, rng):
        self.top = scene.largest("force")
        self.from_force = self.top * rng.uniform(0.6, 0.85)
        self.set_most = scene.largest("displacement") * 0.6
        self.stiffen = rng.uniform(0.1, 0.5) / scene.joint.series

    def reset(self):
        self.largest, self.done, self.way = 0.0, 0.0, 1.0

    def after(self, now):
        if abs(now.network) > self.largest:
            self.largest = abs(now.network)
            if self.done == 0.0:
                self.way = np.sign(now.network)
            x = (self.largest - self.from_force) / (0.97 * self.top - self.from_force)
            x = min(max(x, 0.0), 1.0)
            self.done = x * x * (3.0 - 2.0 * x)

    def series(self, force):
        s = self.strength * self.done
        return s * (self.set_most * self.way - self.stiffen * force), -s * self.stiffen

    def describe(self):
        return {
            "set_m": self.strength * self.set_most,
            "begins_at_N": self.from_force,
            "compliance_lost_m_per_N": self.strength * self.stiffen,
        }


class TemperatureWave(Scaled):
    """The room warms and cools: two slow waves on the displacement reading."""

    name = "temperature_wave"
    kind = "measurement"
    acts = frozenset({"read_displacement"})

    def draw(self, scene, rng):
        self.most = 0.3 * scene.largest("displacement")
        slow = rng.uniform(0.6, 2.5)
        self.periods = scene.duration * np.array([slow, slow / rng.uniform(2.2, 4.7)])
        self.phases = rng.uniform(0.0, 2 * np.pi, 2)
        self.sizes = np.array([1.0, rng.uniform(0.3, 1.0)])

    def read_displacement(self, trace):
        turns = 2 * np.pi * trace.time[:, None] / self.periods + self.phases
        wave = (np.sin(turns) - np.sin(self.phases)) @ self.sizes
        return trace.displacement + self.strength * self.most * wave

    def describe(self):
        return {
            "size_m": self.strength * self.most,
            "periods_s": self.periods.tolist(),
            "shares": self.sizes.tolist(),
        }


class WanderingGain(Scaled):
    """The gain of the displacement channel wanders: a random walk that is called back."""

    name = "wandering_gain"
    kind = "measurement"
    acts = frozenset({"read_displacement"})

    def draw(self, scene, rng):
        self.memory = scene.duration * rng.uniform(0.05, 0.3)
        self.seed = int(rng.integers(2**31))

    def read_displacement(self, trace):
        keep = np.exp(-(trace.time[1] - trace.time[0]) / self.memory)
        steps = np.random.default_rng(self.seed).standard_normal(len(trace.time))
        walk = lfilter([np.sqrt(1.0 - keep * keep)], [1.0, -keep], steps)
        return trace.displacement * (1.0 + 0.3 * self.strength * (walk - walk[0]))

    def describe(self):
        return {"deviation": 0.3 * self.strength, "memory_s": self.memory, "walk_seed": self.seed}


FOREIGN = [
    Ageing,
    Thermal,
    SensorHysteresis,
    FixtureResonance,
    Settling,
    TemperatureWave,
    WanderingGain,
]
