"""Records as rigs leave them: cut from a longer test, or driven by a channel whose zero is off."""

import numpy as np

from .effects import CATALOGUE

CUT = (0.1, 0.4)  # part of a file's samples that is left out in front
ZERO = (0.1, 0.3)  # of the largest drive, either way
ONCE = (
    "offset_step",
    "preload_loss",
    "running_in",
    "slack_growth",
)  # a cut may hold nothing of them
STREAM = 90_000  # of the seed: no attempt at a scene has it
LASTING = tuple(name for name in CATALOGUE if name not in ONCE)


def begin(seed, number, records, truth):
    """(records, truth) with every file cut at a place of its own, or with one zero for all files.

    The noise goes with its samples; the joint's state at the first of them is whatever went before.
    """
    rng = np.random.default_rng([seed, number, STREAM])
    driving = 1 if truth["drive"] == "force" else 2
    if rng.random() < 0.5:
        shares = rng.uniform(*CUT, size=len(records))
        first = [int(share * len(r[0])) for share, r in zip(shares, records, strict=True)]
        records = [tuple(c[k:] for c in r) for k, r in zip(first, records, strict=True)]
        heard = [(t[k:], e[k:]) for k, (t, e) in zip(first, truth["heard"], strict=True)]
        return records, {**truth, "heard": heard, "beginning": {"way": "cut", "samples": first}}
    largest = max(float(np.max(np.abs(r[driving]))) for r in records)
    zero = float(rng.choice([-1.0, 1.0]) * rng.uniform(*ZERO)) * largest
    moved = [tuple(c + zero * (k == driving) for k, c in enumerate(r)) for r in records]
    return moved, {**truth, "beginning": {"way": "zero", "reads_at_rest": zero}}
