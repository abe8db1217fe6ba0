"""The joint of examples/resonator as an engineer would export it with pythonfmu: 200 sliders.

Parallel spring-slider pairs under the report's midpoint rule for the four-parameter density, driven
in displacement behind a series spring, which takes a bisection per step.
"""

import numpy as np
from pythonfmu import Fmi2Causality, Fmi2Slave, Real

SLIP_FORCE, STIFFNESS, EXPONENT, RATIO, SERIES = 1000.0, 1.5e7, -0.4, 0.3, 4e7
SLIDERS = 200


class PythonJoint(Fmi2Slave):
    """One joint."""

    def __init__(self, **kwargs):
        """Sliders of equal spacing and the one that slips last."""
        super().__init__(**kwargs)
        self.displacement = self.force = self.dissipation = self.stored_energy = 0.0
        self.register_variable(Real("displacement", causality=Fmi2Causality.input))
        for name in ("force", "dissipation", "stored_energy"):
            self.register_variable(Real(name, causality=Fmi2Causality.output))
        share = RATIO + (EXPONENT + 1) / (EXPONENT + 2)
        limit = SLIP_FORCE * (1 + RATIO) / (STIFFNESS * share)
        density = SLIP_FORCE * (EXPONENT + 1) / (limit ** (EXPONENT + 2) * share)
        last = SLIP_FORCE / limit * RATIO / share
        width = limit / SLIDERS
        middle = (np.arange(SLIDERS) + 0.5) * width
        self.limits = np.append(middle, limit)
        self.weights = np.append(density * middle**EXPONENT * width, last)
        self.stretch = np.zeros(SLIDERS + 1)
        self.network = 0.0

    def _stretched(self, step):
        return np.clip(self.stretch + step, -self.limits, self.limits)

    def do_step(self, current_time, step_size):
        """The network's share of the displacement by bisection."""
        low, high = -1e-3, 1e-3
        for _ in range(60):
            middle = 0.5 * (low + high)
            force = float(self.weights @ self._stretched(middle - self.network))
            low, high = (
                (low, middle) if middle + force / SERIES > self.displacement else (middle, high)
            )
        stretch = self._stretched(middle - self.network)
        slid = (middle - self.network) - (stretch - self.stretch)
        self.dissipation += float(self.weights @ np.abs(slid * self.limits))
        self.stretch, self.network = stretch, middle
        self.force = float(self.weights @ stretch)
        self.stored_energy = float(self.weights @ stretch**2) / 2 + self.force**2 / (2 * SERIES)
        return True
