"""The experiment after the first: the same hidden joint and effect under a given load, or a
monolithic dummy through the same measuring chain, and what a finder says then."""

import json
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import PchipInterpolator

from . import csvfile, demo, rig
from .bench import Task, diagnose, run
from .case import stage_case, write_case
from .effects_instrument import FOLLOW_UP_FINE
from .marks import Marks, fingerprint
from .pair import stage_pair
from .score import judge, print_totals, share

FINE = FOLLOW_UP_FINE
CAUTION = (1.0, 0.8, 0.65)  # of the largest force, where the joint slips away under it
# Of full slip, drawn by the case: what an engineer dares. No multiple of the truth is told.
DARED = (0.8, 0.95)
SI = {"force": "N", "length": "m", "swap": False}


def restage(truth):
    """The case of a truth before its noise, drawn again."""
    if "case" not in truth:
        return demo.stage(truth["seed"])
    ratio, kind = truth["ratio_asked"] or None, truth["noise"]["asked"]
    if "effects" in truth:
        return stage_pair(truth["seed"], truth["case"], truth["effects"], ratio, kind)[0]
    goes_on = truth.get("beginning", {}).get("way") == "goes_on"
    head = (truth["seed"], truth["case"], truth["effect"], ratio)
    return stage_case(*head, noise=kind, goes_on=goes_on)


def _read_at_rest(truth, time, force, displacement):
    """The record with the zero that the driving channel of the case has; it stays with the rig."""
    zero = truth.get("beginning", {}).get("reads_at_rest", 0.0)
    if truth.get("drive") == "displacement":
        return time, force, displacement + zero
    return time, force + zero, displacement


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
    response = response + next(staged.noise.files(rng, level, [force]))
    return (time, force, response) if by_force else (time, response, displacement)


def measure(staged, rng, time, command, by_force, fine_steps=FINE):
    """The hidden joint with its effect, virgin, under a command sampled at even steps."""
    grid = np.linspace(time[0], time[-1], fine_steps * (len(time) - 1) + 1)
    straight = staged.scene.histories[0].is_straight
    between = np.interp if straight else lambda at, x, y: PchipInterpolator(x, y)(at)
    fine = between(grid, time, command)
    trace = rig.drive(staged.scene.joint, grid, fine, by_force, staged.effect)
    every = slice(None, None, fine_steps)
    force = staged.effect.read_force(trace)[every]
    displacement = staged.effect.read_displacement(trace)[every]
    return _noisy(staged, rng, time, force, displacement, by_force)


def run_load(truth, load, directory):
    """Measure the case of `truth` under `load`; writes DIR/test-next.csv and returns its path."""
    truth = json.loads(Path(truth).read_text(encoding="utf-8"))
    staged = restage(truth)
    rng = np.random.default_rng([truth["seed"], truth.get("case", 0), 1001])
    record = _read_at_rest(truth, *measure(staged, rng, *read_load(load)))
    path = Path(directory) / "test-next.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    csvfile.write_record(path, *record, SI, ["joint test", "the next one"])
    return path


def measure_dummy(truth, directory):
    """A solid specimen, stiff as the joint at rest, under the first load of the case and through
    its measuring chain; writes DIR/dummy.csv and returns its path."""
    truth = json.loads(Path(truth).read_text(encoding="utf-8"))
    staged = restage(truth)
    scene, effect = staged.scene, staged.effect
    compliance = 1.0 / scene.joint.network_stiffness + 1.0 / scene.joint.series
    first, clean = scene.histories[0], scene.clean[0]
    # Driven as the joint was: the dummy bears the same force at the same time.
    force, displacement = clean.force, clean.force * compliance
    still = np.zeros_like(force)
    # A solid specimen has no element to hold a force or to slip.
    rest = rig.Rest(np.zeros(0), 0.0, float(displacement[-1]))
    trace = rig.Trace(clean.time, force, displacement, still, still, rest)
    effect.dt = float(clean.time[1] - clean.time[0])
    every = slice(None, None, first.fine)
    rng = np.random.default_rng([truth["seed"], truth.get("case", 0), 1002])
    channels = (effect.read_force(trace)[every], effect.read_displacement(trace)[every])
    record = _noisy(staged, rng, clean.time[every], *channels, scene.by_force)
    record = _read_at_rest(truth, *record)
    path = Path(directory) / "dummy.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    csvfile.write_record(path, *record, SI, ["solid specimen"])
    return path


