"""All effects by name: those of the finder's catalogue and those outside of it."""

from . import effects_foreign
from .effects_catalogue import FIRST
from .rig import Effect

CATALOGUE = {effect.name: effect for effect in FIRST}
FOREIGN = {effect.name: effect for effect in effects_foreign.FOREIGN}
EFFECTS = {"clean": Effect, **CATALOGUE, **FOREIGN}
NEEDS_HOLDS = {"ageing"}
