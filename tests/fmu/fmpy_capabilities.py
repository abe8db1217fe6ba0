"""Every flag of CoSimulation in modelDescription.xml, held against what the library does: see
`CHECKS` and `CHECKS_OF_3`."""

import ctypes
import math
from pathlib import Path

import numpy as np
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2StepFinishedTYPE,
)
from fmpy_probe import Probe
from fmpy_simulation import Unit
from fmpy_three import Pair


def word(truth: bool) -> str:
    """As XML writes it."""
    return "true" if truth else "false"


def taken(call) -> bool:
    """Whether the library takes a call; fmpy raises at any other status than OK."""
    try:
        call()
    except Exception:  # fmpy has one exception for all
        return False
    return True


def alone(probe: Probe) -> str:
    """The library runs without a process beside it."""
    with probe.open() as slave:
        probe.start(slave)
        probe.step(slave, 0.5, 0.0, 0.1)
        tasks = Path("/proc/self/task")
        children = [path.read_text() for path in tasks.glob("*/children")]
    return word(any(text.strip() for text in children))


def steps_of_any_size(probe: Probe) -> str:
    with probe.open() as slave:
        probe.start(slave)
        time = 0.0
        for size in (1e-3, 7e-4, 0.0, 0.25):
            if not taken(lambda: probe.step(slave, 0.2, time, size)):  # noqa: B023
                return word(False)
            time += size
    return word(True)


def follows_input_derivatives(probe: Probe) -> str:
    """An input that goes out and comes back within a step loses energy on the way."""
    lost = []
    for orders in ([], [1, 2]):
        with probe.open() as slave:
            probe.start(slave)
            probe.set(slave, probe.input, 0.0)
            if orders:
                known = [probe.references[probe.input]] * 2
                slave.fmu.setRealInputDerivatives(known, orders, [2 * probe.size, -4 * probe.size])
            slave.fmu.doStep(0.0, 1.0)
            lost.append(probe.get(slave, ["dissipation"])[0])
    return word(lost[0] == 0.0 < lost[1])


def output_order(probe: Probe) -> str:
    """Largest order of output derivatives that is answered."""
    with probe.open() as slave:
        probe.start(slave)
        probe.step(slave, 0.5, 0.0, 0.1)
        call = slave.fmu.getOutputDerivatives if probe.three else slave.fmu.getRealOutputDerivatives
        known = [probe.references[probe.outputs[0]]]
        orders = [n for n in range(1, 6) if taken(lambda: call(known, [n]))]  # noqa: B023
    return str(max(orders, default=0))


def steps_pend(probe: Probe) -> str:
    """Whether a step is under way when fmi2DoStep returns."""
    with probe.open() as slave:
        probe.start(slave)
        probe.step(slave, 0.5, 0.0, 0.1)
        time = ctypes.c_double()
        slave.fmu.fmi2GetRealStatus(slave.fmu.component, 2, ctypes.byref(time))
        return word(time.value != 0.1)


def one_at_a_time(probe: Probe) -> str:
    """Whether a second instance is refused, or hears of the first."""
    with probe.open() as one, probe.open() as other:
        probe.start(one)
        probe.start(other)
        first = probe.step(one, 0.5, 0.0, 0.1)
        probe.step(other, -0.3, 0.0, 0.1)
        return word(probe.get(one, probe.outputs) != first)


def leaves_memory_alone(probe: Probe) -> str:
    """Whether the host's functions for memory are never called."""
    calls = []

    def allocate(count: int, size: int) -> None:
        calls.append((count, size))

    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(lambda *_: None)
    callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(allocate)
    callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(calls.append)
    callbacks.stepFinished = fmi2StepFinishedTYPE(lambda *_: None)
    with probe.open() as slave:
        slave.fmu.fmi2FreeInstance(slave.fmu.component)
        slave.fmu.instantiate(callbacks=callbacks)
        probe.start(slave)
        probe.step(slave, 0.5, 0.0, 0.1)
        slave.fmu.freeFMUstate(slave.fmu.getFMUstate())
    return word(not calls)


def goes_back(probe: Probe, through_bytes: bool) -> str:
    """A state is taken, left and taken up again; where asked, in another instance."""
    name = "FMUState" if probe.three else "FMUstate"
    with probe.open() as slave, probe.open() as other:
        fmu = slave.fmu
        probe.start(slave)
        probe.step(slave, 0.5, 0.0, 0.1)
        state = getattr(fmu, f"get{name}")()
        expected = probe.step(slave, -0.4, 0.1, 0.1)
        back = slave
        if through_bytes:
            content = getattr(fmu, f"serialize{name}")(state)
            back = other
            moved = getattr(other.fmu, f"deSerialize{name}", None)
            moved = moved or getattr(other.fmu, f"deserialize{name}")
            getattr(other.fmu, f"set{name}")(moved(content))
        else:
            getattr(fmu, f"set{name}")(state)
        return word(probe.step(back, -0.4, 0.1, 0.1) == expected)


