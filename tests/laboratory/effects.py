"""All effects by name: those of the finder's catalogue and those outside of it."""

from . import effects_foreign, effects_instrument, effects_joint
from .effects_catalogue import FIRST
from .rig import Effect

CATALOGUE = {
    effect.name: effect for effect in (*FIRST, *effects_joint.MORE, *effects_instrument.MORE)
}
FOREIGN = {effect.name: effect for effect in effects_foreign.FOREIGN}
EFFECTS = {"clean": Effect, **CATALOGUE, **FOREIGN}
NEEDS_HOLDS = {"ageing"}


def in_turn(count, names=None):
    """Effects of `count` cases so that each comes equally often, every fifth case clean.

    With names given, exactly those in turn.
    """
    if names:
        return [names[j % len(names)] for j in range(count)]
    hidden = [name for name in EFFECTS if name != "clean"]
    # Foreign effects spread among the catalogue's, so that a short run meets both.
    order = sorted(range(len(hidden)), key=lambda j: (j * 11) % len(hidden))
    hidden = [hidden[j] for j in order]
    return ["clean" if j % 5 == 0 else hidden[(j - j // 5 - 1) % len(hidden)] for j in range(count)]
