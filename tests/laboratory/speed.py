"""How long a diagnosis takes: drawn joints and effects under records of a stated length."""

import os
from pathlib import Path

import numpy as np

from . import csvfile
from .bench import diagnose
from .case import stage_case
from .follow_up import SI, measure

LEVELS = (0.3, 0.5, 0.7, 0.9, 1.0, 0.6)  # of the case's peak
REPEATS = 5  # cycles at each level
RATES = (1.0, 3.0, 10.0)  # of the case's slowest rate, one record each


def draw(seed, number, samples, rates=RATES):
    """(effect, records): the case under stepped sines, records of together `samples` samples."""
    staged = stage_case(seed, number, None, None, span=(1.0, 5.0))
    rng = np.random.default_rng([seed, number, 1003])
    slowest = min(min(history.rates) for history in staged.scene.histories)
    each = samples // len(rates)
    cycles = REPEATS * len(LEVELS)
    phase = cycles * np.arange(each) / each
    level = np.repeat(LEVELS, REPEATS)[phase.astype(int)]
    command = staged.scene.peak * level * np.sin(2 * np.pi * phase)
    records = [
        measure(staged, rng, phase / (slowest * rate), command, staged.scene.by_force)
        for rate in rates
    ]
    return staged.names[0], records


def speed(seed, cases, samples, rates, iwan, directory):
    """Time `cases` diagnoses, threads as the finder likes; prints a line each."""
    print(f"seed {seed}, {os.cpu_count()} processors, together {samples} samples of each joint")
    taken = []
    for number in range(cases):
        folder = Path(directory) / f"speed-{number:02d}"
        folder.mkdir(parents=True, exist_ok=True)
        effect, records = draw(seed, number, samples, rates)
        paths = [folder / f"test-{k}.csv" for k in range(1, len(records) + 1)]
        for path, record in zip(paths, records, strict=True):
            csvfile.write_record(path, *record, SI, ["joint test"])
        diagnosis, reason, seconds = diagnose(iwan, paths, folder / "found")
        said = reason or " ".join(
            [diagnosis["verdict"], *(cause["name"] for cause in diagnosis["causes"])]
        )
        taken.append(seconds)
        print(f"{number:3d} {effect:<24} {seconds:6.1f} s  {said}", flush=True)
    print(f"median {np.median(taken):.1f} s, longest {max(taken):.1f} s")
