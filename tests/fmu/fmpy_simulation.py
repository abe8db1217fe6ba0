"""An exported joint run by fmpy and held against `iwan simulate`: see `CHECKS`."""

import json
import math
import subprocess
import tempfile
import zipfile
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave
from fmpy.validation import validate_fmu

# Relative to the largest value of the signal. The same code runs on both sides; what differs is
# how two builds of it order a sum.
TOLERANCE = 1e-12
COLUMNS = ["force", "displacement", "dissipation", "stored_energy"]


class Unit:
    """An archive with the program that made it, and what is needed to drive both."""

    def __init__(self, archive: Path, iwan: Path):
        self.archive, self.iwan = archive, iwan
        self.description = read_model_description(str(archive))
        self.variables = {v.name: v for v in self.description.modelVariables}
        (self.input,) = [n for n, v in self.variables.items() if v.causality == "input"]
        with zipfile.ZipFile(archive) as content:
            self.joint = json.loads(content.read("resources/joint.json"))
            self.content = content.read("resources/joint.json")
        self.folder = Path(extract(str(archive)))
        self.time = np.linspace(0.0, 2.0, 1001)

    def load(self) -> np.ndarray:
        """A growing two-tone load with nested loops."""
        turns = 2.0 * math.pi * self.time
        shape = self.time / 2.0 * (np.sin(2.0 * turns) + 0.5 * np.sin(11.0 * turns)) / 1.5
        return self.scale() * shape

    def scale(self) -> float:
        """Half of what the joint's file says of its size, in the unit of the input."""
        density = self.joint["density"]
        if density["family"] == "four_parameter":
            force, stiffness = density["slip_force"], density["stiffness"]
        elif density["family"] == "sliders":
            pairs = list(zip(density["weight"], density["slip_at"], strict=True))
            force, stiffness = sum(w * d for w, d in pairs), sum(w for w, _ in pairs)
        else:
            force, stiffness = density["stiffness"] * 1e-3, density["stiffness"]
        return 0.5 * force if self.input == "force" else 0.5 * force / stiffness

    def simulate(self, time: np.ndarray, load: np.ndarray, joint: dict | None = None) -> dict:
        """What `iwan simulate` answers, by column."""
        unit = {"force": "N", "displacement": "m"}[self.input]
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            content = self.content if joint is None else json.dumps(joint).encode()
            (folder / "joint.json").write_bytes(content)
            rows = [f"{t!r},{x!r}" for t, x in zip(time.tolist(), load.tolist(), strict=True)]
            header = f"time [s],{self.input} [{unit}]"
            (folder / "load.csv").write_text("\n".join([header, *rows]) + "\n")
            command = [self.iwan, "simulate", "joint.json", "load.csv", "-o", "out.csv"]
            subprocess.run([*command, "--drive", self.input], cwd=folder, check=True)
            lines = (folder / "out.csv").read_text().splitlines()
        table = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
        return dict(zip(COLUMNS, table[:, 1:].T, strict=True))

    def open(self) -> "Slave":
        """A fresh instance."""
        return Slave(self)


class Slave:
    """One instance, driven so that the input of a row is the input at the end of its step."""

    def __init__(self, unit: Unit):
        self.unit = unit
        self.fmu = FMU2Slave(
            guid=unit.description.guid,
            unzipDirectory=str(unit.folder),
            modelIdentifier=unit.description.coSimulation.modelIdentifier,
            instanceName="checked",
        )
        self.fmu.instantiate()

    def __enter__(self) -> "Slave":
        return self

    def __exit__(self, *_) -> None:
        self.fmu.freeInstance()  # the library is unloaded with it

    def reference(self, name: str) -> int:
        return self.unit.variables[name].valueReference

    def get(self, names: list[str]) -> list[float]:
        return self.fmu.getReal([self.reference(name) for name in names])

    def start(self, load: np.ndarray) -> list[float]:
        self.fmu.setupExperiment(startTime=self.unit.time[0])
        self.fmu.enterInitializationMode()
        self.fmu.setReal([self.reference(self.unit.input)], [load[0]])
        self.fmu.exitInitializationMode()
        return self.get(COLUMNS)

    def run(self, load: np.ndarray, first: int = 1, last: int | None = None) -> list[list[float]]:
        rows = []
        time = self.unit.time
        for row in range(first, len(load) if last is None else last):
            self.fmu.setReal([self.reference(self.unit.input)], [load[row]])
            self.fmu.doStep(time[row - 1], time[row] - time[row - 1])
            rows.append(self.get(COLUMNS))
        return rows


