"""Effects that the finder is asked to name, in the laboratory's own words.

Which of these laws the finder's hold exactly is said by `parameters.SAME_FORM`.

Every effect draws its shape once; `strength` in (0, 1] then scales it, one being the most that
an engineer would still call a bolted joint with that effect.
"""

import numpy as np

from .rig import Effect


class Scaled(Effect):
    """An effect with a drawn shape and one strength."""

    kind = "joint"

    def __init__(self, scene, rng):
        self.strength = 0.0
        self.draw(scene, rng)

    def draw(self, scene, rng):
        """Choose the shape for this scene."""
        raise NotImplementedError


def softplus(x):
    """log(1 + exp x) and its slope, without overflow."""
    if x > 30.0:
        return x, 1.0
    if x < -30.0:
        return 0.0, 0.0
    e = np.exp(x)
    return float(np.log1p(e)), float(e / (1.0 + e))


class Pinning(Scaled):
    """The bolt shank meets the hole after a gap: one side or both, softplus or Hertz-like."""

    name = "pinning"
    acts = frozenset({"contact"})

    def draw(self, scene, rng):
        reach = scene.largest("slip")
        self.sides = str(rng.choice(["both", "positive", "negative"], p=[0.6, 0.2, 0.2]))
        self.gaps = reach * rng.uniform(0.25, 0.8, 2)  # positive, negative side
        ratio = 10 ** rng.uniform(-0.3, 0.3)
        self.share = {"both": (1.0, ratio), "positive": (1.0, 0.0), "negative": (0.0, 1.0)}[
            self.sides
        ]
        self.law = str(rng.choice(["softplus", "power"]))
        self.power = float(rng.uniform(1.0, 1.5))
        self.round = float(self.gaps.min() * rng.uniform(0.02, 0.08))
        self.most = 5.0 * scene.joint.network_stiffness
        self.reach = reach

    def _side(self, beyond):
        if self.law == "softplus":
            force, slope = softplus(beyond / self.round)
            return force * self.round, slope
        if beyond <= 0.0:
            return 0.0, 0.0
        relative = beyond / self.reach
        return beyond * relative ** (self.power - 1.0), self.power * relative ** (self.power - 1.0)

    def contact(self, u):
        stiffness = self.strength * self.most
        force = slope = 0.0
        if self.share[0]:
            a, b = self._side(u - self.gaps[0])
            force, slope = force + self.share[0] * a, slope + self.share[0] * b
        if self.share[1]:
            a, b = self._side(-u - self.gaps[1])
            force, slope = force - self.share[1] * a, slope + self.share[1] * b
        return stiffness * force, stiffness * slope

    def describe(self):
        return {
            "law": self.law,
            "sides": self.sides,
            "gap_positive_m": float(self.gaps[0]),
            "gap_negative_m": float(self.gaps[1]),
            "stiffness_positive_N_per_m": self.strength * self.most * self.share[0],
            "stiffness_negative_N_per_m": self.strength * self.most * self.share[1],
            "rounding_m": self.round,
            "power": self.power,
        }


class Damper(Scaled):
    """Oil or air across the joint, or a film between its surfaces, solved in each step."""

    acts = frozenset({"damper", "film"})

    def place(self, scene, rng):
        """Draw the place, and return the highest rate there."""
        self.where = str(rng.choice(["joint", "contact"], p=[0.6, 0.4]))
        self.acts = frozenset({"damper" if self.where == "joint" else "film"})
        way = scene.largest("displacement" if self.where == "joint" else "slip")
        return 2 * np.pi * scene.fastest * way

    def film(self, velocity):
        return self.damper(velocity)


class ViscousDamping(Damper):
    """A dashpot."""

    name = "viscous_damping"

    def draw(self, scene, rng):
        self.most = 0.5 * scene.largest("force") / self.place(scene, rng)

    def damper(self, velocity):
        c = self.strength * self.most
        return c * velocity, c

    def describe(self):
        return {"coefficient_Ns_per_m": self.strength * self.most, "where": self.where}


