"""Draws the icon of exported joints: a bolted lap joint over its hysteresis loop.

    python scripts/icon.py src/pack/icon.png

The picture is committed; this draws it anew after a wanted change.
"""

import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np

mpl.use("agg")
import matplotlib.pyplot as plt
from matplotlib.patches import Rectangle

LOOP, PLATE, BOLT = "#0072b2", "#c3c8d0", "#1d2430"


def masing(turn: float, x: np.ndarray) -> np.ndarray:
    """A branch of a softening joint from the turning point at -turn."""
    return 2.0 * np.tanh((x + turn) / 2.0 * 1.6) - np.tanh(turn * 1.6)


def main() -> int:
    """Command line."""
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    figure = plt.figure(figsize=(1.28, 1.28), dpi=100)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(-1.25, 1.25), ylim=(-1.25, 1.25))
    axes.axis("off")
    axes.add_patch(Rectangle((-1.2, 0.0), 1.7, 0.28, color=PLATE))
    axes.add_patch(Rectangle((-0.5, -0.28), 1.7, 0.28, color="#9aa2ae"))
    axes.add_patch(Rectangle((-0.09, -0.55), 0.18, 1.1, color=BOLT))
    axes.add_patch(Rectangle((-0.24, 0.28), 0.48, 0.2, color=BOLT))
    axes.add_patch(Rectangle((-0.24, -0.48), 0.48, 0.2, color=BOLT))
    x = np.linspace(-1.0, 1.0, 200)
    axes.plot(x, masing(1.0, x) * 1.1, color=LOOP, lw=2.2)
    axes.plot(-x, -masing(1.0, x) * 1.1, color=LOOP, lw=2.2)
    # Without metadata the same program draws the same bytes.
    figure.savefig(Path(sys.argv[1]), format="png", transparent=True, metadata={"Software": None})
    return 0


if __name__ == "__main__":
    sys.exit(main())
