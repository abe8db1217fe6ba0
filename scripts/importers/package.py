"""The packages of examples/resonator run by two native importers, against the example's own master:
libcosim, and the program `ecos`, in whose process there is no Python.

    python package.py IWAN FOLDER libcosim|ecos displacement|force

The second names what the joint is driven in. Leaves in FOLDER/IMPORTER-DRIVE.txt the largest
difference of the velocity of the bodies over its largest, from the second step on; libcosim writes
its log to the standard output.
"""

import csv
import importlib.resources
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples" / "resonator"))

import masters  # noqa: E402
import resonator  # noqa: E402

VELOCITY = 3  # value reference in both units of the bodies


def libcosim(package: Path, folder: Path) -> np.ndarray:
    """Velocity at the end of every step."""
    from libcosimpy.CosimEnums import CosimVariableType
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver

    unpacked = folder / package.stem
    with zipfile.ZipFile(package) as content:
        content.extractall(unpacked)
    nanoseconds = round(masters.STEP * 1e9)
    execution = CosimExecution.from_ssp_file(ssp_path=str(unpacked), step_size=nanoseconds)
    count = round(masters.DURATION / masters.STEP)
    observer = CosimObserver.create_time_series(buffer_size=count + 1)
    execution.add_observer(observer)
    index = execution.slave_index_from_instance_name("bodies")
    observer.start_time_series(index, VELOCITY, CosimVariableType.REAL)
    if not execution.simulate_until(round(masters.DURATION * 1e9)):
        raise RuntimeError("libcosim stopped before the end")
    _, _, velocity = observer.time_series_real_samples(index, VELOCITY, 1, count)
    return np.array(velocity)


def ecos(package: Path, folder: Path) -> np.ndarray:
    """Velocity at the end of every step; the program writes six decimals."""
    program = ecos_program(folder)
    steps = ["--stopTime", str(masters.DURATION), "--stepSize", str(masters.STEP)]
    command = [program, "simulate", "--path", package.resolve(), *steps]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    with (folder / f"{package.stem}.csv").open() as file:
        rows = list(csv.reader(file, skipinitialspace=True))
    column = rows[0].index("bodies::velocity[REAL]")
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
    iwan, folder, name, drive = Path(sys.argv[1]), Path(sys.argv[2]), *sys.argv[3:5]
    importer = {"libcosim": libcosim, "ecos": ecos}[name]
    folder.mkdir(parents=True, exist_ok=True)
    joint = resonator.export_joint(iwan, folder, drive)
    archive = resonator.package(joint, resonator.build_bodies(folder, drive), folder, drive)
    velocity, count = importer(archive, folder), round(masters.DURATION / masters.STEP)
    if len(velocity) != count:
        raise RuntimeError(f"{name}: {len(velocity)} samples instead of {count}")
    apart = masters.difference(velocity, masters.decay(joint), "velocity")
    (folder / f"{name}-{drive}.txt").write_text(f"{apart!r}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
