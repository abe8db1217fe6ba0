"""Three masters for the resonator: explicit, implicit, and fmpy's own for packages.

The bodies are stepped here, the joint in its exported unit. Time stepping is velocity Verlet in
both masters of this file, so that a joint driven in displacement and one driven in force must give
the same run.
"""

import shutil
from dataclasses import dataclass
from pathlib import Path

import fmpy
import fmpy.ssp.simulation
import numpy as np
from fmpy.fmi2 import FMU2Slave

REDUCED_MASS = 7.0  # two bodies of 14 kg [kg]
START_VELOCITY = 0.023  # of one body against the other after the blow [m/s]
STEP = 2.5e-5  # about 200 steps per period [s]
DURATION = 0.5  # [s]
SIGNALS = ["force", "displacement", "dissipation", "stored_energy", "slip_displacement"]
# Of the largest displacement, 40 µm: far below the master's own error, far above rounding.
CLOSE = 1e-10
MOST_ITERATIONS = 20


@dataclass
class Decay:
    """A free decay, SI units: one value per communication point."""

    time: np.ndarray
    strain: np.ndarray
    velocity: np.ndarray
    force: np.ndarray
    displacement: np.ndarray
    dissipation: np.ndarray
    stored_energy: np.ndarray
    slip_displacement: np.ndarray
    steps_of_the_unit: int

    @property
    def kinetic(self) -> np.ndarray:
        """Of the relative motion [J]."""
        return 0.5 * REDUCED_MASS * self.velocity**2

    def imbalance(self) -> float:
        """Largest share by which kinetic, stored and dissipated energy miss the blow's."""
        total = self.kinetic + self.stored_energy + self.dissipation
        return float(np.abs(total / total[0] - 1.0).max())


class JointUnit:
    """The exported joint in fmpy, between start and end of a run."""

    def __init__(self, archive: Path):
        description = fmpy.read_model_description(str(archive))
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        (self.input,) = [v.name for v in description.modelVariables if v.causality == "input"]
        self.answer = {"force": "displacement", "displacement": "force"}[self.input]
        self.folder = fmpy.extract(str(archive))
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="joint",
        )
        self.steps = 0

    def __enter__(self) -> "JointUnit":
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        return self

    def __exit__(self, *_) -> None:
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)

    def get(self, names: list[str]) -> list[float]:
        """Values by name."""
        return self.fmu.getReal([self.references[name] for name in names])

    def step(self, time: float, step: float, value: float) -> float:
        """One step to an input, and the answer."""
        self.fmu.setReal([self.references[self.input]], [value])
        self.fmu.doStep(time, step)
        self.steps += 1
        return self.get([self.answer])[0]

    def slope(self) -> float:
        """Of the answer over the input, by fmi2GetDirectionalDerivative."""
        unknown, known = [self.references[self.answer]], [self.references[self.input]]
        return self.fmu.getDirectionalDerivative(unknown, known, [1.0])[0]


def decay(joint: Path, step: float = STEP, start_velocity: float = START_VELOCITY) -> Decay:
    """Free decay, with the joint driven by whichever quantity its archive takes.

    Driven in displacement the joint answers with the force: one step of the unit per step. Driven
    in force the force is sought that moves it as far as the bodies have moved: Newton's method with
    the unit's own derivative, each trial taken back by fmi2SetFMUstate.
    """
    count = round(DURATION / step)
    rows = np.empty((count + 1, 3 + len(SIGNALS)))
    with JointUnit(joint) as unit:
        advance = {"displacement": answered, "force": sought}[unit.input]
        strain, velocity, force = 0.0, start_velocity, 0.0
        rows[0] = [0.0, strain, velocity, *unit.get(SIGNALS)]
        for row in range(1, count + 1):
            pushed = -force / REDUCED_MASS
            strain += step * velocity + 0.5 * step**2 * pushed
            force = advance(unit, (row - 1) * step, step, strain, force)
            velocity += 0.5 * step * (pushed - force / REDUCED_MASS)
            rows[row] = [row * step, strain, velocity, *unit.get(SIGNALS)]
        steps = unit.steps
    return Decay(*rows.T, steps)


def answered(unit: JointUnit, time: float, step: float, strain: float, _: float) -> float:
    """Force of a joint that is driven in displacement."""
    return unit.step(time, step, strain)


def sought(unit: JointUnit, time: float, step: float, strain: float, force: float) -> float:
    """Force under which a joint that is driven in force comes to the strain."""
    state = unit.fmu.getFMUstate()
    missing, slope = strain - unit.get([unit.answer])[0], unit.slope()
    try:
        for trial in range(MOST_ITERATIONS):
            if trial > 0:
                unit.fmu.setFMUstate(state)
            force += missing / slope
            missing = strain - unit.step(time, step, force)
            if abs(missing) <= CLOSE * 4e-5:
                return force
            slope = unit.slope()
    finally:
        unit.fmu.freeFMUstate(state)
    raise RuntimeError(f"no force found at {time} s: {missing} m are missing")


def decay_of_package(archive: Path) -> np.ndarray:
    """The same run by fmpy's own master for packages: columns `joint.…` and `bodies.…`.

    All units step at once, none is repeated. The outputs of row i belong to the end of step i.
    """
    return fmpy.ssp.simulation.simulate_ssp(str(archive), stop_time=DURATION, step_size=STEP)


def imbalance_of_package(result: np.ndarray) -> float:
    """Largest share by which the energies of the package's run miss the blow's."""
    kinetic = 0.5 * REDUCED_MASS * result["bodies.velocity"] ** 2
    total = kinetic + result["joint.stored_energy"] + result["joint.dissipation"]
    blow = 0.5 * REDUCED_MASS * START_VELOCITY**2
    return float(np.abs(total / blow - 1.0).max())


def difference(values: np.ndarray, run: Decay, name: str = "force") -> float:
    """Largest difference of a package's run from another over the largest value.

    Row i of a package's run is the end of step i. The first is left out: units that all step at
    once get their first inputs after it.
    """
    expected = getattr(run, name)
    both = min(len(values), len(expected) - 1)
    apart = np.abs(values[1:both] - expected[2 : both + 1]).max()
    return float(apart / np.abs(expected).max())
