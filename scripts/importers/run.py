"""One importer over one load, in a process of its own: an importer that crashes ends only this one.

    python run.py IMPORTER JOINT.fmu force|displacement LOAD.npy OUT.npz

LOAD.npy holds the input, a force [N] or a displacement [m], per communication point, STEP seconds
apart. OUT.npz gets the other of the two, dissipation and stored energy at every point after the
first, and the seconds of processor time that the steps took.
"""

import sys
import time
from pathlib import Path

import numpy as np

STEP = 1e-3
ANSWERS = {"force": "displacement", "displacement": "force"}


def signals(drive: str) -> list[str]:
    """What is compared of a unit under this drive."""
    return [ANSWERS[drive], "dissipation", "stored_energy"]


def fmpy(archive: str, drive: str, load: np.ndarray) -> tuple[list, float]:
    """The Python API of fmpy, for either version."""
    from fmpy import extract, read_model_description
    from fmpy.fmi2 import FMU2Slave
    from fmpy.fmi3 import FMU3Slave

    description = read_model_description(archive)
    references = {v.name: v.valueReference for v in description.modelVariables}
    three = description.fmiVersion.startswith("3")
    unit = (FMU3Slave if three else FMU2Slave)(
        guid=description.guid,
        unzipDirectory=extract(archive),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="joint",
    )
    unit.instantiate()
    if not three:
        unit.setupExperiment(startTime=0.0)
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    put, get = (unit.setFloat64, unit.getFloat64) if three else (unit.setReal, unit.getReal)
    rows, begun = [], time.process_time()
    for row, value in enumerate(load[1:]):
        put([references[drive]], [value])
        unit.doStep(row * STEP, STEP)
        rows.append(get([references[name] for name in signals(drive)]))
    took = time.process_time() - begun
    unit.terminate()
    unit.freeInstance()
    return rows, took


def libcosimpy(archive: str, drive: str, load: np.ndarray) -> tuple[list, float]:
    """Open Simulation Platform's library, native, with an override of the input per step."""
    from libcosimpy.CosimEnums import CosimVariableType
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    execution = CosimExecution.from_step_size(round(STEP * 1e9))
    index = execution.add_local_slave(CosimLocalSlave(archive, "joint"))
    observer, override = CosimObserver.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(override)
    references = {
        v.name.decode(): v.reference
        for v in execution.slave_variables(index)
        if v.type == CosimVariableType.REAL.value
    }
    read = [references[name] for name in signals(drive)]
    rows, begun = [], time.process_time()
    for value in load[1:]:
        override.slave_real_values(index, [references[drive]], [float(value)])
        if not execution.step():
            raise RuntimeError("libcosim refused a step")
        rows.append(list(observer.last_real_values(index, read)))
    return rows, time.process_time() - begun


def ecospy(archive: str, drive: str, load: np.ndarray) -> tuple[list, float]:
    """Ecos, native, for either version."""
    from ecospy import EcosSimulation, EcosSimulationStructure

    with EcosSimulationStructure() as structure:
        structure.add_model("joint", archive)
        with EcosSimulation(STEP, structure=structure) as simulation:
            simulation.init()
            rows, begun = [], time.process_time()
            for value in load[1:]:
                simulation.set_real(f"joint::{drive}", float(value))
                simulation.step(1)
                rows.append([simulation.get_real(f"joint::{name}") for name in signals(drive)])
            took = time.process_time() - begun
            simulation.terminate()
    return rows, took


def pathsim(archive: str, drive: str, load: np.ndarray) -> tuple[list, float]:
    """A block in a diagram of PathSim, on fmpy's loader, for either version."""
    from pathsim import Connection, Simulation
    from pathsim.blocks import Scope, Source
    from pathsim_fmi import CoSimulationFMU

    unit = CoSimulationFMU(archive, dt=STEP)
    places = [list(unit.fmu_wrapper.output_refs).index(name) for name in signals(drive)]
    # The unit takes its input for the end of the step; the diagram samples at the beginning.
    source = Source(lambda t: float(load[min(round(t / STEP) + 1, len(load) - 1)]))
    scope = Scope(sampling_period=STEP)
    wires = [Connection(unit[place], scope[row]) for row, place in enumerate(places)]
    wires.append(Connection(source, unit))
    diagram = Simulation([source, unit, scope], wires, dt=STEP, log=False)
    begun = time.process_time()
    diagram.run((len(load) - 2) * STEP)
    took = time.process_time() - begun
    _, rows = scope.read()
    return np.array(rows).T.tolist(), took


IMPORTERS = {"fmpy": fmpy, "libcosimpy": libcosimpy, "ecospy": ecospy, "pathsim-fmi": pathsim}


def main() -> int:
    """Command line."""
    importer, archive, drive, load, out = sys.argv[1:]
    rows, took = IMPORTERS[importer](str(Path(archive).resolve()), drive, np.load(load))
    np.savez(out, rows=np.array(rows, dtype=float), seconds=took)
    return 0


if __name__ == "__main__":
    sys.exit(main())
