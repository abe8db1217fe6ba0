"""What fmpy's validation does not see in an archive: see `CHECKS`."""

import html
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import fmpy
from lxml import etree

ROOT = Path(__file__).resolve().parents[2]
FUNCTIONS = {
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2SetDebugLogging",
    "fmi2Instantiate",
    "fmi2FreeInstance",
    "fmi2SetupExperiment",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2Terminate",
    "fmi2Reset",
    "fmi2GetReal",
    "fmi2GetInteger",
    "fmi2GetBoolean",
    "fmi2GetString",
    "fmi2SetReal",
    "fmi2SetInteger",
    "fmi2SetBoolean",
    "fmi2SetString",
    "fmi2GetFMUstate",
    "fmi2SetFMUstate",
    "fmi2FreeFMUstate",
    "fmi2SerializedFMUstateSize",
    "fmi2SerializeFMUstate",
    "fmi2DeSerializeFMUstate",
    "fmi2GetDirectionalDerivative",
    "fmi2SetRealInputDerivatives",
    "fmi2GetRealOutputDerivatives",
    "fmi2DoStep",
    "fmi2CancelStep",
    "fmi2GetStatus",
    "fmi2GetRealStatus",
    "fmi2GetIntegerStatus",
    "fmi2GetBooleanStatus",
    "fmi2GetStringStatus",
}
HEADER_OF_FMI_3 = Path(fmpy.__file__).parent / "c-code" / "fmi3FunctionTypes.h"
PLATFORMS = {"linux64": "so", "win64": "dll", "darwin64": "dylib", "aarch64-linux": "so"}
ENTRIES = {
    "modelDescription.xml",
    "model.png",
    "resources/joint.json",
    "documentation/index.html",
    "documentation/licenses/license.txt",
}
ORDER = [
    "CoSimulation",
    "UnitDefinitions",
    "LogCategories",
    "DefaultExperiment",
    "ModelVariables",
    "ModelStructure",
]


def read(archive: Path) -> ElementTree.Element:
    """The root of modelDescription.xml."""
    with zipfile.ZipFile(archive) as content:
        return ElementTree.fromstring(content.read("modelDescription.xml"))


def reals(root: ElementTree.Element) -> list[tuple[dict, dict]]:
    """Attributes of each ScalarVariable with those of its Real."""
    variables = root.findall("ModelVariables/ScalarVariable")
    return [(variable.attrib, variable.find("Real").attrib) for variable in variables]


def entries_are_deflated_and_in_place(archive: Path, expected: set[str] = ENTRIES) -> None:
    with zipfile.ZipFile(archive) as content:
        infos = content.infolist()
    names = {info.filename for info in infos}
    assert len(names) == len(infos), "an entry stands twice"
    assert names >= expected, expected - names
    assert all(info.compress_type == zipfile.ZIP_DEFLATED for info in infos)


def binaries_are_named_after_the_identifier(archive: Path) -> None:
    identifier = read(archive).find("CoSimulation").get("modelIdentifier")
    assert identifier == "IwanJoint"
    with zipfile.ZipFile(archive) as content:
        binaries = [name for name in content.namelist() if name.startswith("binaries/")]
    assert binaries, "no binary"
    for name in binaries:
        _, platform, file = name.split("/")
        assert file == f"{identifier}.{PLATFORMS[platform]}", name


def functions_of_fmi_3() -> set[str]:
    """Names in the standard's header, which has a type `…TYPE` for each function."""
    return set(re.findall(r"\b(fmi3\w+)TYPE\b", HEADER_OF_FMI_3.read_text()))


def exactly_the_fmi_functions_are_exported(archive: Path) -> None:
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(archive) as content:
        library = content.extract("binaries/linux64/IwanJoint.so", folder)
        command = ["nm", "-D", "--defined-only", library]
        listing = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    symbols = {line.split()[-1] for line in listing.splitlines()}
    third = functions_of_fmi_3()
    assert len(third) == 75, third
    assert symbols == FUNCTIONS | third, symbols ^ (FUNCTIONS | third)


def elements_stand_in_the_order_of_the_schema(archive: Path) -> None:
    assert [child.tag for child in read(archive)] == ORDER


