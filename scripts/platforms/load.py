"""Writes what scripts/platforms/host.c reads, and compares what it printed.

    python scripts/platforms/load.py write force|displacement LOAD.txt LOAD.csv
    python scripts/platforms/load.py compare REFERENCE.txt OTHER.txt
    python scripts/platforms/load.py against SIMULATED.csv OTHER.txt

The load is a growing two-tone force or displacement with nested loops, in the bits of its doubles,
so that no two systems round it differently, each sample with the derivatives of the cubic through
value and slope to the next; as a table it is for `iwan simulate`. `compare` and `against` print one
line: identical bits, or the largest difference of any signal relative to that signal's largest
value, and exit status 1.
"""

import math
import struct
import sys
from pathlib import Path

ROWS = 4001
DURATION = 4.0
LARGEST = {"force": ("N", 600.0), "displacement": ("m", 8e-5)}
SIGNALS = ["force", "displacement", "dissipation", "dissipation_rate", "stored_energy"]
SIGNALS += ["slip_displacement", "tangent_stiffness"]
# What `iwan simulate` writes after the time.
SIMULATED = ["force", "displacement", "dissipation", "stored_energy"]


def bits(value: float) -> str:
    """The double as 16 hexadecimal digits."""
    return struct.pack(">d", value).hex()


def shape(time: float) -> tuple[float, float]:
    """Load over its largest value, and its rate."""
    turns = 2.0 * math.pi
    slow, fast = 2.0 * turns, 11.0 * turns
    wave = (math.sin(slow * time) + 0.5 * math.sin(fast * time)) / 1.5
    rate = (slow * math.cos(slow * time) + 0.5 * fast * math.cos(fast * time)) / 1.5
    return wave * time / DURATION, rate * time / DURATION + wave / DURATION


def write(drive: str, path: Path, table: Path) -> None:
    """Writes the load in both forms and prints its count of rows."""
    unit, largest = LARGEST[drive]
    times = [DURATION * row / (ROWS - 1) for row in range(ROWS + 1)]
    loads = [[largest * value for value in shape(time)] for time in times]
    lines, rows = [], [f"time [s],{drive} [{unit}]"]
    for row in range(ROWS):
        (here, leaving), (there, coming) = loads[row], loads[row + 1]
        size = times[row + 1] - times[row]
        rise = (there - here) / size
        second = (6.0 * rise - 4.0 * leaving - 2.0 * coming) / size
        third = (6.0 * (leaving + coming) - 12.0 * rise) / size**2
        lines.append(" ".join(map(bits, (times[row], here, leaving, second, third))))
        rows.append(f"{times[row]!r},{here!r}")
    path.write_text("\n".join(lines) + "\n")
    table.write_text("\n".join(rows) + "\n")
    print(ROWS)


def read(path: Path) -> list[list[float]]:
    """Rows that a host printed."""
    rows = [line.split() for line in path.read_text().splitlines()]
    return [[struct.unpack(">d", bytes.fromhex(cell))[0] for cell in row] for row in rows]


def as_bits(rows: list[list[float]]) -> list[list[str]]:
    """So that 0 and -0 differ."""
    return [[bits(value) for value in row] for row in rows]


def compare(reference: Path, other: Path) -> bool:
    """Prints how far two hosts' rows lie apart; true where they are the same bits."""
    return same(read(reference), read(other), SIGNALS)


def against(simulated: Path, other: Path) -> bool:
    """The same for a host's rows and the table of `iwan simulate`."""
    lines = simulated.read_text().splitlines()[1:]
    expected = [[float(cell) for cell in line.split(",")[1:]] for line in lines]
    places = [SIGNALS.index(name) for name in SIMULATED]
    return same(expected, [[row[place] for place in places] for row in read(other)], SIMULATED)


def same(expected: list[list[float]], came: list[list[float]], signals: list[str]) -> bool:
    """Prints the comparison; a NaN is never the same."""
    if len(expected) != ROWS or len(came) != ROWS:
        print(f"{len(expected)} and {len(came)} rows instead of {ROWS}")
        return False
    if as_bits(expected) == as_bits(came):
        print(f"bit-identical ({ROWS - 1} steps, {len(signals)} signals)")
        return True
    largest, where = 0.0, ""
    for index, name in enumerate(signals):
        scale = max(abs(row[index]) for row in expected)
        apart = max(abs(a[index] - b[index]) for a, b in zip(expected, came, strict=True))
        if scale == 0.0 or math.isnan(apart):
            print(f"{name}: nothing to compare")
            return False
        if apart / scale > largest:
            largest, where = apart / scale, name
    print(f"largest relative difference {largest:.1e} ({where})")
    return False


def main() -> int:
    """Command line."""
    match sys.argv[1:]:
        case ["write", drive, path, table]:
            write(drive, Path(path), Path(table))
            return 0
        case ["compare", reference, other]:
            return 0 if compare(Path(reference), Path(other)) else 1
        case ["against", simulated, other]:
            return 0 if against(Path(simulated), Path(other)) else 1
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
