"""resonator.ssp run by two native importers, against the master of the example: libcosim, and the
program `ecos`, in whose process there is no Python.

    python package.py IWAN FOLDER

Leaves in FOLDER/libcosim.txt and FOLDER/ecos.txt the largest difference of the joint's force over
its largest, from the second step on; libcosim writes its log to the standard output.
"""

import csv
import importlib.resources
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
from libcosimpy.CosimEnums import CosimVariableType
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples" / "resonator"))

import resonator  # noqa: E402

FORCE = 0  # value reference of the joint's force, the same in every export


def libcosim(package: Path, folder: Path) -> np.ndarray:
    """Force at the end of every step."""
    unpacked = folder / "resonator"
    with zipfile.ZipFile(package) as content:
        content.extractall(unpacked)
    nanoseconds = round(resonator.STEP * 1e9)
    execution = CosimExecution.from_ssp_file(ssp_path=str(unpacked), step_size=nanoseconds)
    count = round(resonator.DURATION / resonator.STEP)
    observer = CosimObserver.create_time_series(buffer_size=count + 1)
    execution.add_observer(observer)
    index = execution.slave_index_from_instance_name("joint")
    observer.start_time_series(index, FORCE, CosimVariableType.REAL)
    if not execution.simulate_until(round(resonator.DURATION * 1e9)):
        raise RuntimeError("libcosim stopped before the end")
    _, _, force = observer.time_series_real_samples(index, FORCE, 1, count)
    return np.array(force)


def ecos(package: Path, folder: Path) -> np.ndarray:
    """Force at the end of every step; the program writes six decimals."""
    program = ecos_program(folder)
    steps = ["--stopTime", str(resonator.DURATION), "--stepSize", str(resonator.STEP)]
    command = [program, "simulate", "--path", package.resolve(), *steps]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    with (folder / "resonator.csv").open() as file:
        rows = list(csv.reader(file, skipinitialspace=True))
    column = rows[0].index("joint::force[REAL]")
    return np.array([float(row[column]) for row in rows[2:]])


def ecos_program(folder: Path) -> Path:
    """The program `ecos`, which the package ecospy holds without leave to be run."""
    (source,) = importlib.resources.files("ecospy").joinpath("binaries").glob("ecos")
    program = folder.resolve() / "ecos"
    shutil.copy(source, program)
    program.chmod(0o755)
    return program


def main() -> int:
    """Command line."""
    iwan, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    joint = resonator.export_joint(iwan, folder)
    package = resonator.package(joint, resonator.build_bodies(folder), folder)
    run, count = resonator.decay(joint), round(resonator.DURATION / resonator.STEP)
    for importer in (libcosim, ecos):
        force = importer(package, folder)
        if len(force) != count:
            raise RuntimeError(f"{importer.__name__}: {len(force)} samples instead of {count}")
        apart = resonator.difference(force, run)
        (folder / f"{importer.__name__}.txt").write_text(f"{apart!r}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
