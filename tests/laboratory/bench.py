"""The bench: draws the cases of a list, shows the finder the files alone, keeps its marks."""

import json
import shutil
import subprocess
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

from . import begun
from .case import draw_case, write_case
from .observed import hidden_of, observe
from .pair import draw_pair
from .score import Unreadable, failure, judge, said

LIMIT = 600.0  # [s] a diagnosis may take


@dataclass(frozen=True)
class Task:
    """One case to draw, by what it is asked for."""

    seed: int
    number: int
    effects: tuple  # one name, two planted together, or none: a pair by the seed
    span: tuple = (1.0, 5.0)  # of the misfit after refit over the noise
    noise: str | None = None
    measurement: str = "blind"
    goes_on: bool = False  # one joint through all files

    @property
    def key(self):
        """What sets the case apart from all others of the seed."""
        low, high = self.span
        parts = (self.measurement, self.number, "+".join(self.effects) or "pair")
        return " ".join([*map(str, parts), f"{low:g}:{high:g}", self.noise or "as drawn"])

    def draw(self):
        """(records, truth, style)."""
        if len(self.effects) == 1:
            name = self.effects[0]
            how = {"span": self.span, "noise": self.noise, "goes_on": self.goes_on}
            drawn = draw_case(self.seed, self.number, name, **how)
            if self.measurement != "begun" or self.goes_on:
                return drawn
            records, truth, style = drawn
            return *begun.begin(self.seed, self.number, records, truth), style
        return draw_pair(self.seed, self.number, self.effects, self.span[0], self.noise)


@dataclass(frozen=True)
class Bench:
    """Where the finder is, what it is told besides the files, and where its papers go."""

    iwan: str
    directory: str
    more: tuple = ()
    keep: bool = True  # records and findings stay; without, the marks alone

    def __call__(self, task):
        """Marks of one case."""
        folder = Path(self.directory) / f"case-{task.number:04d}"
        asked = {
            "measurement": task.measurement,
            "case": task.number,
            "asked": list(task.span),
            "noise_asked": task.noise,
        }
        try:
            records, truth, style = task.draw()
        except RuntimeError as reason:
            name = "+".join(task.effects) or "pair"
            return {**asked, "effect": name, "not_drawn": str(reason)}
        paths = write_case(folder, records, truth, style)
        diagnosis, reason, took = diagnose(self.iwan, paths, folder / "found", self.more)
        if diagnosis is None:
            marks = failure(truth, reason)
        else:
            try:
                marks = {**judge(truth, diagnosis), **observe(truth, diagnosis)}
            except (Unreadable, KeyError, TypeError, AttributeError) as broken:
                marks = failure(truth, f"contract: {broken!r}")
        if not self.keep:
            shutil.rmtree(folder, ignore_errors=True)
        return {**asked, **marks, **hidden_of(truth), "seconds": took}


def diagnose(iwan, records, folder, more=()):
    """Run the command line on the files alone; (diagnosis or None, reason, seconds)."""
    shutil.rmtree(folder, ignore_errors=True)
    began = time.monotonic()
    try:
        done = subprocess.run(
            [str(iwan), "diagnose", *map(str, records), "-o", str(folder), *more],
            capture_output=True,
            text=True,
            timeout=LIMIT,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return None, f"no answer in {LIMIT:.0f} s", LIMIT
    except OSError as error:
        return None, str(error), 0.0
    took = time.monotonic() - began
    if done.returncode != 0:
        return None, f"exit status {done.returncode}: {done.stderr.strip()[-300:]}", took
    try:
        return json.loads((folder / "diagnosis.json").read_text(encoding="utf-8")), None, took
    except (OSError, ValueError) as error:
        return None, f"diagnosis.json: {error}", took


def run(tasks, work, jobs, marks, line=said):
    """Marks of all tasks in their order; those already in `marks` are not done again.

    `work` takes a task and returns its marks, in `jobs` processes; `line` tells them.
    """
    waiting = [task for task in tasks if task.key not in marks.known]
    if len(waiting) < len(tasks):
        print(f"{len(tasks) - len(waiting)} of {len(tasks)} cases are already marked", flush=True)
    with ProcessPoolExecutor(max_workers=jobs) as pool:
        futures = {pool.submit(work, task): task for task in waiting}
        try:
            for done in as_completed(futures):
                mark = done.result()
                marks.add(futures[done].key, mark)
                print(line(mark), flush=True)
        except BaseException:
            pool.shutdown(cancel_futures=True)  # what has begun is finished, and kept
            for future, task in futures.items():
                if not future.cancelled() and not future.exception():
                    if task.key not in marks.known:
                        marks.add(task.key, future.result())
            raise
    return [marks.known[task.key] for task in tasks]
