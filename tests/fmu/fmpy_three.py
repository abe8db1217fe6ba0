"""The FMI 3.0 archive of a joint run by fmpy and held against its FMI 2.0 archive: see `CHECKS`."""

import ctypes
import math
import re
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import fmpy_archive
import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu
from fmpy_simulation import COLUMNS, Unit, close, columns, stops_where_it_is_told

ENTRIES = {
    "modelDescription.xml",
    "terminalsAndIcons/terminalsAndIcons.xml",
    "terminalsAndIcons/icon.png",
    "resources/joint.json",
    "documentation/index.html",
    "documentation/licenses/license.txt",
    "binaries/x86_64-linux/IwanJoint.so",
}
KEYS = [
    "valueReference",
    "causality",
    "variability",
    "initial",
    "start",
    "unit",
    "displayUnit",
    "min",
    "max",
    "nominal",
]
LOCALS = ["slip_displacement", "tangent_stiffness", "dissipation_rate"]


class Pair:
    """One joint as FMI 2.0 and as FMI 3.0."""

    def __init__(self, two: Path, three: Path, iwan: Path):
        self.two, self.archive = Unit(two, iwan), three
        self.description = read_model_description(str(three))
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.folder = extract(str(three))

    def outputs(self) -> list[str]:
        return [n for n, v in self.variables.items() if v.causality == "output"]


class Slave:
    """One FMI 3.0 instance, driven so that the input of a row is the input at its step's end."""

    def __init__(self, pair: Pair, token: str | None = None):
        self.pair = pair
        self.fmu = FMU3Slave(
            guid=token or pair.description.guid,
            unzipDirectory=pair.folder,
            modelIdentifier=pair.description.coSimulation.modelIdentifier,
            instanceName="checked",
        )
        self.log = []
        tell = lambda _, status, category, message: self.log.append(message.decode())  # noqa: E731
        self.fmu.instantiate(logMessage=tell)

    def __enter__(self) -> "Slave":
        return self

    def __exit__(self, *_) -> None:
        self.fmu.freeInstance()

    def references(self, names: list[str]) -> list[int]:
        return [self.pair.variables[name].valueReference for name in names]

    def get(self, names: list[str]) -> list[float]:
        return self.fmu.getFloat64(self.references(names))

    def start(self, load: np.ndarray) -> list[float]:
        self.fmu.enterInitializationMode(startTime=self.pair.two.time[0])
        self.fmu.setFloat64(self.references([self.pair.two.input]), [load[0]])
        self.fmu.exitInitializationMode()
        return self.get(COLUMNS)

    def step(self, load: np.ndarray, row: int) -> None:
        time = self.pair.two.time
        self.fmu.setFloat64(self.references([self.pair.two.input]), [load[row]])
        answer = self.fmu.doStep(time[row - 1], time[row] - time[row - 1])
        assert answer[:3] == (False, False, False), answer
        assert math.isclose(answer[3], time[row], rel_tol=1e-12), answer
        assert self.get(["time"]) == [answer[3]]

    def run(self, load: np.ndarray, first: int = 1) -> list[list[float]]:
        rows = []
        for row in range(first, len(load)):
            self.step(load, row)
            rows.append(self.get(COLUMNS))
        return rows


def fmpy_finds_no_fault(pair: Pair) -> None:
    problems = validate_fmu(str(pair.archive))
    assert problems == [], problems


def entries_stand_where_fmi_3_has_them(pair: Pair) -> None:
    fmpy_archive.entries_are_deflated_and_in_place(pair.archive, ENTRIES)
    with zipfile.ZipFile(pair.archive) as content, zipfile.ZipFile(pair.two.archive) as two:
        assert "model.png" not in content.namelist(), "an icon where FMI 2.0 has it"
        assert content.read("terminalsAndIcons/icon.png") == two.read("model.png")
        page = content.read("documentation/index.html").decode()
    for function in re.findall(r"fmi\d\w+", page):
        assert function in fmpy_archive.functions_of_fmi_3(), function
    assert "fmi3GetAdjointDerivative" in page


