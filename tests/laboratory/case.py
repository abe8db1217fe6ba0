"""One blind case: joint, campaign, effect of known strength, noise; files and the truth apart."""

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from . import csvfile, loads
from .effects import CATALOGUE, EFFECTS, NEEDS_HOLDS
from .effects_instrument import HALVINGS
from .joints import draw_joint
from .noise import Noise, draw_colour
from .noise import noise as gaussian
from .refit import Baseline
from .rig import Effect, Infeasible
from .scene import Scene

FLOOR = 0.2  # the clean record must refit to this fraction of its noise
STRAIGHT = 0.2  # of the cases go straight from sample to sample
CLOCK = 0.1  # of the noise is what halving the rig's steps may still change
# Scenes drawn for a case: for a friction drop at five times the noise ninety were once refused.
ATTEMPTS = 160


class Unreachable(Exception):
    """The effect cannot be made as strong (or as weak) as asked for in this scene."""


class Sampled:
    """Channels of a campaign at the sampled points, in SI, without noise."""

    def __init__(self, scene, traces, effect):
        self.force, self.displacement, self.time = [], [], []
        for history, trace in zip(scene.histories, traces, strict=True):
            every = slice(None, None, history.fine)
            self.time.append(trace.time[every])
            self.force.append(effect.read_force(trace)[every])
            self.displacement.append(effect.read_displacement(trace)[every])
        by_force = scene.by_force
        self.drive = self.force if by_force else self.displacement
        self.response = self.displacement if by_force else self.force


class Gauge:
    """Measures what an effect leaves after the best refit, reusing the dictionary where it can."""

    def __init__(self, scene):
        self.scene = scene
        self.clean = Sampled(scene, scene.clean, Effect())
        self.known = self.clean.drive
        self.baseline = self._refit(self.known)
        self.floor = self.baseline.misfit(self.clean.response)
        self.rms = float(np.sqrt(np.mean(np.concatenate(self.clean.response) ** 2)))

    def _refit(self, drives):
        return Baseline(drives, self.scene.by_force, self.scene.goes_on)

    def __call__(self, effect):
        acts = effect.acts
        only_sensor = acts <= {"read_force", "read_displacement"}
        traces = self.scene.clean if only_sensor else self.scene.play(effect)
        sampled = Sampled(self.scene, traces, effect)
        same = all(
            np.allclose(a, b, rtol=1e-9, atol=1e-9 * np.max(np.abs(b)))
            for a, b in zip(sampled.drive, self.known, strict=True)
        )
        baseline = self.baseline if same else self._refit(sampled.drive)
        return baseline.misfit(sampled.response), sampled


def calibrate(gauge, effect, target):
    """Scale the effect until its misfit after refit is the target; (achieved, channels).

    Secant steps in logarithms within a bracket, to 3 %.
    """
    low, high = 0.0, 1.0
    trial, tried = 0.05, []
    for _ in range(12):
        effect.strength = trial
        try:
            found, sampled = gauge(effect)
        except Infeasible:
            high = trial
            trial = 0.5 * (low + high)
            tried = []
            continue
        if abs(found / target - 1.0) < 0.03:
            return found, sampled
        if found < target:
            low = trial
            if trial >= 1.0:
                raise Unreachable("too weak at full strength")
        else:
            high = trial
        tried.append((np.log(trial), np.log(max(found, 1e-3 * target))))
        slope = 1.0
        if len(tried) > 1:
            (x0, y0), (x1, y1) = tried[-2:]
            if x1 != x0:
                slope = float(np.clip((y1 - y0) / (x1 - x0), 0.3, 4.0))
        guess = float(np.exp(tried[-1][0] + (np.log(target) - tried[-1][1]) / slope))
        if not low < guess < high:
            if high == 1.0 and guess >= 1.0:
                guess = 1.0
            else:
                guess = (low * high) ** 0.5 if low > 0.0 else 0.2 * high
        trial = guess
    raise Unreachable("no strength gives this ratio")