def _limits(truth, caution=1.0):
    """What the rig can do: some share of full slip, and never less than it did in the first tests;
    ten times their rate, and their time."""
    fastest = max(max(f["rates_Hz"]) for f in truth["files"])
    seconds = sum(f["duration_s"] for f in truth["files"])
    limits = {"--limit-rate": 10.0 * fastest, "--limit-duration": seconds}
    if truth["drive"] == "force":
        dared = np.random.default_rng([truth["seed"], truth["case"], 1003]).uniform(*DARED)
        most = float(truth["peak"] * max(1.0, dared / truth["peak_share_of_full_slip"]))
        limits["--limit-force"] = caution * most
    return tuple(word for option, value in limits.items() for word in (option, repr(value)))


@dataclass(frozen=True)
class FollowUp:
    """Work of `bench.run`: a case before and, where several causes were left, after."""

    iwan: str
    directory: str
    by_dummy: bool = False
    keep: bool = True

    def __call__(self, task):
        """Marks of both diagnoses; `after` is None where nothing was ambiguous or on offer."""
        folder = Path(self.directory) / f"case-{task.number:04d}"
        asked = {"measurement": task.measurement, "case": task.number, "asked": list(task.span)}
        mark = {**asked, "effect": task.effects[0], "before": None, "after": None, "failed": None}
        try:
            mark.update(self._both(task, folder))
        except (RuntimeError, rig.Infeasible) as reason:
            mark["failed"] = str(reason)
        if not self.keep:
            shutil.rmtree(folder, ignore_errors=True)
        return mark

    def _both(self, task, folder):
        records, truth, style = task.draw()
        paths = write_case(folder, records, truth, style)
        hidden = folder / "truth.json"
        more = ()
        for caution in CAUTION:
            limits = _limits(truth, caution)
            before, reason, _ = diagnose(self.iwan, paths, folder / "before", limits)
            if before is None:
                return {"failed": reason}
            marks = {"before": judge(truth, before), "promised": before["next_experiment"]}
            if not marks["before"]["ambiguous_with"]:
                return marks
            if self.by_dummy:
                more = ("--dummy", str(measure_dummy(hidden, folder)))
                break
            load = folder / "before" / "next_experiment.csv"
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
        after, reason, _ = diagnose(self.iwan, paths, folder / "after", more)
        return {**marks, "after": judge(truth, after) if after else None, "failed": reason}


def follow_up_said(mark):
    """One line about a case before and after."""
    told = [
        " ".join([*m["named"], *(f"or {a}" for a in m["ambiguous_with"])]) if m else "-"
        for m in (mark["before"], mark["after"])
    ]
    failed = f"  {mark['failed']}" if mark["failed"] else ""
    return f"{mark['case']:4d} {mark['effect']:<24} {told[0]} -> {told[1]}{failed}"


def follow_up_totals(marks):
    """Shares over the cases that were ambiguous before; one without a program is not settled."""
    open_before = [m for m in marks if m["before"] and m["before"]["ambiguous_with"]]
    offered = [m for m in open_before if m["after"] or m["failed"]]
    promised = [m for m in offered if (m.get("promised") or {}).get("settles")]

    def over(group, mark):
        return share(sum(bool(m["after"] and m["after"][mark]) for m in group), len(group))

    return {
        "ambiguous_before": len(open_before),
        "effect_in_the_set_before": share(
            sum(m["before"]["in_set"] for m in open_before), len(open_before)
        ),
        "experiment_offered": share(len(offered), len(open_before)),
        "first_after": over(offered, "first"),
        "alone_after": over(offered, "alone"),
        "first_where_settlement_was_promised": over(promised, "first"),
        "first_after_of_all_ambiguous": over(open_before, "first"),
    }


def follow_ups(seed, cases, iwan, directory, effects, span=(1.0, 2.0), by_dummy=False, jobs=1):
    """Cases of the given effects in turn, afresh; writes DIR/follow_up.json."""
    names = [effects[number % len(effects)] for number in range(cases)]
    tasks = [Task(seed, j, (name,), span, None, "follow_up") for j, name in enumerate(names)]
    lines = Path(directory) / "follow_up.jsonl"
    lines.unlink(missing_ok=True)
    work = FollowUp(iwan, directory, by_dummy)
    with Marks(lines, seed, fingerprint(iwan)) as known:
        marks = run(tasks, work, jobs, known, follow_up_said)
    result = {
        "schema": "laboratory-follow-up/1",
        "seed": seed,
        "by": "dummy" if by_dummy else "experiment",
        "totals": follow_up_totals(marks),
        "cases": marks,
    }
    path = Path(directory) / "follow_up.json"
    path.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    print_totals(result["totals"], sys.stdout)
    print(f"seed {seed}")
    return result
