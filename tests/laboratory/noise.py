"""Noise of the channels: white or first-order coloured."""

import numpy as np
from scipy.signal import lfilter


def draw_colour(rng):
    """Lag-one correlation: zero (white) or up to 0.9."""
    return 0.0 if rng.random() < 0.5 else float(rng.uniform(0.3, 0.9))


def noise(rng, n, rms, colour):
    """Gaussian noise of given rms and lag-one correlation."""
    white = rng.standard_normal(n + 200)
    coloured = lfilter([np.sqrt(1.0 - colour**2)], [1.0, -colour], white)[200:]
    return rms * coloured
