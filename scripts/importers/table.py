"""Runs an exported joint and its pythonfmu counterpart in every importer and prints one table.

    python table.py --iwan IWAN --folder FOLDER [--readme README.md]

With --readme the table replaces what stands between its markers there, with the day of the run.
"""

import argparse
import datetime
import importlib.metadata
import json
import platform
import subprocess
import sys
from pathlib import Path

import numpy as np
from fmpy.validation import validate_fmu

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
STEP, ROWS, LARGEST = 1e-3, 4001, 8e-5
MARKERS = ("<!-- importers -->", "<!-- /importers -->")
# An importer that agrees differs by the order of a sum.
AGREES = 1e-9


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


def run(importer: str, archive: Path, folder: Path, reference: np.ndarray) -> str:
    """Difference and time per step of one importer, or how it failed."""
    out = folder / f"{importer}-{archive.stem}.npz"
    out.unlink(missing_ok=True)
    command = [sys.executable, HERE / "run.py", importer, archive, folder / "load.npy", out]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        return "failed: no end after 120 s"
    (folder / f"{importer}-{archive.stem}.log").write_text(done.stdout + done.stderr)
    if done.returncode != 0 or not out.exists():
        ended = f"signal {-done.returncode}" if done.returncode < 0 else "an error"
        return f"failed with {ended}"
    with np.load(out) as found:
        rows, seconds = found["rows"], float(found["seconds"])
    apart = np.abs(rows - reference).max(axis=0) / np.abs(reference).max(axis=0)
    return f"{apart.max():.1e}; {1e6 * seconds / len(rows):.1f} µs per step"


def fmi_crate(iwan: Path, archive: Path, folder: Path) -> str:
    """Difference by `iwan check`, which loads the unit through the `fmi` crate."""
    command = [iwan, "check", archive, folder / "load.csv", "--json"]
    done = subprocess.run(command, capture_output=True, text=True)
    (folder / f"fmi-{archive.stem}.log").write_text(done.stdout + done.stderr)
    if done.returncode != 0:
        return "failed with an error"
    found = json.loads(done.stdout)
    return f"{max(d['relative_difference'] for d in found['differences']):.1e}"


def coupled(iwan: Path, folder: Path) -> dict[str, str]:
    """The package of examples/resonator in native importers."""
    inside = folder / "package"
    found = {name: inside / f"{name}.txt" for name in ("libcosim", "ecos")}
    for path in found.values():
        path.unlink(missing_ok=True)
    command = [sys.executable, HERE / "package.py", iwan, inside]
    done = subprocess.run(command, capture_output=True, text=True)
    (folder / "package.log").write_text(done.stdout + done.stderr)
    return {
        name: f"{float(path.read_text()):.1e} to the example's own master"
        if path.exists()
        else "failed with an error"
        for name, path in found.items()
    }


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


def crate_version(name: str) -> str:
    """Version of a crate in Cargo.lock."""
    lock = (ROOT / "Cargo.lock").read_text().split("[[package]]")
    (entry,) = [e for e in lock if f'name = "{name}"\n' in e]
    return entry.split('version = "')[1].split('"')[0]


def table(iwan: Path, folder: Path) -> str:
    """Markdown."""
    displacement = load()
    np.save(folder / "load.npy", displacement)
    reference = expected(iwan, folder, displacement)
    ours, theirs = folder / "joint.fmu", folder / "PythonJoint.fmu"
    export = [iwan, "export", ROOT / "examples/resonator/joint.json", "-o", ours]
    subprocess.run([*export, "--drive", "displacement"], check=True, capture_output=True)
    build = [sys.executable, "-m", "pythonfmu", "build", "-f", HERE / "pythonfmu_joint.py"]
    subprocess.run([*build, "-d", folder], check=True, capture_output=True)
    version = importlib.metadata.version
    lines = [
        "| importer | iwan | pythonfmu " + version("pythonfmu") + ", 200 sliders |",
        "|---|---|---|",
    ]
    for name in ("fmpy", "libcosimpy", "ecospy"):
        cells = [run(name, archive, folder, reference) for archive in (ours, theirs)]
        lines.append(f"| {name} {version(name)} | {cells[0]} | {cells[1]} |")
    own = fmi_crate(iwan, ours, folder)
    lines.append(
        f"| `fmi` crate {crate_version('fmi')} (`iwan check`) | {own} | not run: reads joint.json |"
    )
    package = coupled(iwan, folder)
    lines.append(
        f"| libcosimpy {version('libcosimpy')}, resonator.ssp | {package['libcosim']} | not run |"
    )
    alone = without_python(theirs, folder)
    lines.append(
        f"| program `ecos` {version('ecospy')}, resonator.ssp | {package['ecos']} | "
        f"its own archive alone: {alone} |"
    )
    remarks = [len(validate_fmu(str(archive))) for archive in (ours, theirs)]
    lines.append(f"| remarks of fmpy's validation | {remarks[0]} | {remarks[1]} |")
    sizes = [archive.stat().st_size / 1024 for archive in (ours, theirs)]
    lines.append(f"| size of the archive | {sizes[0]:.0f} KiB | {sizes[1]:.0f} KiB |")
    return "\n".join(lines)


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--iwan", type=Path, required=True)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--readme", type=Path)
    arguments = parser.parse_args()
    lines = table(arguments.iwan, arguments.folder)
    day = datetime.datetime.now(datetime.UTC).date().isoformat()
    where = f"{platform.system()} {platform.machine()}, Python {platform.python_version()}"
    text = (
        f"{lines}\n\nRun on {day} ({where}). Largest difference to `iwan simulate` of force, "
        f"dissipation and stored energy,\nrelative to each one's largest value, over "
        f"{ROWS - 1} steps of a growing two-tone displacement.\n"
    )
    print(text)
    if arguments.readme:
        page = arguments.readme.read_text(encoding="utf-8")
        begin, end = (page.index(marker) for marker in MARKERS)
        page = page[: begin + len(MARKERS[0])] + "\n" + text + page[end:]
        arguments.readme.write_text(page, encoding="utf-8")
    # The joint must run everywhere; what the other tool's does is only told.
    rows = [line.split("|")[2].strip() for line in lines.splitlines()[2:6]]
    agree = [not r.startswith("failed") and float(r.split(";")[0]) <= AGREES for r in rows]
    packages = [line.split("|")[2] for line in lines.splitlines()[6:8]]
    return 0 if all(agree) and not any("failed" in cell for cell in packages) else 1


if __name__ == "__main__":
    sys.exit(main())
