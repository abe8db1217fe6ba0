"""Two masses and an exported joint between them: free decay after a blow, in fmpy and as an SSP.

    python examples/resonator/resonator.py FOLDER [--iwan target/release/iwan]

Exports joint.json driven in displacement, builds the unit of the two bodies (mass.c) with the
system's C compiler, and runs the pair twice: with a velocity Verlet master in this file, and
as resonator.ssp in fmpy; writes both units, the package and decay.csv into FOLDER and prints the
energy balance and the damping of every cycle beside the closed form.

The arrangement is that of L. Gaul and J. Lenz, Nonlinear dynamics of structures assembled by bolted
joints, Acta Mechanica 125 (1997): the joint is the only spring and the only damper between two free
bodies.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path

import fmpy
import fmpy.ssp.simulation
import numpy as np
from fmpy.fmi2 import FMU2Slave

HERE = Path(__file__).resolve().parent
REDUCED_MASS = 7.0  # two bodies of 14 kg [kg]
START_VELOCITY = 0.023  # of one body against the other after the blow [m/s]
STEP = 2.5e-5  # about 200 steps per period [s]
DURATION = 0.5  # [s]
SIGNALS = ["force", "dissipation", "stored_energy", "slip_displacement"]


@dataclass
class Decay:
    """A free decay, SI units: one value per communication point."""

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    force: np.ndarray
    dissipation: np.ndarray
    stored_energy: np.ndarray
    slip_displacement: np.ndarray

    @property
    def kinetic(self) -> np.ndarray:
        """Of the relative motion [J]."""
        return 0.5 * REDUCED_MASS * self.velocity**2

    def imbalance(self) -> float:
        """Largest share by which kinetic, stored and dissipated energy miss the blow's."""
        total = self.kinetic + self.stored_energy + self.dissipation
        return float(np.abs(total / total[0] - 1.0).max())

    def cycles(self) -> "Cycles":
        """From peak to peak of the slip, the first cycle left out: it holds the virgin loading."""
        slip = self.slip_displacement
        inner = (slip[1:-1] >= slip[:-2]) & (slip[1:-1] > slip[2:]) & (slip[1:-1] > 0.0)
        peaks = np.flatnonzero(inner)[1:] + 1
        # Between the samples the top of a parabola; dissipation is flat there.
        top = [vertex(slip[p - 1 : p + 2]) for p in peaks]
        force = [vertex(self.force[p - 1 : p + 2]) for p in peaks]
        middle = [0.5 * (a + b) for a, b in zip(top[:-1], top[1:], strict=True)]
        forces = [0.5 * (a + b) for a, b in zip(force[:-1], force[1:], strict=True)]
        return Cycles(
            np.array(forces), np.array(middle), np.diff(self.dissipation[peaks]), self.time[peaks]
        )


@dataclass
class Cycles:
    """Whole cycles of a decay: amplitudes halfway, dissipation in each, times of the peaks."""

    force: np.ndarray
    slip: np.ndarray
    dissipation: np.ndarray
    peaks: np.ndarray


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


def export_joint(iwan: Path, folder: Path) -> Path:
    """The joint as a unit that is driven in displacement."""
    archive = folder / "joint.fmu"
    command = [iwan, "export", HERE / "joint.json", "-o", archive, "--drive", "displacement"]
    subprocess.run(command, check=True, capture_output=True)
    return archive


def build_bodies(folder: Path) -> Path:
    """The unit of the bodies, for this machine: compiled with the standard's headers from fmpy."""
    headers = Path(fmpy.__file__).parent / "c-code"
    library = folder / "Bodies.so"
    command = [os.environ.get("CC", "cc"), "-O2", "-shared", "-fPIC", f"-I{headers}"]
    subprocess.run([*command, "-o", library, HERE / "mass.c"], check=True)
    archive = folder / "bodies.fmu"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as content:
        content.write(HERE / "mass.xml", "modelDescription.xml")
        content.write(library, "binaries/linux64/Bodies.so")
    return archive


def package(joint: Path, bodies: Path, folder: Path) -> Path:
    """The pair with its connections as a System Structure Package."""
    archive = folder / "resonator.ssp"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as content:
        content.write(HERE / "SystemStructure.ssd", "SystemStructure.ssd")
        content.write(joint, "resources/joint.fmu")
        content.write(bodies, "resources/bodies.fmu")
    return archive


def decay(joint: Path, step: float = STEP, start_velocity: float = START_VELOCITY) -> Decay:
    """Free decay under a velocity Verlet master: the bodies here, the joint in its unit."""
    description = fmpy.read_model_description(str(joint))
    references = {v.name: v.valueReference for v in description.modelVariables}
    folder = fmpy.extract(str(joint))
    unit = FMU2Slave(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="joint",
    )
    count = round(DURATION / step)
    rows = np.empty((count + 1, 3 + len(SIGNALS)))
    driven, read = [references["displacement"]], [references[name] for name in SIGNALS]
    try:
        unit.instantiate()
        unit.setupExperiment(startTime=0.0)
        unit.enterInitializationMode()
        unit.exitInitializationMode()
        displacement, velocity = 0.0, start_velocity
        answers = unit.getReal(read)
        rows[0] = [0.0, displacement, velocity, *answers]
        for row in range(1, count + 1):
            pushed = -answers[0] / REDUCED_MASS
            displacement += step * velocity + 0.5 * step**2 * pushed
            unit.setReal(driven, [displacement])
            unit.doStep((row - 1) * step, step)
            answers = unit.getReal(read)
            velocity += 0.5 * step * (pushed - answers[0] / REDUCED_MASS)
            rows[row] = [row * step, displacement, velocity, *answers]
        unit.terminate()
    finally:
        unit.freeInstance()
        shutil.rmtree(folder, ignore_errors=True)
    return Decay(*rows.T)


def decay_of_package(archive: Path) -> np.ndarray:
    """The same run by fmpy's own master for packages: all units step at once."""
    result = fmpy.ssp.simulation.simulate_ssp(str(archive), stop_time=DURATION, step_size=STEP)
    return np.array(result["joint.force"])


def difference(force: np.ndarray, run: Decay) -> float:
    """Largest difference of two runs' forces over the largest force.

    Row i of a package's run is the end of step i. The first is left out: units that all step at
    once get their first inputs after it.
    """
    both = min(len(force), len(run.force) - 1)
    apart = np.abs(force[1:both] - run.force[2 : both + 1]).max()
    return float(apart / np.abs(run.force).max())


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--iwan", type=Path, default=HERE.parents[1] / "target/release/iwan")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    joint = export_joint(arguments.iwan.resolve(), arguments.folder)
    archive = package(joint, build_bodies(arguments.folder), arguments.folder)
    run, law = decay(joint), ClosedForm.read(HERE / "joint.json")
    units = {"time": "s", "displacement": "m", "velocity": "m/s", "force": "N"}
    units |= {"dissipation": "J", "stored_energy": "J", "slip_displacement": "m"}
    table = np.column_stack([getattr(run, name) for name in units])
    header = ",".join(f"{name} [{unit}]" for name, unit in units.items())
    path = arguments.folder / "decay.csv"
    np.savetxt(path, table, delimiter=",", header=header, comments="", fmt="%.9g")
    cycles = run.cycles()
    print(f"energy: kinetic + stored + dissipated within {run.imbalance():.1e} of the blow's")
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
    apart = difference(decay_of_package(archive), run)
    print(f"resonator.ssp in fmpy: force within {100 * apart:.2g} % of the largest")
    return 0


if __name__ == "__main__":
    sys.exit(main())
