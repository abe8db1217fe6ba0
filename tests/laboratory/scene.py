"""What a case offers an effect to measure itself against: sizes and durations of the clean test."""

from dataclasses import dataclass

import numpy as np

from . import rig


@dataclass
class Scene:
    """A joint under its campaign, and the clean response to it."""

    joint: object
    histories: list
    by_force: bool
    peak: float  # [N] or [m], of the drive
    clean: list  # one Trace per history

    @classmethod
    def stage(cls, joint, histories, by_force, peak):
        """Play the campaign on the ideal joint."""
        clean = [rig.drive(joint, h.time, peak * h.command, by_force) for h in histories]
        return cls(joint, histories, by_force, peak, clean)

    def play(self, effect):
        """Play the campaign on a joint with this effect; every file starts virgin."""
        return [
            rig.drive(self.joint, h.time, self.peak * h.command, self.by_force, effect)
            for h in self.histories
        ]

    def largest(self, quantity):
        """Largest magnitude of a quantity of the clean traces."""
        return max(float(np.max(np.abs(getattr(trace, quantity)))) for trace in self.clean)

    @property
    def fastest(self):
        """Highest rate of the campaign [Hz]."""
        return max(max(h.rates) for h in self.histories)

    @property
    def slowest(self):
        """Lowest rate of the campaign [Hz]."""
        return min(min(h.rates) for h in self.histories)

    @property
    def duration(self):
        """Longest test [s]."""
        return max(float(h.time[-1]) for h in self.histories)

    def fastest_motion(self):
        """Root mean square velocity across the specimen at its fastest file [m/s]."""
        return max(
            float(np.std(np.gradient(trace.displacement, trace.time))) for trace in self.clean
        )
