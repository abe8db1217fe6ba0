"""Two effects planted at once, each as strong alone as asked for, at different places."""

import numpy as np

from .case import Staged, Unreachable, converged, planted, record, stage_scene
from .effects import CATALOGUE
from .rig import Effect, Infeasible

ALIKE = 0.9  # cosine between two traces from which no finder could tell two effects
ATTEMPTS = 25


class Together(Effect):
    """Two effects in one specimen and its instruments; no place belongs to both."""

    def __init__(self, first, second):
        self.parts = (first, second)
        shared = places(first) & places(second)
        if shared:
            raise ValueError(f"{first.name} and {second.name} share {', '.join(sorted(shared))}")
        self.acts = first.acts | second.acts
        for part in self.parts:
            for place in places(part):
                setattr(self, place, getattr(part, place))

    @property
    def dt(self):
        """Step of the grid [s]."""
        return self.parts[0].dt

    @dt.setter
    def dt(self, value):
        for part in self.parts:
            part.dt = value

    def reset(self):
        for part in self.parts:
            part.reset()

    def after(self, now):
        for part in self.parts:
            if "after" in part.acts:
                part.after(now)


def places(effect):
    """Where an effect acts: the hooks by which the rig feels it."""
    return effect.acts - {"after"}


def candidates():
    """Pairs by kind: (joint and measuring chain, two places of the joint)."""
    joint = [e for e in CATALOGUE.values() if e.kind == "joint"]
    chain = [e for e in CATALOGUE.values() if e.kind == "measurement"]
    mixed = [(a.name, b.name) for a in joint for b in chain]
    within = [
        (a.name, b.name)
        for j, a in enumerate(joint)
        for b in joint[j + 1 :]
        if not places(a) & places(b)
    ]
    return mixed, within


def draw_names(seed, number):
    """The two effects of a case: every third case two of the joint, else one and the chain's."""
    rng = np.random.default_rng([seed, number, 77])
    mixed, within = candidates()
    pool = within if number % 3 == 2 else mixed
    return pool[int(rng.integers(len(pool)))]


def likeness(one, other, both):
    """Cosine between the traces of two effects from the misfits of each and of both."""
    return (both**2 - one**2 - other**2) / (2.0 * one * other)


def stage_pair(seed, number, names=None, ratio=2.0, noise=None):
    """Like `case.stage_case` for two effects; returns (staged, misfit of both together).

    Drawn again where the traces of the two add up or cancel as one would (`ALIKE`).
    """
    names = tuple(names or draw_names(seed, number))
    refused = []
    for attempt in range(ATTEMPTS):
        rng = np.random.default_rng([seed, number, attempt, 2])
        try:
            scene, share, gauge, level, kind = stage_scene(rng, names, ratio, noise)
            noise_rms = level * gauge.rms
            target = ratio * noise_rms
            parts, found = [], []
            for name in names:
                effect, left, _ = planted(name, scene, rng, gauge, target, noise_rms, refused)
                parts.append(effect)
                found.append(left)
            both = Together(*parts)
            left, sampled = gauge(both)
            cosine = likeness(*found, left)
            if abs(cosine) > ALIKE:
                raise Unreachable(f"traces alike, cosine {cosine:.2f}")
            sampled = converged(scene, both, sampled, noise_rms)
        except (Unreachable, Infeasible, RuntimeError) as reason:
            refused.append(str(reason))
            continue
        head = (seed, number, names, ratio, tuple(found), scene, share, gauge, both, sampled)
        return Staged(*head, level, kind, noise, rng, refused), left
    raise RuntimeError(f"case {number} ({' and '.join(names)}): {refused}")


def draw_pair(seed, number, names=None, ratio=2.0, noise=None):
    """(records, truth, style) of one case with two effects."""
    staged, left = stage_pair(seed, number, names, ratio, noise)
    records, measured, style = record(staged)
    rms, parts = staged.rms, staged.effect.parts
    truth = {
        "schema": "laboratory-truth/1",
        "seed": seed,
        "case": number,
        "effects": list(staged.names),
        "kinds": [part.kind for part in parts],
        "parameters": {part.name: part.describe() for part in parts},
        "strengths": [part.strength for part in parts],
        "ratio_asked": staged.ratio,
        "ratios_achieved": [one / rms for one in staged.found],
        "ratio_together": left / rms,
        "likeness": likeness(*staged.found, left),
        **measured,
    }
    return records, truth, style