def close(found: dict, expected: dict, tolerance: float = TOLERANCE) -> None:
    """Every column to the tolerance, relative to its largest value."""
    for name in COLUMNS:
        scale = np.abs(expected[name]).max()
        assert scale > 0.0, f"{name} is zero throughout: nothing is compared"
        apart = np.abs(np.asarray(found[name]) - expected[name]).max() / scale
        assert apart <= tolerance, f"{name}: differs by {apart:.1e} of its largest value"


def columns(rows: list[list[float]]) -> dict:
    return dict(zip(COLUMNS, np.array(rows).T, strict=True))


def fmpy_finds_no_fault(unit: Unit) -> None:
    problems = validate_fmu(str(unit.archive))
    assert problems == [], problems


def steps_give_what_iwan_simulate_gives(unit: Unit) -> None:
    load = unit.load()
    with unit.open() as slave:
        rows = [slave.start(load), *slave.run(load)]
    close(columns(rows), unit.simulate(unit.time, load))


def simulate_fmu_gives_what_iwan_simulate_gives(unit: Unit) -> None:
    """fmpy sets the input at the beginning of a step and holds it: so does the load here."""
    load = unit.load()
    signals = np.array(
        list(zip(unit.time, load, strict=True)), dtype=[("time", float), (unit.input, float)]
    )
    result = simulate_fmu(
        str(unit.archive),
        input=signals,
        stop_time=unit.time[-1],
        output_interval=unit.time[1],
        output=COLUMNS,
        fmi_type="CoSimulation",
    )
    held = np.concatenate([load[:1], load[:-1]])
    expected = unit.simulate(result["time"], held)
    close({name: result[name] for name in COLUMNS}, expected)


def stops_where_it_is_told(archive: Path) -> None:
    """At a stop time that no step divides, and where the host ends the run early."""
    for stop, step in ((0.7, 1.0 / 3.0), (1.0, 0.03), (1.0, 3.0), (2.0, 1e-3 / 3.0)):
        for told in (True, False):
            result = simulate_fmu(
                str(archive), stop_time=stop, output_interval=step, set_stop_time=told
            )
            assert result["time"][-1] == stop, (stop, step, told, result["time"][-1])
    early = simulate_fmu(
        str(archive),
        stop_time=1.0,
        output_interval=0.01,
        step_finished=lambda time, _: time < 0.205,
    )
    assert 0.2 < early["time"][-1] < 0.22, early["time"][-1]


def a_run_stops_where_it_is_told(unit: Unit) -> None:
    stops_where_it_is_told(unit.archive)


def the_step_does_not_matter_to_a_joint_without_rates(unit: Unit) -> None:
    """Between two rows the load is straight: tenth parts of the steps change nothing."""
    load = unit.load()
    with unit.open() as slave:
        slave.start(load)
        rows = []
        for row in range(1, len(load)):
            grid = np.linspace(unit.time[row - 1], unit.time[row], 11)
            between = np.linspace(load[row - 1], load[row], 11)
            for part in range(1, 11):
                slave.fmu.setReal([slave.reference(unit.input)], [between[part]])
                slave.fmu.doStep(grid[part - 1], grid[part] - grid[part - 1])
            rows.append(slave.get(COLUMNS))
    expected = {name: x[1:] for name, x in unit.simulate(unit.time, load).items()}
    # Ten times the additions of energy, each rounded.
    close(columns(rows), expected, 1e-11)


def a_state_continues_in_place_and_in_a_fresh_instance(unit: Unit) -> None:
    load = unit.load()
    with unit.open() as slave:
        slave.start(load)
        slave.run(load, 1, 500)
        state = slave.fmu.getFMUstate()
        content = slave.fmu.serializeFMUstate(state)
        first = slave.run(load, 500)
        slave.fmu.setFMUstate(state)
        assert slave.run(load, 500) == first, "in place"
        slave.fmu.freeFMUstate(state)
    with unit.open() as fresh:
        state = fresh.fmu.deSerializeFMUstate(content)
        fresh.fmu.setFMUstate(state)
        assert fresh.run(load, 500) == first, "in a fresh instance"
        fresh.fmu.freeFMUstate(state)


def reset_starts_anew(unit: Unit) -> None:
    load = unit.load()
    with unit.open() as slave:
        first = [slave.start(load), *slave.run(load, 1, 300)]
        slave.fmu.reset()
        assert [slave.start(load), *slave.run(load, 1, 300)] == first