def bounds_hold_the_start_values(archive: Path) -> None:
    for variable, real in reals(read(archive)):
        lower, upper = float(real.get("min", "-inf")), float(real.get("max", "inf"))
        assert lower < upper, variable
        assert lower <= float(real.get("start", lower)) <= upper, variable


def initial_and_start_stand_where_they_may(archive: Path) -> None:
    for variable, real in reals(read(archive)):
        given = (variable["causality"], variable["variability"], variable.get("initial"))
        assert given in {
            ("input", "continuous", None),
            ("output", "continuous", "calculated"),
            ("local", "continuous", "calculated"),
            ("parameter", "fixed", "exact"),
        }, variable
        assert ("start" in real) == (variable["causality"] in {"input", "parameter"}), variable


def names_and_references_are_unique(archive: Path) -> None:
    variables = [variable for variable, _ in reals(read(archive))]
    for key in ("name", "valueReference"):
        values = [variable[key] for variable in variables]
        assert len(set(values)) == len(values), f"{key} stands twice"


def references_are_those_of_the_tables(archive: Path) -> None:
    tables = {}
    for file in ("signals.csv", "parameters.csv", "causes.csv"):
        for line in (ROOT / "modelDescription" / file).read_text().splitlines():
            if not line.startswith("#"):
                reference, name = (cell.strip() for cell in line.split(",")[:2])
                tables[name] = int(reference)
    for variable, _ in reals(read(archive)):
        owner, _, parameter = variable["name"].partition(".")
        offset = int(variable["valueReference"]) - tables[owner]
        assert (0 <= offset < 16) if parameter else offset == 0, variable


def units_are_defined_with_base_units(archive: Path) -> None:
    root = read(archive)
    defined = {unit.get("name"): unit for unit in root.findall("UnitDefinitions/Unit")}
    for variable, real in reals(root):
        assert defined[real["unit"]].find("BaseUnit") is not None, variable


def shown_units_are_defined_and_scale(archive: Path) -> None:
    root = read(archive)
    scales = {
        (unit.get("name"), shown.get("name")): float(shown.get("factor"))
        for unit in root.findall("UnitDefinitions/Unit")
        for shown in unit.findall("DisplayUnit")
    }
    used = {(r["unit"], r["displayUnit"]) for _, r in reals(root) if "displayUnit" in r}
    assert used == set(scales), used ^ set(scales)
    prefixes = {("m", "um"): 1e6, ("N", "kN"): 1e-3, ("N/m", "kN/mm"): 1e-6, ("J", "mJ"): 1e3}
    for pair, factor in prefixes.items():
        assert scales[pair] == factor, pair


def nominal_values_are_sizes(archive: Path) -> None:
    nominal = {v["name"]: float(r["nominal"]) for v, r in reals(read(archive)) if "nominal" in r}
    signals = {"force", "displacement", "dissipation", "stored_energy", "tangent_stiffness"}
    assert nominal.keys() >= signals
    assert all(value > 0.0 for value in nominal.values())
    # a force softens the joint: it goes further than its first tangent says, and not tenfold
    linear = nominal["force"] / nominal["tangent_stiffness"]
    assert linear <= nominal["displacement"] < 10.0 * linear, nominal


def the_icon_is_a_picture(archive: Path) -> None:
    with zipfile.ZipFile(archive) as content:
        head = content.read("model.png")[:24]
    assert head.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = (int.from_bytes(head[i : i + 4], "big") for i in (16, 20))
    assert width == height == 128


def the_page_is_well_formed_and_tells_the_parameters(archive: Path) -> None:
    with zipfile.ZipFile(archive) as content:
        page = content.read("documentation/index.html").decode()
        licence = content.read("documentation/licenses/license.txt").decode()
    stack = []
    for close, tag in re.findall(r"<(/?)(\w+)[^>]*>", page.removeprefix("<!DOCTYPE html>")):
        if close:
            assert stack.pop() == tag, f"</{tag}> closes another element"
        elif tag != "meta":
            stack.append(tag)
    assert not stack, stack
    for variable, _ in reals(read(archive)):
        assert f"<code>{variable['name']}</code>" in page, variable
    assert "Apache License" in licence
    assert "Permission is hereby granted" in licence