def xml_and_terminals_are_valid_by_the_schema(pair: Pair) -> None:
    checked = fmpy_archive.the_xml_is_valid_by_the_schema(pair.archive)
    assert checked == ["modelDescription.xml", "terminalsAndIcons/terminalsAndIcons.xml"], checked


def the_terminal_joins_input_and_answer(pair: Pair) -> None:
    with zipfile.ZipFile(pair.archive) as content:
        root = ElementTree.fromstring(content.read("terminalsAndIcons/terminalsAndIcons.xml"))
    (terminal,) = root.findall("Terminals/Terminal")
    members = terminal.findall("TerminalMemberVariable")
    named = {m.get("variableKind"): pair.variables[m.get("variableName")] for m in members}
    assert {kind: v.unit for kind, v in named.items()} == {"signal": "m", "inflow": "N"}
    assert {v.causality for v in named.values()} == {"input", "output"}


def both_versions_give_the_same(pair: Pair) -> None:
    load = pair.two.load()
    with pair.two.open() as slave:
        expected = [slave.start(load), *slave.run(load)]
        watched = slave.get(LOCALS)
    with Slave(pair) as slave:
        found = [slave.start(load), *slave.run(load)]
        assert slave.get(LOCALS) == watched
    close(columns(found), columns(expected))


def simulate_fmu_gives_what_fmi_2_gives(pair: Pair) -> None:
    load = pair.two.load()
    rows = list(zip(pair.two.time, load, strict=True))
    signals = np.array(rows, dtype=[("time", float), (pair.two.input, float)])
    results = [
        simulate_fmu(
            str(archive),
            input=signals,
            stop_time=pair.two.time[-1],
            output_interval=pair.two.time[1],
            output=COLUMNS,
            fmi_type="CoSimulation",
        )
        for archive in (pair.two.archive, pair.archive)
    ]
    expected, found = ({name: result[name] for name in COLUMNS} for result in results)
    close(found, expected)


def a_run_stops_where_it_is_told(pair: Pair) -> None:
    stops_where_it_is_told(pair.archive)


def variables_are_those_of_fmi_2_and_time(pair: Pair) -> None:
    for name, variable in pair.two.variables.items():
        here = pair.variables[name]
        for key in KEYS:
            assert getattr(here, key) == getattr(variable, key), (name, key)
    assert set(pair.variables) - set(pair.two.variables) == {"time"}
    assert pair.variables["time"].causality == "independent"
    two, three = (fmpy_archive.read(archive) for archive in (pair.two.archive, pair.archive))
    assert three.get("license") == two.get("license")
    assert three.get("generationDateAndTime") == two.get("generationDateAndTime")
    experiments = [root.find("DefaultExperiment").attrib for root in (two, three)]
    assert experiments[0] == experiments[1]
    shown = [root.findall("UnitDefinitions/Unit/DisplayUnit") for root in (two, three)]
    factors = [{unit.get("name"): unit.get("factor") for unit in units} for units in shown]
    assert factors[0].items() <= factors[1].items(), factors


def start_values_of_the_xml_are_those_of_the_library(pair: Pair) -> None:
    with Slave(pair) as slave:
        slave.fmu.enterInitializationMode()
        for name, variable in pair.variables.items():
            if variable.start is not None:
                assert slave.get([name]) == [float(variable.start)], name


def a_state_goes_from_one_version_to_the_other(pair: Pair) -> None:
    load = pair.two.load()
    with pair.two.open() as two:
        two.start(load)
        two.run(load, 1, 500)
        state = two.fmu.getFMUstate()
        content = two.fmu.serializeFMUstate(state)
        two.fmu.freeFMUstate(state)
        expected = two.run(load, 500)
    with Slave(pair) as three:
        state = three.fmu.deserializeFMUState(content)
        three.fmu.setFMUState(state)
        assert three.run(load, 500) == expected
        three.fmu.setFMUState(state)
        assert three.fmu.serializeFMUState(state) == content
        assert three.run(load, 500) == expected
        three.fmu.freeFMUState(state)