def a_parameter_set_by_the_importer_is_the_joints(unit: Unit) -> None:
    """Every parameter in turn, against a joint.json in which it stands so."""
    load = 0.5 * unit.load()
    parameters = [v for v in unit.variables.values() if v.causality == "parameter"]
    for variable in parameters:
        joint = json.loads(unit.content)
        owner, _, name = variable.name.partition(".")
        if name:
            place = next(c for c in joint["causes"] if c["name"] == owner)["parameters"]
        else:
            name = variable.name
            place = joint if name == "series_stiffness" else joint["density"]
        value = place[name] * 1.01
        place[name] = value
        with unit.open() as slave:
            slave.fmu.setReal([variable.valueReference], [value])
            rows = [slave.start(load), *slave.run(load)]
        close(columns(rows), unit.simulate(unit.time, load, joint))


def impossible_steps_are_refused(unit: Unit) -> None:
    load = unit.load()
    with unit.open() as slave:
        slave.start(load)
        for size in (math.nan, -1e-3, math.inf):
            try:
                slave.fmu.doStep(0.0, size)
            except Exception as refusal:  # fmpy has one exception for all
                assert str(refusal) == "fmi2DoStep failed with status 3 (error).", refusal
            else:
                raise AssertionError(f"a step of {size} s was taken")
        slave.fmu.doStep(0.0, 0.0)
        slave.fmu.doStep(0.0, 1e-17)


def start_values_of_the_xml_are_those_of_the_library(unit: Unit) -> None:
    with unit.open() as slave:
        slave.fmu.setupExperiment()
        slave.fmu.enterInitializationMode()
        for name, variable in unit.variables.items():
            if variable.start is not None:
                assert slave.get([name]) == [float(variable.start)], name


def directional_derivatives_are_differences_of_repeated_steps(unit: Unit) -> None:
    """On the way up and on the way down: the step is taken back and taken again."""
    load = unit.load()
    outputs = [n for n, v in unit.variables.items() if v.causality == "output"]
    references = [unit.variables[name].valueReference for name in outputs]
    with unit.open() as slave:
        slave.start(load)
        slave.run(load, 1, 600)
        for row in range(600, 640):
            state = slave.fmu.getFMUstate()
            width = 1e-5 * np.abs(load).max()
            sides = []
            for value in (load[row] + width, load[row] - width, load[row]):
                slave.fmu.setFMUstate(state)
                slave.fmu.setReal([slave.reference(unit.input)], [value])
                slave.fmu.doStep(unit.time[row - 1], unit.time[row] - unit.time[row - 1])
                sides.append(np.array(slave.get(outputs)))
            known = [slave.reference(unit.input)]
            slopes = np.array(slave.fmu.getDirectionalDerivative(references, known, [1.0]))
            quotients = (sides[0] - sides[1]) / (2.0 * width)
            # With causes the network has sliders: a corner may lie within the difference.
            tolerance = 3e-2 if unit.joint["causes"] else 1e-3
            apart = np.abs(slopes - quotients) / np.maximum(np.abs(slopes), 1e-30)
            moved = abs(load[row] - load[row - 1]) > 10.0 * width
            assert not moved or apart[0] <= tolerance, (row, outputs, slopes, quotients)
            slave.fmu.freeFMUstate(state)


def a_wrong_guid_is_refused(unit: Unit) -> None:
    stranger = FMU2Slave(
        guid="00000000-0000-0000-0000-000000000000",
        unzipDirectory=str(unit.folder),
        modelIdentifier="IwanJoint",
        instanceName="stranger",
    )
    try:
        stranger.instantiate()
    except Exception as refusal:  # fmpy has one exception for all
        assert "instantiate" in str(refusal), refusal
    else:
        raise AssertionError("a wrong GUID was taken")


def checks(unit: Unit) -> list:
    """The checks that apply to this archive."""
    if unit.joint["causes"]:
        return [check for check in CHECKS if check not in WITHOUT_CAUSES]
    return CHECKS


WITHOUT_CAUSES = [the_step_does_not_matter_to_a_joint_without_rates]
CHECKS = [
    fmpy_finds_no_fault,
    steps_give_what_iwan_simulate_gives,
    simulate_fmu_gives_what_iwan_simulate_gives,
    a_run_stops_where_it_is_told,
    the_step_does_not_matter_to_a_joint_without_rates,
    a_state_continues_in_place_and_in_a_fresh_instance,
    reset_starts_anew,
    a_parameter_set_by_the_importer_is_the_joints,
    impossible_steps_are_refused,
    start_values_of_the_xml_are_those_of_the_library,
    directional_derivatives_are_differences_of_repeated_steps,
    a_wrong_guid_is_refused,
]
