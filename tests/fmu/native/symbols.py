"""What an object file leaves to the linker, in the three formats that the targets have."""

from __future__ import annotations

import struct
from collections.abc import Iterator


def undefined_symbols(data: bytes) -> set[str]:
    """Names that an object file uses and does not define, as they are called in C.

    Raises:
        ValueError: it is neither ELF, nor Mach-O, nor COFF for x86-64.
    """
    if data[:4] == b"\x7fELF":
        return set(_elf(data))
    if data[:4] == b"\xcf\xfa\xed\xfe":
        return {name.removeprefix("_") for name in _mach_o(data)}
    if data[:2] == b"\x64\x86":
        return set(_coff(data))
    raise ValueError(f"No object file of a known format begins with {data[:4]!r}.")


def _text(data: bytes, start: int) -> str:
    return data[start : data.index(b"\0", start)].decode()


def _elf(data: bytes) -> Iterator[str]:
    """ELF-64 (System V ABI, chapter 4)."""
    (first,) = struct.unpack_from("<Q", data, 0x28)
    size, count = struct.unpack_from("<HH", data, 0x3A)
    sections = [struct.unpack_from("<IIQQQQI", data, first + k * size) for k in range(count)]
    for _, kind, _, _, offset, length, link in sections:
        if kind != 2:
            continue
        names = sections[link][4]
        for name, _, _, section, _, _ in struct.iter_unpack("<IBBHQQ", data[offset : offset + length]):
            if name and section == 0:
                yield _text(data, names + name)


def _mach_o(data: bytes) -> Iterator[str]:
    """Mach-O 64 (mach-o/loader.h, mach-o/nlist.h)."""
    (commands,) = struct.unpack_from("<I", data, 16)
    at = 32
    for _ in range(commands):
        command, size = struct.unpack_from("<II", data, at)
        if command == 2:
            symbols, count, names, _ = struct.unpack_from("<IIII", data, at + 8)
            for name, kind, _, _, _ in struct.iter_unpack("<IBBHQ", data[symbols : symbols + 16 * count]):
                if kind & 0x0E == 0 and kind & 1:
                    yield _text(data, names + name)
        at += size


def _coff(data: bytes) -> Iterator[str]:
    """COFF (Microsoft PE format, section "COFF symbol table")."""
    table, count = struct.unpack_from("<II", data, 8)
    names, k = table + 18 * count, 0
    while k < count:
        at = table + 18 * k
        _, section, _, storage, behind = struct.unpack_from("<IhHBB", data, at + 8)
        if section == 0 and storage == 2:
            zeros, offset = struct.unpack_from("<II", data, at)
            yield data[at : at + 8].rstrip(b"\0").decode() if zeros else _text(data, names + offset)
        k += 1 + behind