def the_xml_is_valid_by_the_schema(archive: Path) -> list[str]:
    """The entries that were held against the schema of the archive's version."""
    folder = Path(fmpy.__file__).parent / "schema"
    version = "fmi3" if read(archive).get("fmiVersion").startswith("3") else "fmi2"
    checked = [("modelDescription.xml", "ModelDescription")]
    with zipfile.ZipFile(archive) as content:
        terminals = "terminalsAndIcons/terminalsAndIcons.xml"
        if terminals in content.namelist():
            checked.append((terminals, "TerminalsAndIcons"))
        for entry, kind in checked:
            schema = etree.XMLSchema(file=str(folder / version / f"{version}{kind}.xsd"))
            schema.assertValid(etree.fromstring(content.read(entry)))
    return [entry for entry, _ in checked]


def experiment_runs_forward(archive: Path) -> None:
    experiment = read(archive).find("DefaultExperiment").attrib
    assert float(experiment["startTime"]) < float(experiment["stopTime"])
    assert float(experiment["stepSize"]) > 0


def structure_names_every_output(archive: Path) -> None:
    root = read(archive)
    names = [variable["name"] for variable, _ in reals(root)]
    causalities = [variable["causality"] for variable, _ in reals(root)]
    outputs = [i + 1 for i, causality in enumerate(causalities) if causality == "output"]
    for element in ("Outputs", "InitialUnknowns"):
        unknowns = root.findall(f"ModelStructure/{element}/Unknown")
        assert [int(unknown.get("index")) for unknown in unknowns] == outputs, element
        for unknown in unknowns:
            dependencies = unknown.get("dependencies").split()
            assert "dependenciesKind" not in unknown.attrib
            name = names[int(unknown.get("index")) - 1]
            if (element, name) == ("InitialUnknowns", "dissipation_rate"):
                assert dependencies == [], "no step, no power"
                continue
            assert causalities[int(dependencies[0]) - 1] == "input", element
            assert all(1 <= int(index) <= len(causalities) for index in dependencies)


def the_command_on_the_page_takes_the_steps_that_it_names(archive: Path) -> None:
    with zipfile.ZipFile(archive) as content:
        page = content.read("documentation/index.html").decode()
    (command,) = re.findall(r"<code>fmpy (simulate [^<]*)</code>", page)
    words = html.unescape(command).split()
    experiment = read(archive).find("DefaultExperiment").attrib
    stop, step = (float(experiment[name]) for name in ("stopTime", "stepSize"))
    inputs = [v["name"] for v, _ in reals(read(archive)) if v["causality"] == "input"]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "joint.fmu").write_bytes(archive.read_bytes())
        (folder / "load.csv").write_text(f"time,{inputs[0]}\n0,0\n{stop!r},0\n")
        program = "import sys; from fmpy.cli import main; sys.exit(main())"
        subprocess.run([sys.executable, "-c", program, *words], cwd=folder, check=True)
        rows = (folder / "out.csv").read_text().splitlines()[1:]
    assert abs(len(rows) - 1 - stop / step) < 1.5, (len(rows), stop, step)


def guid_is_written_in_full(archive: Path) -> None:
    guid = read(archive).get("guid")
    assert re.fullmatch(r"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}", guid), guid


CHECKS = [
    entries_are_deflated_and_in_place,
    binaries_are_named_after_the_identifier,
    exactly_the_fmi_functions_are_exported,
    elements_stand_in_the_order_of_the_schema,
    bounds_hold_the_start_values,
    initial_and_start_stand_where_they_may,
    names_and_references_are_unique,
    references_are_those_of_the_tables,
    units_are_defined_with_base_units,
    shown_units_are_defined_and_scale,
    nominal_values_are_sizes,
    the_icon_is_a_picture,
    the_page_is_well_formed_and_tells_the_parameters,
    the_xml_is_valid_by_the_schema,
    experiment_runs_forward,
    structure_names_every_output,
    the_command_on_the_page_takes_the_steps_that_it_names,
    guid_is_written_in_full,
]
