"""Fresh instances of one archive, of either version of FMI, for checks of what it declares."""

import fmpy_archive
from fmpy_simulation import Slave, Unit
from fmpy_three import Pair
from fmpy_three import Slave as Slave3


class Probe:
    """Fresh instances of one archive, brought to their first communication point."""

    def __init__(self, subject: Unit | Pair, three: bool):
        self.subject, self.three = subject, three
        two = subject.two if three else subject
        self.input, self.size = two.input, two.scale()
        self.outputs = [n for n, v in two.variables.items() if v.causality == "output"]
        self.parameters = [n for n, v in two.variables.items() if v.causality == "parameter"]
        self.starts = {n: float(two.variables[n].start) for n in self.parameters}
        self.references = {n: v.valueReference for n, v in two.variables.items()}

    def open(self) -> Slave | Slave3:
        """An instance in its first mode."""
        return Slave3(self.subject) if self.three else Slave(self.subject)

    def initializing(self, slave, **values: float) -> None:
        """To Initialization Mode, with these values set there."""
        if not self.three:
            slave.fmu.setupExperiment(startTime=0.0)
        slave.fmu.enterInitializationMode()
        for name, value in values.items():
            self.set(slave, name, value)

    def start(self, slave) -> None:
        """To the first communication point."""
        self.initializing(slave)
        slave.fmu.exitInitializationMode()

    def set(self, slave, name: str, value: float) -> None:
        setter = slave.fmu.setFloat64 if self.three else slave.fmu.setReal
        setter([self.references[name]], [value])

    def get(self, slave, names: list[str]) -> list[float]:
        getter = slave.fmu.getFloat64 if self.three else slave.fmu.getReal
        return list(getter([self.references[name] for name in names]))

    def step(self, slave, share: float, point: float, size: float) -> list[float]:
        """Sets the input and steps."""
        self.set(slave, self.input, share * self.size)
        slave.fmu.doStep(point, size)
        return self.get(slave, self.outputs)

    def declared(self) -> dict[str, str]:
        """Flags of CoSimulation."""
        archive = self.subject.archive
        return dict(fmpy_archive.read(archive).find("CoSimulation").attrib)
