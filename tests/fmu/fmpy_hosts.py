"""What hosts do to archives beside simulating them: folders with strange names, several archives in
one process, libraries unloaded and loaded again, resources that are gone: see `CHECKS`."""

import shutil
import threading
from pathlib import Path

import fmpy
from fmpy.fmi2 import FMU2Slave

CYCLES = 300
STEP = 1e-3
# Folders of users and tools: spaces, letters beyond ASCII, characters that a URI encodes.
FOLDER = "prüf stand 100% #1 関節"


# fmpy changes the folder of the process while it loads a library: two threads at it would leave the
# process in the folder of either.
LOADING = threading.Lock()


class Host:
    """One instance from an unpacked archive, FMI 2.0."""

    def __init__(self, archive: Path, folder: Path):
        description = fmpy.read_model_description(str(archive))
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        (self.input,) = [v.name for v in description.modelVariables if v.causality == "input"]
        fmpy.extract(str(archive), unzipdir=str(folder))
        self.arguments = {
            "guid": description.guid,
            "unzipDirectory": str(folder),
            "modelIdentifier": description.coSimulation.modelIdentifier,
            "instanceName": "hosted",
        }

    def start(self) -> FMU2Slave:
        """Loads the library and brings an instance to its first communication point."""
        with LOADING:
            unit = FMU2Slave(**self.arguments)
        unit.instantiate()
        unit.setupExperiment(startTime=0.0)
        unit.enterInitializationMode()
        unit.exitInitializationMode()
        return unit

    def step(self, unit: FMU2Slave, row: int) -> list[float]:
        """One step of a small triangular load, and the answers."""
        size = {"force": 100.0, "displacement": 5e-6}[self.input]
        value = size * (1.0 - abs(row % 40 - 20) / 10.0)
        unit.setReal([self.references[self.input]], [value])
        unit.doStep(row * STEP, STEP)
        names = ("force", "displacement", "dissipation", "stored_energy")
        return unit.getReal([self.references[name] for name in names])

    def run(self, count: int) -> list[list[float]]:
        """From loading the library to unloading it."""
        unit = self.start()
        rows = [self.step(unit, row) for row in range(count)]
        unit.terminate()
        unit.freeInstance()  # unloads the library
        return rows


class Pair:
    """Archives that a host loads side by side; the first is of a joint without causes."""

    def __init__(self, archives: list[Path], folder: Path):
        self.folder, self.archives = folder, archives
        places = [folder / FOLDER / archive.stem for archive in archives]
        self.hosts = [Host(a, place) for a, place in zip(archives, places, strict=True)]


def mapped(folder: str) -> int:
    """Mappings into the process of files from this folder."""
    with open("/proc/self/maps", encoding="utf-8") as maps:
        return sum(folder in line for line in maps)


def resident() -> int:
    """Memory of the process [KiB]."""
    with open("/proc/self/status", encoding="utf-8") as status:
        (line,) = [line for line in status if line.startswith("VmRSS")]
    return int(line.split()[1])


def strange_folders_do_not_matter(pair: Pair) -> None:
    plain = Host(pair.archives[0], pair.folder / "plain")
    assert pair.hosts[0].run(100) == plain.run(100)


def archives_in_one_process_do_not_meet(pair: Pair) -> None:
    alone = [host.run(200) for host in pair.hosts]
    units = [host.start() for host in pair.hosts for _ in range(2)]
    hosts = [host for host in pair.hosts for _ in range(2)]
    together = [[] for _ in units]
    for row in range(200):
        for rows, host, unit in zip(together, hosts, units, strict=True):
            rows.append(host.step(unit, row))
    for unit in units:
        unit.terminate()
        unit.freeInstance()
    assert together == [rows for rows in alone for _ in range(2)]


def threads_of_the_host_do_not_meet(pair: Pair) -> None:
    alone = [host.run(200) for host in pair.hosts]
    found = [None] * 8

    def work(place: int) -> None:
        found[place] = pair.hosts[place % len(pair.hosts)].run(200)

    threads = [threading.Thread(target=work, args=(place,)) for place in range(len(found))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [alone[place % len(alone)] for place in range(len(found))]


def a_library_is_unloaded_and_loaded_again(pair: Pair) -> None:
    host = pair.hosts[0]
    first = host.run(20)
    unit = host.start()
    if not Path("/proc/self/maps").exists():
        print("not run here: memory and mappings are told by Linux alone")
        unit.freeInstance()
        return
    assert mapped(host.arguments["unzipDirectory"]) > 0
    unit.freeInstance()
    for _ in range(20):
        host.run(20)
    before = resident()
    for _ in range(CYCLES):
        assert host.run(20) == first
    assert mapped(host.arguments["unzipDirectory"]) == 0, "the library stays in the process"
    # Loading leaves the C library's own tables behind; a leak of one instance (160 KiB) each time
    # would be a hundred times this.
    grown = resident() - before
    assert grown < 512, f"{grown} KiB more after {CYCLES} cycles"


def an_archive_without_its_joint_is_refused(pair: Pair) -> None:
    folder = pair.folder / "bare"
    host = Host(pair.archives[0], folder)
    shutil.rmtree(folder / "resources")
    try:
        host.start()
    except Exception as refusal:  # fmpy has one exception for all
        assert "instantiate" in str(refusal), refusal
    else:
        raise AssertionError("an archive without a joint was taken")


def steps_far_from_the_default_are_taken(pair: Pair) -> None:
    host = pair.hosts[0]
    unit = host.start()
    time, expected = 0.0, None
    # A microsecond, nothing, three years, half a second: a held input gives the same answer.
    for step in (1e-6, 0.0, 1e8, 0.5):
        unit.setReal([host.references[host.input]], [1e-7])
        unit.doStep(time, step)
        time += step
        found = unit.getReal([host.references[n] for n in ("force", "displacement")])
        expected = expected or found
        assert found == expected, (step, found, expected)
    unit.freeInstance()


CHECKS = [
    strange_folders_do_not_matter,
    archives_in_one_process_do_not_meet,
    threads_of_the_host_do_not_meet,
    a_library_is_unloaded_and_loaded_again,
    an_archive_without_its_joint_is_refused,
    steps_far_from_the_default_are_taken,
]
