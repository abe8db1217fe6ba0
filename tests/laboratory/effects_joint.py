"""The remaining joint effects of the finder's catalogue."""

import numpy as np

from .effects_catalogue import Damper, Scaled, softplus


class QuadraticDamping(Damper):
    """Turbulent drag."""

    name = "quadratic_damping"

    def draw(self, scene, rng):
        self.most = 0.5 * scene.largest("force") / self.place(scene, rng) ** 2

    def damper(self, velocity):
        c = self.strength * self.most
        return c * velocity * abs(velocity), 2.0 * c * abs(velocity)

    def describe(self):
        return {"coefficient_Ns2_per_m2": self.strength * self.most, "where": self.where}


class SlackGrowth(Scaled):
    """Bearing damage: the hole elongates with the highest load yet, and the play with it."""

    name = "slack_growth"
    acts = frozenset({"series", "after"})

    def draw(self, scene, rng):
        self.most = scene.largest("displacement")
        self.top = scene.largest("force")
        self.begins = self.top * rng.uniform(0.1, 0.4)
        self.power = float(rng.uniform(1.0, 2.0))
        self.seat = self.top * 10 ** rng.uniform(-2.3, -1.5)

    def reset(self):
        self.largest, self.half = 0.0, 0.0

    def after(self, now):
        if abs(now.network) > self.largest:
            self.largest = abs(now.network)
            beyond = max(self.largest - self.begins, 0.0) / (self.top - self.begins)
            self.half = 0.5 * self.strength * self.most * beyond**self.power

    def series(self, force):
        y = np.tanh(force / self.seat)
        return self.half * y, self.half / self.seat * (1.0 - y * y)

    def describe(self):
        return {
            "gap_at_peak_m": self.strength * self.most,
            "begins_at_N": self.begins,
            "power": self.power,
            "seating_force_N": self.seat,
        }


def hyperbolic(b, x, hardens):
    """Direct (or inverse) hyperbolic sine of unit slope at rest, less the line, and its slope."""
    if b == 0.0:
        return 0.0, 0.0
    if hardens:
        x = min(max(x, -3.0), 3.0)
        return np.sinh(b * x) / b - x, np.cosh(b * x) - 1.0
    return np.arcsinh(b * x) / b - x, 1.0 / np.sqrt(1.0 + (b * x) ** 2) - 1.0


class Spring(Scaled):
    """An elastic law in one of three places: in series, across the joint or across its contact."""

    acts = frozenset({"series", "across"})

    def place(self, scene, rng, shares):
        """Draw the place, and the force and displacement that the law is told in."""
        self.where = str(rng.choice(["series", "across", "contact"], p=shares))
        self.acts = frozenset({self.where})
        self.top = scene.largest("force")
        self.way = scene.largest("slip" if self.where == "contact" else "displacement")

    def across(self, displacement):
        return self.beside(displacement)

    def contact(self, slip):
        return self.beside(slip)


class CubicStiffness(Spring):
    """A spring hardens or softens."""

    name = "cubic_stiffness"

    def draw(self, scene, rng):
        self.place(scene, rng, [0.5, 0.3, 0.2])
        self.hardens = bool(rng.random() < (0.6 if self.where == "series" else 0.8))
        self.soft = 1.0 / scene.joint.series

    def series(self, force):
        # Displacement over force: what hardens gives less.
        law, slope = hyperbolic(2.5 * self.strength, force / self.top, not self.hardens)
        return self.soft * self.top * law, self.soft * slope

    def beside(self, displacement):
        law, slope = hyperbolic(2.5 * self.strength, displacement / self.way, self.hardens)
        return 0.5 * self.top * law, 0.5 * self.top / self.way * slope

    def describe(self):
        return {
            "where": self.where,
            "hardens": self.hardens,
            "curvature": 2.5 * self.strength,
        }


class JointOpening(Spring):
    """The seat gives more in tension than in compression, or bears on one side of rest."""

    name = "joint_opening"

    def draw(self, scene, rng):
        self.place(scene, rng, [0.6, 0.2, 0.2])
        self.side = float(rng.choice([-1.0, 1.0]))
        share = rng.uniform(0.01, 0.08)
        self.round = self.top * share
        self.near = self.way * share
        self.most = self.way / self.top

    def series(self, force):
        give = self.strength * self.most
        y, slope = softplus(self.side * force / self.round)
        return self.side * give * self.round * (y - np.log(2.0)), give * slope

    def beside(self, displacement):
        bears = self.strength / self.most
        y, slope = softplus(self.side * displacement / self.near)
        return self.side * bears * self.near * (y - np.log(2.0)), bears * slope

    def describe(self):
        if self.where == "series":
            return {
                "opens": "positive" if self.side > 0 else "negative",
                "compliance_added_m_per_N": self.strength * self.most,
                "rounding_N": self.round,
            }
        return {
            "bears": "positive" if self.side > 0 else "negative",
            "where": self.where,
            "stiffness_added_N_per_m": self.strength / self.most,
            "rounding_m": self.near,
        }


class NormalLoadVariation(Scaled):
    """Break-free forces follow the load or the displacement, exponentially."""

    name = "normal_load_variation"
    acts = frozenset({"limits", "after"})

    def draw(self, scene, rng):
        self.follows = str(rng.choice(["force", "displacement"]))
        self.sign = float(rng.choice([-1.0, 1.0]))
        self.top = scene.largest(self.follows)

    def reset(self):
        self.seen = 0.0

    def limits(self, base):
        high = np.exp(self.sign * self.strength * self.seen) * base
        return -high, high

    def after(self, now):
        self.seen = (now.network if self.follows == "force" else now.displacement) / self.top
        self.seen = min(max(self.seen, -2.0), 2.0)

    def describe(self):
        return {"follows": self.follows, "log_change_at_peak": self.sign * self.strength}


