"""What a case offers an effect to measure itself against: sizes and durations of the clean test."""

from dataclasses import dataclass, replace

import numpy as np

from . import rig

UNLOADING = 40  # steps of the grid from where a test ends to zero


@dataclass
class Scene:
    """A joint under its campaign, and the clean response to it."""

    joint: object
    histories: list
    by_force: bool
    peak: float  # [N] or [m], of the drive
    clean: list  # one Trace per history
    goes_on: bool = False  # every file begins with the joint that the one before left

    @classmethod
    def stage(cls, joint, histories, by_force, peak, goes_on=False):
        """Play the campaign on the ideal joint."""
        scene = cls(joint, histories, by_force, peak, [], goes_on)
        return replace(scene, clean=scene.play(rig.Effect()))

    def play(self, effect):
        """Play the campaign on a joint with this effect; every file starts virgin, or goes on."""
        traces, rest = [], None
        for history in self.histories:
            command = self.peak * history.command
            traces.append(rig.drive(self.joint, history.time, command, self.by_force, effect, rest))
            if self.goes_on:
                rest = self._unload(traces[-1], command[-1], effect)
        return traces

    def _unload(self, trace, last, effect):
        """The specimen after the way back to zero, which no file shows."""
        time = (trace.time[1] - trace.time[0]) * np.arange(UNLOADING + 1)
        back = np.linspace(last, 0.0, UNLOADING + 1)
        return rig.drive(self.joint, time, back, self.by_force, effect, trace.rest).rest

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
