"""Two masses and an exported joint between them: free decay after a blow, in fmpy and as an SSP.

    python examples/resonator/resonator.py FOLDER [--iwan target/release/iwan]

Exports joint.json driven in displacement and driven in force, builds the unit of the two bodies for
either with the system's C compiler, and runs both pairs twice: with the masters of masters.py, and
as packages in fmpy. Writes units, packages and decay.csv into FOLDER and prints the energy balances
and the damping of every cycle beside the closed form.

The arrangement is that of L. Gaul and J. Lenz, Nonlinear dynamics of structures assembled by bolted
joints, Acta Mechanica 125 (1997); the joint is this project's.
"""

import argparse
import json
import os
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path

import fmpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

from masters import (  # noqa: E402
    Decay,
    decay,
    decay_of_package,
    difference,
    imbalance_of_package,
)

HERE = Path(__file__).resolve().parent
# Name of the bodies' source and unit, by what the joint is driven in.
BODIES = {
    "displacement": ("bodies", "Bodies"),
    "force": ("bodies_by_force", "BodiesByForce"),
}
# What the joint answers with.
ANSWER = {"displacement": "force", "force": "displacement"}


@dataclass
class Cycles:
    """Whole cycles of a decay: amplitudes halfway, dissipation in each, times of the peaks."""

    force: np.ndarray
    slip: np.ndarray
    dissipation: np.ndarray
    peaks: np.ndarray

    @staticmethod
    def of(run: Decay) -> "Cycles":
        """From peak to peak of the slip, the first cycle left out: it holds the virgin loading."""
        slip = run.slip_displacement
        inner = (slip[1:-1] >= slip[:-2]) & (slip[1:-1] > slip[2:]) & (slip[1:-1] > 0.0)
        peaks = np.flatnonzero(inner)[1:] + 1
        # Between the samples the top of a parabola; dissipation is flat there.
        top = [vertex(slip[p - 1 : p + 2]) for p in peaks]
        force = [vertex(run.force[p - 1 : p + 2]) for p in peaks]
        middle = [0.5 * (a + b) for a, b in zip(top[:-1], top[1:], strict=True)]
        forces = [0.5 * (a + b) for a, b in zip(force[:-1], force[1:], strict=True)]
        return Cycles(
            np.array(forces), np.array(middle), np.diff(run.dissipation[peaks]), run.time[peaks]
        )


def vertex(three: np.ndarray) -> float:
    """Top of the parabola through three equidistant values."""
    a, b, c = three
    return float(b - (c - a) ** 2 / (8.0 * (a - 2.0 * b + c)))


@dataclass
class ClosedForm:
    """Segalman's four parameters of 2005 and what follows from them without any simulation."""

    slip_force: float
    stiffness: float
    exponent: float
    ratio: float

    @staticmethod
    def read(path: Path) -> "ClosedForm":
        """Of a joint.json."""
        density = json.loads(path.read_text(encoding="utf-8"))["density"]
        return ClosedForm(*(density[k] for k in ("slip_force", "stiffness", "exponent", "ratio")))

    def coefficient(self) -> float:
        """R of rho = R phi^chi, phi being a displacement."""
        chi, share = self.exponent, self.ratio + (self.exponent + 1) / (self.exponent + 2)
        limit = self.slip_force * (1 + self.ratio) / (self.stiffness * share)
        return self.slip_force * (chi + 1) / (limit ** (chi + 2) * share)

    def of_slip(self, slip: np.ndarray) -> np.ndarray:
        """D = 4 R u_0^(chi+3) / ((chi+2)(chi+3)) [J], below full slip."""
        chi = self.exponent
        return 4 * self.coefficient() * slip ** (chi + 3) / ((chi + 2) * (chi + 3))

    def of_force(self, force: np.ndarray) -> np.ndarray:
        """D = theta F_0^(chi+3) [J] (Eq. 47, 51), for forces small against full slip."""
        return self.of_slip(force / self.stiffness)


def export_joint(iwan: Path, folder: Path, drive: str = "displacement") -> Path:
    """The joint as a unit under a drive."""
    archive = folder / f"joint-{drive}.fmu"
    command = [iwan, "export", HERE / "joint.json", "-o", archive, "--drive", drive]
    subprocess.run(command, check=True, capture_output=True)
    return archive