def derivatives_are_those_of_fmi_2(pair: Pair) -> None:
    load = pair.two.load()
    outputs = pair.outputs()
    with pair.two.open() as two, Slave(pair) as three:
        two.start(load)
        three.start(load)
        two.run(load, 1, 400)
        for row in range(1, 400):
            three.step(load, row)
        unknowns = three.references(outputs)
        knowns = three.references([pair.two.input])
        expected = two.fmu.getDirectionalDerivative(unknowns, knowns, [1.0])
        assert three.fmu.getDirectionalDerivative(unknowns, knowns, [1.0]) == list(expected)
        twice = three.fmu.getDirectionalDerivative(unknowns, knowns, [2.0])
        assert list(twice) == [2.0 * slope for slope in expected]
        seed = [1.0 + place for place in range(len(outputs))]
        (adjoint,) = three.fmu.getAdjointDerivative(unknowns, knowns, seed, 1)
        product = math.fsum(s * slope for s, slope in zip(seed, expected, strict=True))
        assert math.isclose(adjoint, product, rel_tol=1e-12)
        rates = three.fmu.getOutputDerivatives(unknowns, [1] * len(unknowns))
        assert all(math.isfinite(rate) for rate in rates) and rates[0] != 0.0, rates


def refused(call, slave: Slave, function: str, told: str) -> None:
    before = len(slave.log)
    try:
        call()
    except Exception as refusal:  # fmpy has one exception for all
        assert "status 3" in str(refusal) or "error" in str(refusal).lower(), refusal
    else:
        raise AssertionError(f"{function} was not refused")
    assert any(function in text and told in text for text in slave.log[before:]), slave.log


def what_is_not_offered_is_refused_and_told(pair: Pair) -> None:
    load = pair.two.load()
    with Slave(pair) as slave:
        slave.start(load)
        fmu = slave.fmu
        size = ctypes.c_size_t()
        refused(fmu.enterEventMode, slave, "fmi3EnterEventMode", "hasEventMode")
        refused(lambda: fmu.getInt32([1]), slave, "fmi3GetInt32", "type Int32, came 1")
        refused(
            lambda: fmu.fmi3GetNumberOfContinuousStates(fmu.component, ctypes.byref(size)),
            slave,
            "fmi3GetNumberOfContinuousStates",
            "model exchange",
        )
        refused(lambda: fmu.doStep(0.0, math.nan), slave, "fmi3DoStep", "communicationStepSize")
        refused(lambda: fmu.getFloat64([4711]), slave, "fmi3GetFloat64", "type Float64")
        refused(lambda: fmu.setFloat64([99], [1.0]), slave, "fmi3SetFloat64", "`time`")
        refused(lambda: fmu.enterInitializationMode(), slave, "fmi3EnterInit", "came in mode")
        fmu.doStep(0.0, 0.0)


def a_wrong_token_is_refused(pair: Pair) -> None:
    try:
        Slave(pair, "00000000-0000-0000-0000-000000000000")
    except Exception as refusal:  # fmpy has one exception for all
        assert "instantiate" in str(refusal), refusal
    else:
        raise AssertionError("a wrong token was taken")


def reset_starts_anew(pair: Pair) -> None:
    load = pair.two.load()
    with Slave(pair) as slave:
        first = [slave.start(load), *slave.run(load)]
        slave.fmu.terminate()
        slave.fmu.reset()
        assert [slave.start(load), *slave.run(load)] == first


CHECKS = [
    fmpy_finds_no_fault,
    entries_stand_where_fmi_3_has_them,
    xml_and_terminals_are_valid_by_the_schema,
    the_terminal_joins_input_and_answer,
    both_versions_give_the_same,
    simulate_fmu_gives_what_fmi_2_gives,
    a_run_stops_where_it_is_told,
    variables_are_those_of_fmi_2_and_time,
    start_values_of_the_xml_are_those_of_the_library,
    a_state_goes_from_one_version_to_the_other,
    derivatives_are_those_of_fmi_2,
    what_is_not_offered_is_refused_and_told,
    a_wrong_token_is_refused,
    reset_starts_anew,
]
