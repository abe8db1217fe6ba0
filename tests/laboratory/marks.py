"""Marks of cases as JSON lines, written as they come: a run that stops goes on where it was."""

import hashlib
import json
from pathlib import Path

SCHEMA = "laboratory-marks/1"


class Foreign(Exception):
    """The file holds marks of another seed or of another finder."""


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
    """One file of marks; the first line says of which seed and which finder."""

    def __init__(self, path, seed, finder):
        self.path = Path(path)
        header = {"schema": SCHEMA, "seed": seed, "finder": finder}
        self.known = {}
        if self.path.exists():
            found, marks = read(self.path)
            if found != header:
                raise Foreign(f"{path} is of {found}, not of {header}: choose another folder")
            self.known = {mark["key"]: mark for mark in marks}
        self.path.parent.mkdir(parents=True, exist_ok=True)
        text = "".join(json.dumps(line) + "\n" for line in (header, *self.known.values()))
        self.path.write_text(text, encoding="utf-8")

    def add(self, key, mark):
        """Append one case."""
        self.known[key] = {"key": key, **mark}
        with self.path.open("a", encoding="utf-8") as out:
            out.write(json.dumps(self.known[key]) + "\n")
