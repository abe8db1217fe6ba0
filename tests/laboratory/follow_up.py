"""The experiment after the first: the same hidden joint and effect under a given load, or a
monolithic dummy through the same measuring chain, and what a finder says then."""

import json
from pathlib import Path

import numpy as np
from scipy.interpolate import PchipInterpolator

from . import csvfile, noise, rig
from .blind import diagnose
from .case import draw_case, stage_case, write_case
from .score import judge, share

FINE = 4  # steps of the rig between two samples
CAUTION = (1.0, 0.8, 0.65)  # of the largest force, where the joint slips away under it
SI = {"force": "N", "length": "m", "swap": False}


def _restage(truth):
    ratio = truth["ratio_asked"] or None
    return stage_case(truth["seed"], truth["case"], truth["effect"], ratio)


def read_load(path):
    """(time, command, by force) of a load program: `time [s]`, and `force [N]` or
    `displacement [m]`."""
    lines = [line for line in Path(path).read_text(encoding="utf-8").splitlines() if line.strip()]
    lines = [line for line in lines if not line.startswith("#")]
    header = [name.strip() for name in lines[0].split(",")]
    table = np.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    columns = dict(zip(header, table.T, strict=True))
    by_force = "force [N]" in columns
    return columns["time [s]"], columns["force [N]" if by_force else "displacement [m]"], by_force


def _noisy(staged, rng, time, force, displacement, by_force):
    """Channels as the laboratory records them."""
    response = displacement if by_force else force
    level = staged.rms
    if by_force != staged.scene.by_force:
        level = staged.level * float(np.sqrt(np.mean(response**2)))
    response = response + noise.noise(rng, len(time), level, staged.colour)
    return (time, force, response) if by_force else (time, response, displacement)


def measure(staged, rng, time, command, by_force, fine_steps=FINE):
    """The hidden joint with its effect, virgin, under a command sampled at even steps."""
    grid = np.linspace(time[0], time[-1], fine_steps * (len(time) - 1) + 1)
    fine = PchipInterpolator(time, command)(grid)
    trace = rig.drive(staged.scene.joint, grid, fine, by_force, staged.effect)
    every = slice(None, None, fine_steps)
    force = staged.effect.read_force(trace)[every]
    displacement = staged.effect.read_displacement(trace)[every]
    return _noisy(staged, rng, time, force, displacement, by_force)


def run_load(truth, load, directory):
    """Measure the case of `truth` under `load`; writes DIR/test-next.csv and returns its path."""
    truth = json.loads(Path(truth).read_text(encoding="utf-8"))
    staged = _restage(truth)
    rng = np.random.default_rng([truth["seed"], truth["case"], 1001])
    record = measure(staged, rng, *read_load(load))
    path = Path(directory) / "test-next.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    csvfile.write_record(path, *record, SI, ["joint test", "the next one"])
    return path


def measure_dummy(truth, directory):
    """A solid specimen, stiff as the joint at rest, under the first load of the case and through
    its measuring chain; writes DIR/dummy.csv and returns its path."""
    truth = json.loads(Path(truth).read_text(encoding="utf-8"))
    staged = _restage(truth)
    scene, effect = staged.scene, staged.effect
    compliance = 1.0 / scene.joint.network_stiffness + 1.0 / scene.joint.series
    first, clean = scene.histories[0], scene.clean[0]
    # Driven as the joint was: the dummy bears the same force at the same time.
    force, displacement = clean.force, clean.force * compliance
    still = np.zeros_like(force)
    trace = rig.Trace(clean.time, force, displacement, still, still)
    effect.dt = float(clean.time[1] - clean.time[0])
    every = slice(None, None, first.fine)
    rng = np.random.default_rng([truth["seed"], truth["case"], 1002])
    channels = (effect.read_force(trace)[every], effect.read_displacement(trace)[every])
    record = _noisy(staged, rng, clean.time[every], *channels, scene.by_force)
    path = Path(directory) / "dummy.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    csvfile.write_record(path, *record, SI, ["solid specimen"])
    return path


