"""Writes what scripts/platforms/host.c reads, and compares what it printed.

    python scripts/platforms/load.py write LOAD.txt
    python scripts/platforms/load.py compare REFERENCE.txt OTHER.txt

The load is a growing two-tone force with nested loops, in the bits of its doubles, so that no two
systems round it differently. `compare` prints one line: identical bits, or the largest difference
of any signal relative to that signal's largest value, and exit status 1.
"""

import math
import struct
import sys
from pathlib import Path

ROWS = 4001
DURATION = 4.0
LARGEST_FORCE = 700.0
SIGNALS = ["force", "displacement", "dissipation", "dissipation_rate", "stored_energy"]
SIGNALS += ["slip_displacement", "tangent_stiffness"]


def bits(value: float) -> str:
    """The double as 16 hexadecimal digits."""
    return struct.pack(">d", value).hex()


def write(path: Path) -> None:
    """Writes the load and prints its count of rows."""
    lines = []
    for row in range(ROWS):
        time = DURATION * row / (ROWS - 1)
        turns = 2.0 * math.pi * time
        shape = (math.sin(2.0 * turns) + 0.5 * math.sin(11.0 * turns)) / 1.5
        lines.append(f"{bits(time)} {bits(LARGEST_FORCE * time / DURATION * shape)}")
    path.write_text("\n".join(lines) + "\n")
    print(ROWS)


def read(path: Path) -> list[list[float]]:
    """Rows that a host printed."""
    rows = [line.split() for line in path.read_text().splitlines()]
    return [[struct.unpack(">d", bytes.fromhex(cell))[0] for cell in row] for row in rows]


def compare(reference: Path, other: Path) -> bool:
    """Prints how far two hosts' rows lie apart; true where they are the same bits."""
    expected, came = read(reference), read(other)
    if len(expected) != ROWS or len(came) != ROWS:
        print(f"{len(expected)} and {len(came)} rows instead of {ROWS}")
        return False
    if reference.read_text().split() == other.read_text().split():
        print(f"bit-identical ({ROWS} steps, {len(SIGNALS)} signals)")
        return True
    largest, where = 0.0, ""
    for index, name in enumerate(SIGNALS):
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
        case ["write", path]:
            write(Path(path))
            return 0
        case ["compare", reference, other]:
            return 0 if compare(Path(reference), Path(other)) else 1
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
