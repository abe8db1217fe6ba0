"""The measurements of a scorecard: which cases each puts, round by round, and where marks go."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from .begun import LASTING
from .bench import Bench, Task, run
from .effects import CATALOGUE, FOREIGN
from .follow_up import FollowUp, follow_up_said
from .marks import Marks, fingerprint
from .noise import KINDS

STRENGTHS = (0.1, 0.3, 1.0, 5.0)  # misfit after refit over noise
CLEAN_PER_ROUND, PAIRS_PER_ROUND = 25, 20  # clean ones of every kind of noise
BEGUN_PER_ROUND = 12  # with an effect, and as many clean
PAIR_STRENGTH = 2.0  # of each of the two alone


def power(seed, turn, effects=None, strengths=STRENGTHS, noise=None):
    """Every effect of the catalogue once at every strength, no scene twice."""
    names = [*CATALOGUE]
    return [
        Task(seed, number, (name,), (strength, strength), noise, "power")
        for i, strength in enumerate(STRENGTHS)
        for j, name in enumerate(names)
        if name in (effects or names) and strength in strengths
        for number in [10_000 * i + 100 * turn + j]
    ]


def foreign(seed, turn, strengths=STRENGTHS):
    """Every effect outside the catalogue once at every strength."""
    return [
        Task(seed, 10_000 * i + 100 * turn + 50 + j, (name,), (strength, strength), None, "foreign")
        for i, strength in enumerate(STRENGTHS)
        for j, name in enumerate(FOREIGN)
        if strength in strengths
    ]


def clean(seed, turn, kinds=KINDS, count=CLEAN_PER_ROUND):
    """Records without any effect, under every kind of noise."""
    return [
        Task(seed, 50_000 + 2_000 * k + turn * count + j, ("clean",), (1.0, 1.0), kind, "clean")
        for k, kind in enumerate(KINDS)
        if kind in kinds
        for j in range(count)
    ]


def pairs(seed, turn, ratio=PAIR_STRENGTH, count=PAIRS_PER_ROUND, noise=None):
    """Two effects at once, drawn from the seed."""
    return [
        Task(seed, 60_000 + turn * count + j, (), (ratio, ratio), noise, "pairs")
        for j in range(count)
    ]


def begun(seed, turn, count=BEGUN_PER_ROUND):
    """Records of no virgin joint at zero: as many clean ones as with an effect.

    Those cut or moved have one that lasts; as many again are of one joint through all files.
    """
    tasks = []
    for first, names, goes_on in ((70_000, LASTING, False), (80_000, tuple(CATALOGUE), True)):
        first += 2 * turn * count
        names = np.random.default_rng([seed, first]).choice(names, size=count)
        tasks += [
            Task(seed, first + 2 * j + k, (str(name),), span, None, "begun", goes_on)
            for j in range(count)
            for k, (name, span) in enumerate((("clean", (1.0, 1.0)), (names[j], (1.0, 5.0))))
        ]
    return tasks


PLANS = {"power": power, "foreign": foreign, "clean": clean, "pairs": pairs, "begun": begun}


def measure(tasks, iwan, directory, jobs, more=()):
    """Marks of the tasks of one measurement, kept in DIR/MEASUREMENT.jsonl; papers are not."""
    name = tasks[0].measurement
    path = Path(directory) / f"{name}.jsonl"
    bench = Bench(iwan, str(Path(directory) / "scratch"), more, keep=False)
    with Marks(path, tasks[0].seed, fingerprint(iwan)) as marks:
        return run(tasks, bench, jobs, marks)


def follow(tasks, marks, iwan, directory, jobs):
    """The experiment after the first for every case of these that ended ambiguous."""
    still = [
        replace(task, measurement="follow_up")
        for task, mark in zip(tasks, marks, strict=True)
        if mark.get("ambiguous_with")
    ]
    if not still:
        return []
    path = Path(directory) / "follow_up.jsonl"
    work = FollowUp(iwan, str(Path(directory) / "scratch"), keep=False)
    with Marks(path, still[0].seed, fingerprint(iwan)) as known:
        return run(still, work, jobs, known, follow_up_said)


def rounds(seed, count, iwan, directory, jobs, only=None):
    """One round after another of all measurements; yields after each, when a card may be drawn."""
    for turn in range(count):
        print(f"== round {turn + 1} of {count}, seed {seed}", flush=True)
        for name, plan in PLANS.items():
            if only and name not in only:
                continue
            tasks = plan(seed, turn)
            marks = measure(tasks, iwan, directory, jobs)
            if name == "power" and (not only or "follow_up" in only):
                follow(tasks, marks, iwan, directory, jobs)
        yield turn + 1
