"""Marks of cases as JSON lines, written as they come: a run that stops goes on where it was."""

import fcntl
import hashlib
import json
from pathlib import Path

SCHEMA = "laboratory-marks/1"


class Foreign(Exception):
    """The file holds marks of another seed or finder, or another run is writing it."""


def fingerprint(program):
    """First twelve digits of the SHA-256 of a program."""
    return hashlib.sha256(Path(program).read_bytes()).hexdigest()[:12]


def read(path):
    """(header, marks) of a file; a last line cut short by an interruption is left out."""
    lines = Path(path).read_text(encoding="utf-8").split("\n")
    whole = [json.loads(line) for line in lines[:-1]]
    if not whole or whole[0].get("schema") != SCHEMA:
        raise Foreign(f"{path} does not hold marks")
    return whole[0], whole[1:]


class Marks:
    """One file of marks; the first line says of which seed and which finder.

    It is locked while it is open, so that two runs do not mark the same cases.
    """

    def __init__(self, path, seed, finder):
        path = Path(path)
        header = {"schema": SCHEMA, "seed": seed, "finder": finder}
        self.known = {}
        path.parent.mkdir(parents=True, exist_ok=True)
        self.out = path.open("a", encoding="utf-8")
        try:
            fcntl.flock(self.out, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self.out.close()
            raise Foreign(f"another run is writing {path}") from None
        if path.stat().st_size:
            found, marks = read(path)
            if found != header:
                self.out.close()
                raise Foreign(f"{path} is of {found}, not of {header}: choose another folder")
            self.known = {mark["key"]: mark for mark in marks}
            self.out.truncate(path.read_bytes().rfind(b"\n") + 1)  # a line cut short
        else:
            self._write(header)

    def _write(self, line):
        self.out.write(json.dumps(line) + "\n")
        self.out.flush()

    def add(self, key, mark):
        """Append one case."""
        self.known[key] = {"key": key, **mark}
        self._write(self.known[key])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.out.close()
