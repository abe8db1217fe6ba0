"""The example records: a bolted joint made by the laboratory with one hidden effect."""

import json
from pathlib import Path

import numpy as np

from . import csvfile, loads, noise
from .case import Gauge, Staged, calibrate
from .effects_catalogue import Pinning
from .joints import Joint, levels
from .scene import Scene

RATIO, LEVEL = 4.0, 0.004  # of the effect over the noise, and of that over the response
COMMENTS = [
    "bolted lap joint, driven by force, stepped sine at {rate:g} Hz",
    "made by the virtual laboratory (tests/laboratory): a simulated joint with one hidden effect",
    "and noise; the answer is in bolt_truth.json",
]


def _test(rate, spc, steps, repeats):
    fine = 4
    tape = loads.Tape(1.0 / (rate * spc * fine))
    for level in steps:
        tape.ramp(1.0, rate, level)
        tape.cycles(repeats, rate)
    tape.ramp(1.0, rate, 0.0)
    command = tape.play()
    time = tape.step * np.arange(len(command))
    return loads.History(time, command, fine, "stepped_sine", [rate])


def stage(seed):
    """The example before its noise, as a case that further loads may be played on."""
    rng = np.random.default_rng(seed)
    chi, n = -0.4, 400
    reach = levels(rng, n) ** (1.0 / (1.0 + chi))
    full_slip, stiffness = 6.0e3, 2.4e8
    joint = Joint(
        "power_law",
        stiffness / n,
        reach * full_slip / reach.sum(),
        0.0,
        3.0e8,
        {"chi": chi, "fraction_at_limit": 0.0},
    )
    steps = [0.35, 0.55, 0.75, 0.9, 1.0]
    histories = [_test(2.0, 120, steps, 4), _test(20.0, 120, steps, 4)]
    scene = Scene.stage(joint, histories, True, 0.72 * full_slip)
    effect = Pinning(scene, rng)
    effect.sides, effect.share, effect.law = "both", (1.0, 0.6), "power"
    effect.gaps, effect.power = scene.largest("slip") * np.array([0.45, 0.62]), 1.25
    gauge = Gauge(scene)
    found, sampled = calibrate(gauge, effect, RATIO * LEVEL * gauge.rms)
    head = (seed, 0, (effect.name,), RATIO, (found,), scene, 0.72, gauge, effect, sampled)
    return Staged(*head, LEVEL, noise.Noise("white"), None, rng, [])


def make(directory, seed=20010811):
    """Write bolt-1.csv, bolt-2.csv and bolt_truth.json."""
    staged = stage(seed)
    scene, gauge, effect, sampled = staged.scene, staged.gauge, staged.effect, staged.sampled
    (found,), rms = staged.found, staged.rms
    style = {"force": "N", "length": "m", "swap": False}
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    for j, history in enumerate(scene.histories):
        measured = sampled.displacement[j] + noise.noise(staged.rng, history.samples, rms, 0.0)
        csvfile.write_record(
            directory / f"bolt-{j + 1}.csv",
            sampled.time[j],
            sampled.force[j],
            measured,
            style,
            [line.format(rate=history.rates[0]) for line in COMMENTS],
            digits=6,
        )
    truth = {
        "schema": "laboratory-truth/1",
        "effect": effect.name,
        "kind": effect.kind,
        "parameters": effect.describe(),
        "ratio_achieved": found / rms,
        "refit_floor_over_noise": gauge.floor / rms,
        "noise": {"response_rms": rms, "of_response_rms": LEVEL, "lag_one_correlation": 0.0},
        "joint": scene.joint.describe(),
        "peak_force_N": scene.peak,
        "seed": seed,
    }
    path = directory / "bolt_truth.json"
    path.write_text(json.dumps(truth, indent=1) + "\n", encoding="utf-8")
    return path