def _limits(truth, caution=1.0):
    """What the rig can do: nearly full slip, ten times the rate, the time of the first tests."""
    fastest = max(max(f["rates_Hz"]) for f in truth["files"])
    seconds = sum(f["duration_s"] for f in truth["files"])
    limits = {"--limit-rate": 10.0 * fastest, "--limit-duration": seconds}
    if truth["drive"] == "force":
        most = truth["peak"] * max(1.0, 0.95 / truth["peak_share_of_full_slip"])
        limits["--limit-force"] = caution * most
    return tuple(word for option, value in limits.items() for word in (option, repr(value)))


def follow_up(seed, number, name, span, iwan, directory, by_dummy=False):
    """One case before and after: marks of both, or only the first where nothing was ambiguous."""
    folder = Path(directory) / f"case-{number:04d}"
    records, truth, style = draw_case(seed, number, name, span=span)
    write_case(folder, records, truth, style)
    return followed(folder, truth, iwan, by_dummy)


def followed(folder, truth, iwan, by_dummy=False):
    """The drawn case of a folder before and after."""
    folder, name, number = Path(folder), truth["effect"], truth["case"]
    paths = sorted((folder / "records").glob("*.csv"))
    hidden = folder / "truth.json"
    more = ()
    for caution in CAUTION:
        before, reason, _ = diagnose(iwan, paths, folder / "before", _limits(truth, caution))
        if before is None:
            return {"case": number, "effect": name, "failed": reason}
        marks = {"case": number, "effect": name, "before": judge(truth, before), "after": None}
        if not marks["before"]["ambiguous_with"] or not marks["before"]["in_set"]:
            return marks
        load = folder / "before" / "next_experiment.csv"
        if by_dummy:
            more = ("--dummy", str(measure_dummy(hidden, folder)))
            break
        if not load.exists():
            return marks
        try:
            paths = [*paths, run_load(hidden, load, folder)]
            break
        except rig.Infeasible as slipped:
            # The joint slips away under this load: the engineer asks again with less force.
            marks["slipped"] = str(slipped)
    else:
        return marks
    after, reason, _ = diagnose(iwan, paths, folder / "after", more)
    marks["promised"] = before["next_experiment"]
    marks["after"] = judge(truth, after) if after else None
    marks["failed"] = reason
    return marks


def follow_ups(seed, cases, iwan, directory, effects, span=(1.0, 2.0), by_dummy=False):
    """Cases of the given effects in turn; the share of ambiguous ones that are right alone and
    right first after the experiment (or the dummy). Writes DIR/follow_up.json."""
    marks = []
    for number in range(cases):
        name = effects[number % len(effects)]
        try:
            mark = follow_up(seed, number, name, span, iwan, directory, by_dummy)
        except (RuntimeError, rig.Infeasible) as reason:
            mark = {"case": number, "effect": name, "failed": str(reason)}
        marks.append(mark)
        said = [
            " ".join([*m["named"], *(f"or {a}" for a in m["ambiguous_with"])]) if m else "-"
            for m in (mark.get("before"), mark.get("after"))
        ]
        print(f"{number:4d} {name:<20} {said[0]} -> {said[1]}", flush=True)
    settled = [m["after"] for m in marks if m.get("after")]
    result = {
        "schema": "laboratory-follow-up/1",
        "seed": seed,
        "by": "dummy" if by_dummy else "experiment",
        "alone_after": share(sum(m["alone"] for m in settled), len(settled)),
        "first_after": share(sum(m["first"] for m in settled), len(settled)),
        "cases": marks,
    }
    path = Path(directory) / "follow_up.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    for key in ("alone_after", "first_after"):
        print(f"{key:<14} {result[key]['count']} of {result[key]['of']}")
    print(f"seed {seed}")
    return result
