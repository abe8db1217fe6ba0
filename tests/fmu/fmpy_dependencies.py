"""The dependencies that ModelStructure lists, held against what outputs are seen to answer to: see
`CHECKS` and `CHECKS_OF_3`."""

import fmpy_archive
from fmpy_probe import Probe
from fmpy_simulation import Unit
from fmpy_three import Pair


def listed(probe: Probe, element: str) -> dict[str, set[str]]:
    """Knowns by output, as the XML lists them."""
    root = fmpy_archive.read(probe.subject.archive)
    if probe.three:
        names = {str(reference): name for name, reference in probe.references.items()}
        found = root.findall(f"ModelStructure/{element}")
        key = "valueReference"
    else:
        variables = root.findall("ModelVariables/ScalarVariable")
        names = {str(i + 1): variable.get("name") for i, variable in enumerate(variables)}
        found = root.findall(f"ModelStructure/{element}s/Unknown")
        key = "index"
    return {
        names[unknown.get(key)]: {names[known] for known in unknown.get("dependencies").split()}
        for unknown in found
    }


def at_a_point(probe: Probe, size: float) -> dict[str, set[str]]:
    """Knowns that an output is seen to answer to within a step of this size."""
    rows = []
    for share in (0.5, 0.6):
        with probe.open() as slave:
            probe.start(slave)
            before = probe.step(slave, 0.3, 0.0, 0.1)
            probe.set(slave, probe.input, share * probe.size)
            assert probe.get(slave, probe.outputs) == before, "set is not stepped"
            rows.append(probe.step(slave, share, 0.1, size))
    pairs = zip(probe.outputs, *rows, strict=True)
    return {name: {probe.input} if one != other else set() for name, one, other in pairs}


def at_the_start(probe: Probe) -> dict[str, set[str]]:
    """Knowns that an output is seen to answer to in Initialization Mode."""

    def row(**values: float) -> list[float]:
        with probe.open() as slave:
            probe.initializing(slave, **{probe.input: 0.5 * probe.size} | values)
            return probe.get(slave, probe.outputs)

    plain = row()
    changes = {probe.input: 0.6 * probe.size}
    # A little less, which every bound lets pass; what is zero stays there by its own law.
    changes |= {name: 0.99 * start for name, start in probe.starts.items() if start != 0.0}
    seen = {name: set() for name in probe.outputs}
    for known, value in changes.items():
        for name, one, other in zip(probe.outputs, plain, row(**{known: value}), strict=True):
            if one != other:
                seen[name].add(known)
    return seen


def dependencies_are_what_a_probe_shows(probe: Probe) -> None:
    outputs, knowns = set(probe.outputs), {probe.input, *probe.parameters}
    on_input = listed(probe, "Output")
    assert on_input == {name: {probe.input} for name in outputs}
    # Within a step of some length every output answers to the input, as the XML says. In a step of
    # no time energies and the answer do; power has none there, see fmi2DoStep.
    assert at_a_point(probe, 0.1) == on_input
    jumped = at_a_point(probe, 0.0)
    assert jumped == on_input | {"dissipation_rate": set()}, jumped
    initial = listed(probe, "InitialUnknown")
    # Nothing has been lost over a step yet, so that this output is zero whatever is set.
    assert initial == dict.fromkeys(outputs, knowns) | {"dissipation_rate": set()}
    seen = at_the_start(probe)
    assert seen.pop("dissipation_rate") == set()
    four = "slip_force" in probe.parameters and "ratio" in probe.parameters
    own = {known for known in knowns if "." not in known}
    for name, found in seen.items():
        assert found <= initial[name]
        # Every one of Segalman's four parameters shows in every answer, but behind a spring that
        # carries the same force nothing more is lost; beside one across the joint it does not.
        # Other densities have parameters that lie beyond this load.
        alone = not probe.starts.get("cubic_stiffness.across")
        same_force = (probe.input, name, alone) == ("force", "dissipation", True)
        unseen = {"series_stiffness"} if same_force else set()
        assert not four or own - found == unseen, (name, own - found)


def dependencies_of_fmi_2(unit: Unit) -> None:
    dependencies_are_what_a_probe_shows(Probe(unit, three=False))


def dependencies_of_fmi_3(pair: Pair) -> None:
    dependencies_are_what_a_probe_shows(Probe(pair, three=True))


CHECKS = [dependencies_of_fmi_2]
CHECKS_OF_3 = [dependencies_of_fmi_3]