def _scene(rng, names, goes_on):
    joint = draw_joint(rng)
    needed = not NEEDS_HOLDS.isdisjoint(names)
    histories = loads.draw_campaign(rng, holds=needed or rng.random() < 0.12)
    if goes_on and len(histories) < 2:
        raise Unreachable("one file goes on from none")
    # Of a stream of its own: the joints and loads of a seed stay what they were.
    if rng.spawn(1)[0].random() < STRAIGHT:
        histories = [h.straight() for h in histories]
    by_force = bool(rng.random() < 0.65)
    if by_force:
        share = rng.uniform(0.3, 0.95)
        peak = share * joint.full_slip
    else:
        # Displacement at which this share of full slip would be carried by sticking contacts alone.
        share = 10 ** rng.uniform(np.log10(0.3), np.log10(4.0))
        soft = 1.0 / joint.network_stiffness + 1.0 / joint.series
        peak = share * joint.full_slip * soft
    return Scene.stage(joint, histories, by_force, float(peak), goes_on), float(share)


@dataclass
class Staged:
    """A case before its noise: what is hidden, what it gives, and the state of the draw."""

    seed: int
    number: int
    names: tuple  # of the effects; ("clean",) where there is none
    ratio: float  # asked of each effect
    found: tuple  # misfit that each leaves alone [unit of the response]
    scene: Scene
    share: float
    gauge: Gauge
    effect: Effect
    sampled: Sampled
    level: float
    noise: Noise
    noise_asked: str | None  # kind; None: as drawn
    rng: np.random.Generator
    refused: list

    @property
    def rms(self):
        """Noise of the response [its unit]."""
        return self.level * self.gauge.rms


def stage_scene(rng, names, ratio, noise_kind, goes_on=False):
    """(scene, share of full slip, gauge, level, noise) in which the effects may be planted.

    Raises Unreachable where the clean record itself does not refit well enough.
    """
    scene, share = _scene(rng, names, goes_on)
    gauge = Gauge(scene)
    level = 10 ** rng.uniform(-3.0, -2.0)
    kind = Noise.of(noise_kind, draw_colour(rng))
    most = FLOOR if names == ("clean",) else min(FLOOR, 0.3 * ratio)
    if gauge.floor > most * level * gauge.rms:
        floor = gauge.floor / (level * gauge.rms)
        raise Unreachable(f"sampling error {floor:.2f} of the noise")
    return scene, share, gauge, level, kind


def converged(scene, effect, sampled, noise):
    """The channels with the rig's steps halved until they no longer show in the noise.

    Dampers, limits and memories are taken by steps, to first order: what comes of a long one is the
    rig's, not the joint's.
    """
    if effect.acts <= {"read_force", "read_displacement"}:
        return sampled
    for _ in range(HALVINGS):
        scene = replace(scene, histories=[h.halved() for h in scene.histories])
        finer = Sampled(scene, scene.play(effect), effect)
        pairs = zip(finer.response, sampled.response, strict=True)
        changed = float(np.std(np.concatenate([a - b for a, b in pairs])))
        sampled = finer
        if changed <= CLOCK * noise:
            return sampled
    raise Unreachable("the rig's steps would show")


def planted(name, scene, rng, gauge, target, noise, refused):
    """(effect, misfit, channels) of one effect that leaves the target alone, in three drafts."""
    for _ in range(3):
        try:
            effect = EFFECTS[name](scene, rng)
            found, sampled = calibrate(gauge, effect, target)
            return effect, found, converged(scene, effect, sampled, noise)
        except (Unreachable, Infeasible) as reason:
            refused.append(str(reason))
    raise Unreachable(f"no draft of {name} would do")


