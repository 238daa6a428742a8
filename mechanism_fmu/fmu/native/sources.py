"""Of which sources the compiled engine is made; the standard library is enough, as a build backend asks this, too."""

from __future__ import annotations

import hashlib
from pathlib import Path

#: Below the library: what the engine is, what its C header is written from, and what compiles and links it.
FOLDERS = ("elementary", "engine", "tables")
FILES = (
    "codes.py",
    "tolerances.py",
    "fmu/instance/protocol.py",
    "fmu/parts/model_description.py",
    *(f"fmu/native/{name}.py" for name in ("emit", "engine_header", "link", "objects", "sources")),
)
#: The C files that are linked to it.
SURFACE = "fmu/native/c"

#: Where the compiled engine lies in a wheel and, after an editable install, in a clone.
COMPILED = "fmu/native/compiled"


def fingerprint(library: Path, *, linked: bool = True) -> str:
    """SHA-256 of the engine's sources, as 64 hexadecimal digits.

    Args:
        library: the folder `mechanism_fmu`.
        linked: with the C files.

    Raises:
        OSError: it is not whole.
    """
    paths = [path for folder in FOLDERS for path in (library / folder).rglob("*.py")]
    paths += (library / name for name in FILES)
    if linked:
        paths += (library / SURFACE).glob("*.[ch]")
    digest = hashlib.sha256()
    for name, path in sorted((path.relative_to(library).as_posix(), path) for path in paths):
        contents = path.read_bytes()
        digest.update(f"{name}\0{len(contents)}\0".encode())
        digest.update(contents)
    return digest.hexdigest()


def is_compiled(library: Path) -> bool:
    """Whether a compiled engine of these sources lies in the library, each file as its digest says."""
    folder = library / COMPILED
    try:
        files = {path: path.read_text(encoding="ascii").strip() for path in folder.rglob("*.sha256")}
        whole = all(hashlib.sha256(path.with_suffix("").read_bytes()).hexdigest() == files[path] for path in files)
    except (OSError, UnicodeError):
        return False
    return bool(files) and whole and is_of_these_sources(library)


def is_of_these_sources(library: Path) -> bool:
    """Whether the compiled engine that lies in the library, whole or not, was made of the sources that lie there."""
    try:
        return (library / COMPILED / "sources").read_text(encoding="ascii").strip() == fingerprint(library)
    except (OSError, UnicodeError):
        return False
