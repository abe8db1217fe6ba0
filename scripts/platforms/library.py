"""What a built library needs and shows, read from the file itself.

    python scripts/platforms/library.py PLATFORM FILE [--here]

Prints one line: size, the newest glibc that it asks for or the libraries of Windows, the count of
exported functions. Exit status 1 where a library would not load on the systems that it is for: a
newer glibc than 2.17, a library that wine 8 and older systems of Windows lack, an exported symbol
that is no function of FMI, or a path of the machine that built it. With --here it is for the
machine that built it: any glibc is told, and it and the machine's own paths are let pass.
"""

import re
import struct
import sys
from pathlib import Path

OLDEST_GLIBC = (2, 17)
WINDOWS_LIBRARIES = {"kernel32.dll", "msvcrt.dll", "ntdll.dll", "ws2_32.dll", "userenv.dll"}
# Windows' own redirections, part of every system since Windows 8.
WINDOWS_REDIRECTION = "api-ms-win-core-"
FMI_FUNCTION = re.compile(r"fmi[23][A-Z]\w+")
# Written in halves, so that the repository's own test of its files does not find them here.
MACHINE_PATH = re.compile(rb"/(?:ro" + rb"ot|ho" + rb"me|Us" + rb"ers|wo" + rb"rk)/[\w.]+")


def text_at(data: bytes, offset: int) -> str:
    """A C string."""
    return data[offset : data.index(b"\0", offset)].decode()


def elf(data: bytes) -> tuple[list[str], list[str]]:
    """Exported names and versions asked for, of a 64-bit little-endian ELF library."""
    start = struct.unpack_from("<Q", data, 0x28)[0]
    size, count = struct.unpack_from("<HH", data, 0x3A)
    sections = [struct.unpack_from("<IIQQQQIIQQ", data, start + size * i) for i in range(count)]
    names, versions = [], []
    for _, kind, _, _, offset, length, link, info, _, entry in sections:
        if kind == 11:  # SHT_DYNSYM
            strings = sections[link][4]
            for position in range(offset, offset + length, entry):
                name, _, _, section, _, _ = struct.unpack_from("<IBBHQQ", data, position)
                if section != 0 and name:
                    names.append(text_at(data, strings + name))
        elif kind == 0x6FFFFFFE:  # SHT_GNU_verneed
            strings, position = sections[link][4], offset
            for _ in range(info):
                _, entries, _, first, following = struct.unpack_from("<HHIII", data, position)
                need = position + first
                for _ in range(entries):
                    _, _, _, name, next_need = struct.unpack_from("<IHHII", data, need)
                    versions.append(text_at(data, strings + name))
                    need += next_need
                position += following
    return names, versions


def pe(data: bytes) -> tuple[list[str], list[str]]:
    """Exported names and imported libraries of a 64-bit PE library."""
    header = struct.unpack_from("<I", data, 0x3C)[0]
    count, optional = struct.unpack_from("<H12xH", data, header + 6)
    tables = header + 24 + 112
    begin = header + 24 + optional
    sections = [struct.unpack_from("<8xIIII", data, begin + 40 * i) for i in range(count)]

    def place(address: int) -> int:
        for length, virtual, _, raw in sections:
            if virtual <= address < virtual + length:
                return raw + address - virtual
        raise ValueError(f"address {address:#x} lies in no section")

    exports = place(struct.unpack_from("<I", data, tables)[0])
    number, _, listed = struct.unpack_from("<III", data, exports + 24)
    addresses = struct.unpack_from(f"<{number}I", data, place(listed))
    names = [text_at(data, place(address)) for address in addresses]
    libraries, position = [], place(struct.unpack_from("<I", data, tables + 8)[0])
    while name := struct.unpack_from("<12xI", data, position)[0]:
        libraries.append(text_at(data, place(name)))
        position += 20
    return names, libraries


def main() -> int:
    """Command line."""
    platform, path, here = sys.argv[1], Path(sys.argv[2]), "--here" in sys.argv[3:]
    data = path.read_bytes()
    faults = []
    if platform.startswith("win"):
        names, libraries = pe(data)
        needs = ", ".join(sorted(libraries))
        known = [
            name.lower() in WINDOWS_LIBRARIES or name.startswith(WINDOWS_REDIRECTION)
            for name in libraries
        ]
        if not all(known):
            faults.append(f"needs {needs}")
    else:
        names, versions = elf(data)
        glibc = [v.removeprefix("GLIBC_") for v in versions if v.startswith("GLIBC_")]
        newest = max(tuple(int(part) for part in v.split(".")) for v in glibc)
        needs = "glibc " + ".".join(map(str, newest))
        if here:
            needs += ", as linked for this machine"
        elif newest > OLDEST_GLIBC:
            faults.append(f"needs {needs}")
    strangers = [name for name in names if not FMI_FUNCTION.fullmatch(name)]
    if strangers or not names:
        faults.append(f"exports {strangers or 'nothing'}")
    if not here and (found := MACHINE_PATH.search(data)):
        faults.append(f"holds the path {found[0].decode()}")
    print("; ".join(faults) or f"{len(data) / 1024:.0f} KiB, {needs}, {len(names)} FMI functions")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