class RunningIn(Scaled):
    """Friction or stiffness settles over the first cycles: mostly up, as asperities bed in."""

    name = "running_in"
    acts = frozenset({"limits", "series", "after"})

    def draw(self, scene, rng):
        self.of = "friction" if rng.random() < 0.6 else "stiffness"
        self.sign = -1.0 if rng.random() < 0.7 else 1.0  # below or above the settled value
        self.length = scene.largest("slip") * rng.uniform(2.0, 10.0)
        self.soft = 0.5 * scene.largest("displacement") / scene.largest("force")

    def reset(self):
        self.path = 0.0

    def left(self):
        """Share of the change that is still to come."""
        return 1.0 / (1.0 + (self.path / self.length) ** 1.5)

    def limits(self, base):
        if self.of == "stiffness":
            return -base, base
        high = (1.0 + self.sign * 0.5 * self.strength * self.left()) * base
        return -high, high

    def series(self, force):
        if self.of == "friction":
            return 0.0, 0.0
        # Fresh surfaces are softer, or what makes them softer comes with the way.
        share = self.left() if self.sign < 0 else 1.0 - self.left()
        slope = self.strength * self.soft * share
        return slope * force, slope

    def after(self, now):
        self.path += abs(now.moved)

    def describe(self):
        change = self.sign * 0.5 * self.strength
        if self.of == "stiffness":
            change = -self.sign * self.strength * self.soft
        return {"of": self.of, "initial_change": change, "length_m": self.length}


RESOLVED = 12  # steps of the rig in the memory of a rate


class _RateState(Scaled):
    """Friction that follows the slip rate, felt over a short memory."""

    acts = frozenset({"limits", "after"})

    def draw(self, scene, rng):
        typical = max(
            float(np.sqrt(np.mean(np.gradient(t.slip, t.time) ** 2))) for t in scene.clean
        )
        self.reference = typical * 10 ** rng.uniform(-2.0, -0.7)
        # Limits of one step act in the next: with a memory of few of them what is recorded is the
        # rig's clock, by several times the noise where the joint is near full slip.
        coarsest = max(float(h.time[1] - h.time[0]) for h in scene.histories)
        self.memory = max(0.015 / scene.fastest, RESOLVED * coarsest)

    def reset(self):
        self.rate = 0.0

    def after(self, now):
        keep = np.exp(-now.dt / self.memory)
        self.rate = keep * self.rate + (1.0 - keep) * abs(now.moved) / now.dt

    def limits(self, base):
        high = self.factor(self.rate / self.reference) * base
        return -high, high


class RateDependentFriction(_RateState):
    """Friction grows with the logarithm of the slip rate."""

    name = "rate_dependent_friction"

    def factor(self, x):
        """Break-free factor at a relative rate."""
        return 1.0 + 0.1 * self.strength * np.arcsinh(x)

    def describe(self):
        return {
            "per_e_fold": 0.1 * self.strength,
            "reference_rate_m_per_s": self.reference,
            "memory_s": self.memory,
        }


class VelocityWeakening(_RateState):
    """Friction falls from its value at rest to a lower one at speed."""

    name = "velocity_weakening"

    def factor(self, x):
        """Break-free factor at a relative rate."""
        return 1.0 - 0.4 * self.strength * x / (1.0 + x)

    def describe(self):
        return {
            "final_fall": 0.4 * self.strength,
            "reference_rate_m_per_s": self.reference,
            "memory_s": self.memory,
        }


class StaticFrictionDrop(Scaled):
    """Every element breaks away above the force at which it then slides, and sticks anew."""

    name = "static_friction_drop"
    acts = frozenset({"limits", "after"})

    def draw(self, scene, rng):
        self.sliding = np.zeros(len(scene.joint.limits), dtype=bool)

    def reset(self):
        self.sliding[:] = False

    def limits(self, base):
        high = np.where(self.sliding, base, (1.0 + self.strength) * base)
        return -high, high

    def after(self, now):
        np.logical_not(now.stuck, out=self.sliding)

    def describe(self):
        return {"breakaway_over_kinetic": 1.0 + self.strength}


class Creep(Scaled):
    """Something in the load path yields with time: Kelvin elements over two decades."""

    name = "creep"
    acts = frozenset({"series", "after"})

    def draw(self, scene, rng):
        slow = 10 ** rng.uniform(-0.5, 0.8) / (2 * np.pi * scene.slowest)
        self.times = slow * np.array([0.1, 1.0, 10.0])
        self.shares = rng.dirichlet([1.0, 2.0, 1.0])
        self.most = scene.largest("displacement") / scene.largest("force")

    def reset(self):
        self.crept = np.zeros(3)

    def _weights(self):
        return self.dt / (self.times + self.dt)

    def series(self, force):
        w = self._weights()
        give = self.strength * self.most * self.shares
        now = (1.0 - w) * self.crept + w * give * force
        return float(now.sum()), float((w * give).sum())

    def after(self, now):
        w = self._weights()
        give = self.strength * self.most * self.shares
        self.crept = (1.0 - w) * self.crept + w * give * now.network

    def describe(self):
        return {
            "compliances_m_per_N": [float(x) for x in self.strength * self.most * self.shares],
            "times_s": [float(x) for x in self.times],
        }


MORE = [
    QuadraticDamping,
    SlackGrowth,
    CubicStiffness,
    JointOpening,
    NormalLoadVariation,
    RunningIn,
    RateDependentFriction,
    VelocityWeakening,
    StaticFrictionDrop,
    Creep,
]
