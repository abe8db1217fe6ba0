"""Noise of the channels: white, first-order coloured, growing with the load, with outliers, or both
white and slow."""

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

KINDS = ("white", "autoregressive", "load_dependent", "outliers", "white_and_slow")
CORRELATION = 0.9  # from sample to sample, where the kind is asked for
QUIET, LOUD = 0.3, 1.7  # standard deviation at no load and at the largest, before scaling
OUTLIERS, WILD = 0.01, 10.0  # share of the samples, and their size over the others'
# Of a converter and an amplifier: the share of the slow part in the variance, and its correlation
# from sample to sample, each drawn evenly.
PART, SLOW = (0.3, 0.7), (0.85, 0.96)


def draw_colour(rng):
    """Lag-one correlation: zero (white) or up to 0.9."""
    return 0.0 if rng.random() < 0.5 else float(rng.uniform(0.3, 0.9))


def noise(rng, n, rms, colour):
    """Gaussian noise of given rms and lag-one correlation."""
    white = rng.standard_normal(n + 200)
    coloured = lfilter([np.sqrt(1.0 - colour**2)], [1.0, -colour], white)[200:]
    return rms * coloured


@dataclass(frozen=True)
class Noise:
    """The kind of noise on a response, and its lag-one correlation."""

    kind: str
    colour: float = 0.0

    @classmethod
    def of(cls, kind, drawn):
        """The kind asked for; without one white or coloured by the correlation drawn."""
        if kind is None:
            return cls("autoregressive" if drawn > 0.0 else "white", drawn)
        if kind not in KINDS:
            raise ValueError(f"no noise of kind {kind!r}; known: {', '.join(KINDS)}")
        return cls(kind, CORRELATION if kind == "autoregressive" else 0.0)

    def files(self, rng, rms, loads):
        """The noise of one file after another under these forces [N]; over all the rms is as given.

        Outliers come on top of that rms: it is the noise of the other samples.
        """
        top = max(float(np.max(np.abs(load))) for load in loads)
        loud = [QUIET + (LOUD - QUIET) * np.abs(load) / top for load in loads]
        norm = float(np.sqrt(np.mean(np.concatenate(loud) ** 2)))
        part, slow = 0.0, 0.0
        if self.kind == "white_and_slow":
            part, slow = rng.uniform(*PART), rng.uniform(*SLOW)
        for shape in loud:
            x = noise(rng, len(shape), rms * np.sqrt(1.0 - part), self.colour)
            if part > 0.0:
                x += noise(rng, len(shape), rms * np.sqrt(part), slow)
            if self.kind == "load_dependent":
                x *= shape / norm
            elif self.kind == "outliers":
                x[rng.random(len(x)) < OUTLIERS] *= WILD
            yield x
