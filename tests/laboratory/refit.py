"""The best joint without any effect: what a refitted ideal joint leaves of a record.

A response of any joint obeying Masing's rule is a non-negative sum of play operators of the force,
or of stop operators of the displacement. The misfit that remains is what the effect really shows.
"""

import numpy as np
from scipy.optimize import nnls


def _thresholds(reach):
    """About 150 thresholds: dense towards zero and towards the largest value reached."""
    near = np.geomspace(2e-3, 1.0, 60)
    far = 1.0 - np.geomspace(2e-4, 0.5, 50)
    even = np.linspace(0.01, 0.99, 50)
    return reach * np.unique(np.round(np.concatenate([near[:-1], far, even]), 6))


def play_columns(drive, reach, before=None):
    """Drive and its plays, a column per threshold; they begin as those `before` ended."""
    r = _thresholds(reach)
    out = np.empty((len(drive), len(r) + 1))
    out[:, 0] = drive
    p = np.zeros_like(r) if before is None else before.copy()
    for i, x in enumerate(drive):
        np.minimum(np.maximum(p, x - r, out=p), x + r, out=p)
        out[i, 1:] = p
    return out


def _halves(drives, by_force, goes_on):
    reach = max(np.max(np.abs(d)) for d in drives)
    before = None
    for drive in drives:
        columns = play_columns(drive, reach, before)
        if goes_on:
            before = columns[-1, 1:].copy()
        if not by_force:  # a stop is the drive less its play
            columns[:, 1:] = drive[:, None] - columns[:, 1:]
        yield columns


class Baseline:
    """Dictionary of one campaign, factored once; refits any response on it."""

    def __init__(self, drives, by_force, goes_on=False):
        blocks = list(_halves(drives, by_force, goes_on))
        rows, width = sum(len(b) for b in blocks), blocks[0].shape[1]
        a = np.zeros((rows, width + 2 * len(blocks)))
        at = 0
        for j, block in enumerate(blocks):
            a[at : at + len(block), :width] = block
            a[at : at + len(block), width + 2 * j] = 1.0  # an offset of either sign
            a[at : at + len(block), width + 2 * j + 1] = -1.0
            at += len(block)
        self.scale = np.linalg.norm(a, axis=0)
        self.scale[self.scale == 0.0] = 1.0
        self.q, self.r = np.linalg.qr(a / self.scale)

    def misfit(self, responses):
        """Root mean square of what the best refit leaves [unit of the response]."""
        y = np.concatenate(responses)
        projected = self.q.T @ y
        beyond = max(float(y @ y - projected @ projected), 0.0)
        try:
            _, inside = nnls(self.r, projected, maxiter=40 * self.r.shape[1])
        except RuntimeError:  # cycling on a degenerate set: a tiny ridge settles it
            size = self.r.shape[1]
            ridge = np.vstack([self.r, 1e-7 * np.eye(size)])
            x, _ = nnls(ridge, np.append(projected, np.zeros(size)), maxiter=400 * size)
            inside = float(np.linalg.norm(self.r @ x - projected))
        return float(np.sqrt((beyond + inside**2) / len(y)))