def build_bodies(folder: Path, drive: str = "displacement") -> Path:
    """The bodies for such a joint, compiled for this machine with the headers that fmpy has."""
    source, identifier = BODIES[drive]
    headers = Path(fmpy.__file__).parent / "c-code"
    library = folder / f"{identifier}{fmpy.sharedLibraryExtension}"
    command = [os.environ.get("CC", "cc"), "-O2", "-Wall", "-shared", "-fPIC", f"-I{headers}"]
    subprocess.run([*command, "-o", library, HERE / f"{source}.c"], check=True)
    archive = folder / f"{source}.fmu"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as content:
        content.write(HERE / f"{source}.xml", "modelDescription.xml")
        content.write(library, f"binaries/{fmpy.platform}/{library.name}")
    return archive


def package(joint: Path, bodies: Path, folder: Path, drive: str = "displacement") -> Path:
    """The pair with its connections as a System Structure Package."""
    archive = folder / f"resonator-{drive}.ssp"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as content:
        content.write(HERE / f"{drive}.ssd", "SystemStructure.ssd")
        content.write(joint, "resources/joint.fmu")
        content.write(bodies, "resources/bodies.fmu")
    return archive


def table(run: Decay) -> tuple[str, np.ndarray]:
    """Header and rows of decay.csv."""
    units = {"time": "s", "strain": "m", "velocity": "m/s", "force": "N", "displacement": "m"}
    units |= {"dissipation": "J", "stored_energy": "J", "slip_displacement": "m"}
    header = ",".join(f"{name} [{unit}]" for name, unit in units.items())
    return header, np.column_stack([getattr(run, name) for name in units])


def show(run: Decay, law: ClosedForm) -> None:
    """Every tenth of the cycles beside the closed form."""
    cycles = Cycles.of(run)
    print("   F_0 [N]   D [J]       closed form  damping ratio   frequency")
    every = max(1, len(cycles.force) // 10)
    for i in range(0, len(cycles.force), every):
        period = cycles.peaks[i + 1] - cycles.peaks[i]
        inside = (run.time >= cycles.peaks[i]) & (run.time <= cycles.peaks[i + 1])
        most = float(run.kinetic[inside].max())
        ratio = cycles.dissipation[i] / (4 * np.pi * most)
        closed = float(law.of_slip(cycles.slip[i]))
        print(
            f"{cycles.force[i]:10.2f}  {cycles.dissipation[i]:.4e}  {closed:.4e}  "
            f"{100 * ratio:8.4f} %   {1 / period:.3f} Hz"
        )


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--iwan", type=Path, default=HERE.parents[1] / "target/release/iwan")
    arguments = parser.parse_args()
    folder, iwan = arguments.folder, arguments.iwan.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    reference = None
    for drive in BODIES:
        joint = export_joint(iwan, folder, drive)
        run = decay(joint)
        archive = package(joint, build_bodies(folder, drive), folder, drive)
        each = run.steps_of_the_unit / (len(run.time) - 1)
        print(f"joint driven in {drive}: {each:.2f} steps of the unit per step of the master")
        print(f"  kinetic + stored + dissipated within {run.imbalance():.1e} of the blow's")
        if reference is None:
            reference = run
            show(run, ClosedForm.read(HERE / "joint.json"))
            header, rows = table(run)
            options = {"delimiter": ",", "header": header, "comments": "", "fmt": "%.9g"}
            np.savetxt(folder / "decay.csv", rows, **options)
        else:
            apart = np.abs(run.force - reference.force).max() / np.abs(reference.force).max()
            print(f"  force within {apart:.1e} of the run driven in displacement")
        answer = ANSWER[drive]
        result = decay_of_package(archive)
        apart = difference(result[f"joint.{answer}"], reference, answer)
        print(f"  {archive.name} in fmpy: {answer} within {100 * apart:.2g} % of the largest,")
        print(f"  energies within {imbalance_of_package(result):.1e} of the blow's")
    return 0


if __name__ == "__main__":
    sys.exit(main())
