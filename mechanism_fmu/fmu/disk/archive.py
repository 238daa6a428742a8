"""An FMU file whose bytes depend on its contents alone."""

from __future__ import annotations

import hashlib
import lzma
import os
import struct
import uuid
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree

from ..parts.model_description import to_bytes
from .folders import unsafe_name

#: Name of the description within the archive.
DESCRIPTION = "modelDescription.xml"

#: The first moment that a zip archive can write down.
_TIME = (1980, 1, 1, 0, 0, 0)

#: What zipfile raises, beside its own error, for archives that are damaged, cut off, encrypted, or compressed in a way
#: that it does not know.
_DAMAGED = (zlib.error, lzma.LZMAError, struct.error, EOFError, RuntimeError, ValueError, OverflowError)

#: Level of libdeflate that compresses most.
_SHORTEST = 12

_FILE, _PROGRAM = 0o100644, 0o100755


def content_hash(files: Mapping[str, bytes]) -> str:
    """SHA-256 of named contents, as 64 hexadecimal digits; the order of the names does not matter."""
    digest = hashlib.sha256()
    for name, contents in sorted(files.items()):
        digest.update(f"{name}\0{len(contents)}\0".encode())
        digest.update(contents)
    return digest.hexdigest()


def read_entries(path: Path) -> dict[str, bytes]:
    """Contents of all files of a zip archive, by name; the names are safe to unpack (`folders`).

    Raises:
        OSError: the file cannot be read.
        zipfile.BadZipFile: it is no zip archive, or a damaged one, or one with names that are not safe.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            objection = unsafe_name(archive.infolist())
            if objection is not None:
                raise zipfile.BadZipFile(objection)
            return {name: archive.read(name) for name in archive.namelist()}
    except _DAMAGED as error:
        raise zipfile.BadZipFile(str(error) or "an entry is cut off") from error


def with_guid(entries: Mapping[str, bytes]) -> dict[str, bytes]:
    """The entries of an FMU with a GUID that is a fingerprint of all of them, whatever GUID they had."""
    root = ElementTree.fromstring(entries[DESCRIPTION])
    root.set("guid", "")
    digest = content_hash({**entries, DESCRIPTION: to_bytes(root)})
    root.set("guid", f"{{{uuid.UUID(digest[:32])}}}")
    return {**entries, DESCRIPTION: to_bytes(root)}


def write_archive(entries: Mapping[str, bytes], path: Path, *, compressed: bool = False) -> None:
    """Write an FMU: sorted, with fixed times and permissions, and never half of it.

    What is stored is the same everywhere; what is compressed depends on the version of libdeflate.
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.unfinished")
    try:
        with zipfile.ZipFile(temporary, "w") as archive:
            for name, contents in sorted(entries.items()):
                info = zipfile.ZipInfo(name, _TIME)
                info.create_system = 3  # Unix, on every system
                info.external_attr = (_PROGRAM if name.startswith("binaries/") else _FILE) << 16
                _write_deflated(archive, info, contents) if compressed else archive.writestr(info, contents)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def _write_deflated(archive: zipfile.ZipFile, info: zipfile.ZipInfo, contents: bytes) -> None:
    """Append contents as libdeflate compresses them: 4 % shorter than by zlib, which is all that zipfile can use."""
    import deflate  # what compiles the engine imports this module, and has no other packages

    packed = deflate.deflate_compress(contents, _SHORTEST)
    info.compress_type = zipfile.ZIP_DEFLATED
    info.CRC, info.file_size, info.compress_size = zlib.crc32(contents), len(contents), len(packed)
    assert archive.fp is not None
    info.header_offset = archive.start_dir
    archive.fp.seek(archive.start_dir)
    archive.fp.write(info.FileHeader())
    archive.fp.write(packed)
    archive.start_dir = archive.fp.tell()
    archive.filelist.append(info)
    archive.NameToInfo[info.filename] = info