class Clearance(Scaled):
    """Free play in the load path: crossed at almost no force, seated over a small force."""

    name = "clearance"
    acts = frozenset({"series"})

    def draw(self, scene, rng):
        self.most = scene.largest("displacement")
        self.law = str(rng.choice(["tanh", "root"]))
        self.seat = scene.largest("force") * 10 ** rng.uniform(-2.3, -1.5)

    def series(self, force):
        half, x = 0.5 * self.strength * self.most, force / self.seat
        if self.law == "tanh":
            y = np.tanh(x)
            return half * y, half / self.seat * (1.0 - y * y)
        root = (1.0 + x * x) ** 0.5
        return half * x / root, half / self.seat / root**3

    def describe(self):
        return {
            "gap_m": self.strength * self.most,
            "seating": self.law,
            "seating_force_N": self.seat,
        }


class PreloadLoss(Scaled):
    """Break-free forces fall with the heat dissipated so far, or with the slip path."""

    name = "preload_loss"
    acts = frozenset({"limits", "after"})

    def draw(self, scene, rng):
        self.law = str(rng.choice(["exponential", "hyperbolic", "power", "path"]))
        total = max(float(trace.dissipated[-1]) for trace in scene.clean)
        path = max(float(np.abs(np.diff(trace.slip)).sum()) for trace in scene.clean)
        self.scale = 10 ** rng.uniform(-0.6, 0.3) * (path if self.law == "path" else total)
        self.exponent = float(rng.uniform(0.3, 1.0))

    def reset(self):
        self.worn, self.left = 0.0, 1.0

    def limits(self, base):
        high = self.left * base
        return -high, high

    def after(self, now):
        self.worn += abs(now.moved) if self.law == "path" else now.heat
        x = self.worn / self.scale
        if self.law == "hyperbolic":
            shape = 1.0 / (1.0 + x)
        elif self.law == "power":
            shape = (1.0 + x) ** -self.exponent
        else:
            shape = np.exp(-x)
        self.left = 1.0 - 0.7 * self.strength * (1.0 - shape)

    def describe(self):
        return {
            "law": self.law,
            "final_loss_limit": 0.7 * self.strength,
            "scale_J_or_m": self.scale,
            "exponent": self.exponent,
        }


class AsymmetricFriction(Scaled):
    """Elements break free earlier one way than the other."""

    name = "asymmetric_friction"
    acts = frozenset({"limits"})

    def draw(self, scene, rng):
        self.weaker = str(rng.choice(["positive", "negative"]))
        self.shared = bool(rng.random() < 0.5)  # or one side alone changes

    def limits(self, base):
        loss = 0.6 * self.strength
        weak = 1.0 - loss
        strong = 1.0 + loss if self.shared else 1.0
        if self.weaker == "positive":
            return -strong * base, weak * base
        return -weak * base, strong * base

    def describe(self):
        loss = 0.6 * self.strength
        return {
            "weaker": self.weaker,
            "weak_factor": 1.0 - loss,
            "strong_factor": 1.0 + loss if self.shared else 1.0,
        }


class DisplacementDrift(Scaled):
    """The displacement sensor wanders: straight, or slowly bending."""

    name = "displacement_drift"
    kind = "measurement"
    acts = frozenset({"read_displacement"})

    def draw(self, scene, rng):
        self.law = str(rng.choice(["linear", "root", "exponential"], p=[0.6, 0.15, 0.25]))
        self.most = 0.5 * scene.largest("displacement") * rng.choice([-1.0, 1.0])
        self.over = scene.duration
        self.constant = self.over * rng.uniform(0.8, 3.0)

    def read_displacement(self, trace):
        t = trace.time
        if self.law == "linear":
            shape = t / self.over
        elif self.law == "root":
            shape = np.sqrt((t + 0.1 * self.over) / self.over) - np.sqrt(0.1)
        else:
            shape = -np.expm1(-t / self.constant) / -np.expm1(-self.over / self.constant)
        return trace.displacement + self.strength * self.most * shape

    def describe(self):
        return {
            "law": self.law,
            "total_m": self.strength * self.most,
            "over_s": self.over,
            "time_constant_s": self.constant if self.law == "exponential" else None,
        }


FIRST = [
    Pinning,
    ViscousDamping,
    Clearance,
    PreloadLoss,
    AsymmetricFriction,
    DisplacementDrift,
]