def stage_case(
    seed, number, name=None, ratio=None, span=(1.0, 5.0), pool=None, noise=None, goes_on=False
):
    """The hidden joint and effect of a case; the same arguments give the same ones.

    The joint is made new for every file, or `goes_on` through all of them.
    Scenes in which the effect cannot reach the ratio at a sensible strength are drawn again; the
    truth says how often.
    """
    first = np.random.default_rng([seed, number])
    name = name or str(first.choice(pool or [*EFFECTS]))
    ratio = float(ratio if ratio is not None else np.exp(first.uniform(*np.log(span))))
    refused = []
    for attempt in range(ATTEMPTS):
        rng = np.random.default_rng([seed, number, attempt])
        try:
            scene, share, gauge, level, kind = stage_scene(rng, (name,), ratio, noise, goes_on)
            effect, found, sampled = Effect(), gauge.floor, gauge.clean
            if name != "clean":
                noise_rms = level * gauge.rms
                target = ratio * noise_rms
                effect, found, sampled = planted(
                    name, scene, rng, gauge, target, noise_rms, refused
                )
        except (Unreachable, Infeasible, RuntimeError) as reason:
            refused.append(str(reason))
            continue
        head = (seed, number, (name,), ratio, (found,), scene, share, gauge, effect, sampled)
        return Staged(*head, level, kind, noise, rng, refused)
    raise RuntimeError(f"case {number} ({name}): {refused}")


def record(staged):
    """(records, what is true of them, style): the case as the laboratory's sensors write it.

    `heard` is the noise itself, time and error of every file: too long for truth.json.
    """
    scene, sampled, level, rng = staged.scene, staged.sampled, staged.level, staged.rng
    drive_noise = 0.0 if rng.random() < 0.5 else float(0.05 * level * rng.uniform(0.2, 1.0))
    offset = float(rng.normal(0.0, 0.005)) if scene.by_force and rng.random() < 0.4 else 0.0
    records, heard = [], []
    errors = staged.noise.files(rng, staged.rms, sampled.force)
    for j, time in enumerate(sampled.time):
        heard.append(next(errors))
        response = sampled.response[j] + heard[-1]
        response = response + offset * np.max(np.abs(sampled.response[j]))
        size = drive_noise * np.std(sampled.drive[j])
        drive = sampled.drive[j] + gaussian(rng, len(time), size, 0.0)
        pair = (drive, response) if scene.by_force else (response, drive)
        records.append((time, *pair))
    truth = {
        "refit_floor_over_noise": staged.gauge.floor / staged.rms,
        "noise": {
            "kind": staged.noise.kind,
            "asked": staged.noise_asked,
            "response_rms": staged.rms,
            "realised_rms": float(np.sqrt(np.mean(np.concatenate(heard) ** 2))),
            "of_response_rms": level,
            "lag_one_correlation": staged.noise.colour,
            "drive_rms_share": drive_noise,
        },
        "heard": list(zip(sampled.time, heard, strict=True)),
        "drive": "force" if scene.by_force else "displacement",
        "peak_share_of_full_slip": staged.share,
        "peak": scene.peak,
        "joint": scene.joint.describe(),
        "files": [h.describe() for h in scene.histories],
        "drawn_again": staged.refused,
        **({"beginning": {"way": "goes_on"}} if scene.goes_on else {}),
    }
    return records, truth, csvfile.draw_style(rng)


def draw_case(
    seed, number, name=None, ratio=None, span=(1.0, 5.0), pool=None, noise=None, goes_on=False
):
    """(records, truth, style) of one case; records are (time, force, displacement) in SI, noisy."""
    staged = stage_case(seed, number, name, ratio, span, pool, noise, goes_on)
    records, measured, style = record(staged)
    (name,), effect, hidden = staged.names, staged.effect, staged.names != ("clean",)
    truth = {
        "schema": "laboratory-truth/1",
        "seed": seed,
        "case": number,
        "effect": name,
        "in_catalogue": name in CATALOGUE,
        "kind": getattr(effect, "kind", None) if hidden else None,
        "parameters": effect.describe(),
        "strength": getattr(effect, "strength", 0.0),
        "ratio_asked": staged.ratio if hidden else 0.0,
        "ratio_achieved": staged.found[0] / staged.rms if hidden else 0.0,
        **measured,
    }
    return records, truth, style


def write_case(directory, records, truth, style):
    """Records into DIR/records, the truth beside it, never among them."""
    directory = Path(directory)
    folder = directory / "records"
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.csv"):
        old.unlink()
    paths = []
    for j, record in enumerate(records, start=1):
        path = folder / f"test-{j}.csv"
        csvfile.write_record(path, *record, style, ["joint test", f"file {j} of {len(records)}"])
        paths.append(path)
    told = {key: value for key, value in truth.items() if key != "heard"}
    (directory / "truth.json").write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    return paths