def slopes(probe: Probe, adjoint: bool) -> str:
    """Whether derivatives over the input are those of a repeated step."""
    shares = (0.5, 0.5 + 1e-6)
    answers = []
    for share in shares:
        with probe.open() as slave:
            probe.start(slave)
            answers.append(probe.step(slave, share, 0.0, 0.1))
            unknowns = [probe.references[name] for name in probe.outputs]
            knowns = [probe.references[probe.input]]
            if adjoint:
                units = np.eye(len(unknowns)).tolist()
                product = slave.fmu.getAdjointDerivative
                found = [product(unknowns, knowns, unit, 1)[0] for unit in units]
            else:
                found = list(slave.fmu.getDirectionalDerivative(unknowns, knowns, [1.0]))
    differences = np.subtract(*answers[::-1]) / ((shares[1] - shares[0]) * probe.size)
    return word(bool(np.allclose(found, differences, rtol=1e-3, atol=0.0)))


def instantiated(probe: Probe, **arguments) -> tuple[bool, list]:
    """Whether FMI 3.0 makes an instance with these arguments, and what its steps answer."""
    with probe.open() as slave:
        slave.fmu.fmi3FreeInstance(slave.fmu.component)
        silent = {"logMessage": lambda *_: None}
        if not taken(lambda: slave.fmu.instantiate(**silent, **arguments)):
            slave.fmu.instantiate(**silent)  # for the end of this block to free
            return False, []
        probe.start(slave)
        ends = []
        for row in range(20):
            probe.set(slave, probe.input, 0.9 * probe.size * math.sin(row))
            ends.append(slave.fmu.doStep(row * 0.1, 0.1))
    return True, ends


def events(probe: Probe) -> str:
    return word(instantiated(probe, eventModeUsed=True)[0])


def returns_early(probe: Probe) -> str:
    _, ends = instantiated(probe, earlyReturnAllowed=True)
    return word(not ends or any(end[2] for end in ends))


def updates_between(probe: Probe) -> str:
    calls = []
    instantiated(probe, earlyReturnAllowed=True, intermediateUpdate=lambda *a: calls.append(a))
    return word(bool(calls))


def answers(probe: Probe, name: str, *rest) -> str:
    """Whether a function of FMI 3.0 is served at a communication point."""
    with probe.open() as slave:
        probe.start(slave)
        function = getattr(slave.fmu, name)
        return word(taken(lambda: function(slave.fmu.component, *rest)))


COMMON = {
    "modelIdentifier": lambda probe: "IwanJoint",  # by which fmpy has found the library
    "needsExecutionTool": alone,
    "canHandleVariableCommunicationStepSize": steps_of_any_size,
    "maxOutputDerivativeOrder": output_order,
    "canBeInstantiatedOnlyOncePerProcess": one_at_a_time,
}
OF_2 = COMMON | {
    "canInterpolateInputs": follows_input_derivatives,
    "canRunAsynchronuously": steps_pend,
    "canNotUseMemoryManagementFunctions": leaves_memory_alone,
    "canGetAndSetFMUstate": lambda probe: goes_back(probe, False),
    "canSerializeFMUstate": lambda probe: goes_back(probe, True),
    "providesDirectionalDerivative": lambda probe: slopes(probe, False),
}
OF_3 = COMMON | {
    "canGetAndSetFMUState": lambda probe: goes_back(probe, False),
    "canSerializeFMUState": lambda probe: goes_back(probe, True),
    "providesDirectionalDerivatives": lambda probe: slopes(probe, False),
    "providesAdjointDerivatives": lambda probe: slopes(probe, True),
    "providesPerElementDependencies": lambda probe: answers(
        probe, "fmi3GetNumberOfVariableDependencies", 1, ctypes.byref(ctypes.c_size_t())
    ),
    "providesIntermediateUpdate": updates_between,
    "mightReturnEarlyFromDoStep": returns_early,
    "canReturnEarlyAfterIntermediateUpdate": updates_between,
    "hasEventMode": events,
    "providesEvaluateDiscreteStates": lambda probe: answers(probe, "fmi3EvaluateDiscreteStates"),
}


def compared(declared: dict[str, str], shown: dict[str, str]) -> None:
    apart = {flag: (declared.get(flag), shown.get(flag)) for flag in declared | shown}
    wrong = {flag: pair for flag, pair in apart.items() if pair[0] != pair[1]}
    assert not wrong, f"declared and shown: {wrong}"


def flags_are_what_the_library_does(unit: Unit) -> None:
    probe = Probe(unit, three=False)
    compared(probe.declared(), {flag: shows(probe) for flag, shows in OF_2.items()})


def flags_of_fmi_3_are_what_the_library_does(pair: Pair) -> None:
    probe = Probe(pair, three=True)
    compared(probe.declared(), {flag: shows(probe) for flag, shows in OF_3.items()})


CHECKS = [flags_are_what_the_library_does]
CHECKS_OF_3 = [flags_of_fmi_3_are_what_the_library_does]
