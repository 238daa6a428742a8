"""Universal binaries of macOS: FMI 2.0 has one folder for both of its processors."""

from __future__ import annotations

import struct
from collections.abc import Sequence

_MAGIC = 0xCAFEBABE
#: Each library begins at a multiple of 2^14 bytes, the page of Apple's own processors.
_ALIGNMENT = 14
_HEAD, _ENTRY = struct.Struct(">II"), struct.Struct(">5I")


def universal(libraries: Sequence[bytes]) -> bytes:
    """One file of Mach-O libraries for different processors (`fat_header` and `fat_arch` of mach-o/fat.h)."""
    entries, body = [], b""
    place = _HEAD.size + len(libraries) * _ENTRY.size
    for library in libraries:
        body += bytes(-(place + len(body)) % 2**_ALIGNMENT)
        processor, kind = struct.unpack_from("<II", library, 4)
        entries.append(_ENTRY.pack(processor, kind, place + len(body), len(library), _ALIGNMENT))
        body += library
    return _HEAD.pack(_MAGIC, len(libraries)) + b"".join(entries) + body
