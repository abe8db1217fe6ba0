"""All effects by name: those of the finder's catalogue and those outside of it."""

from .effects_catalogue import FIRST
from .rig import Effect

CATALOGUE = {effect.name: effect for effect in FIRST}
FOREIGN: dict = {}
EFFECTS = {"clean": Effect, **CATALOGUE, **FOREIGN}
NEEDS_HOLDS: set = set()
