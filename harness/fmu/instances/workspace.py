"""Folder of an extracted FMU, and its libraries for this platform."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path, PurePosixPath

import fmpy

from mechanism_fmu.fmu.disk import folders

from ...errors import UsageError
from ..description import Description

# The libraries that an FMU brings along, and which of them runs here.

#: So many of them are named in a message.
_MOST_NAMED = 12


def libraries(names: Iterable[str]) -> list[str]:
    """Those among the files of an FMU, as "<platform>/<file>"."""
    parts = [PurePosixPath(name.replace("\\", "/")).parts for name in names]
    return sorted("/".join(p[1:]) for p in parts if len(p) == 3 and p[0] == "binaries" and _is_library(p[2]))


def libraries_in(folder: Path) -> list[str]:
    """Those of an FMU that is extracted in `folder`."""
    return libraries(path.relative_to(folder).as_posix() for path in folder.glob("binaries/*/*"))


def listed(found: Iterable[str]) -> str:
    """Libraries in words."""
    names = list(found)
    more = f" and {len(names) - _MOST_NAMED} more" if len(names) > _MOST_NAMED else ""
    return ", ".join(names[:_MOST_NAMED]) + more if names else "none"


def require_library(path: Path, description: Description, names: Iterable[str]) -> None:
    """Refuse the FMU file `path` of these files if no library of it can be loaded here.

    Raises:
        UsageError: it has none for this platform, or one of another name than the standard wants.
    """
    names = list(names)
    found = libraries(names)
    platform = fmpy.platform_tuple if description.fmi == 3 else fmpy.platform
    wanted = description.identifier + fmpy.sharedLibraryExtension
    if f"{platform}/{wanted}" in found:
        return
    here = [name for name in found if name.startswith(f"{platform}/") and name.endswith(fmpy.sharedLibraryExtension)]
    if here:
        raise UsageError(
            f"'{path}' names its library {description.identifier} (modelIdentifier), but in binaries there is "
            f"{listed(here)}: by the standard the file must be {platform}/{wanted}. Rename the file in the FMU."
        )
    sources = any(name.startswith("sources/") for name in names)
    way_out = "compile its sources" if sources else "ask whoever made it"
    raise UsageError(
        f"'{path}' has no library for {platform}; its libraries: {listed(found)}. For one that runs here, {way_out}."
    )


def _is_library(name: str) -> bool:
    return name.endswith((".so", ".dll", ".dylib"))


# A folder for an extracted FMU, with a path that every FMU can load from.

#: FMUs made by pythonfmu 0.7.0 crash the process when the path to them has `# % + ? &` or letters beyond ASCII.
_PLAIN = re.compile(r"[A-Za-z0-9_./\\:~-]+")


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """A new empty folder with a plain path; it is removed afterwards, and those of killed processes before.

    Raises:
        UsageError: there is no place for it.
    """
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(folders.temporary_folder(_plain_place()))
        except OSError as error:
            raise UsageError(
                f"No temporary folder can be made ({error}); set the environment variable TMPDIR to a folder with "
                "space."
            ) from error
        yield folder


def _plain_place() -> Path:
    places = [tempfile.gettempdir(), "/tmp", "/var/tmp", os.environ.get("PUBLIC", "")]
    for place in places:
        if _PLAIN.fullmatch(place) and os.path.isdir(place) and os.access(place, os.W_OK):
            return Path(place)
    raise UsageError(
        f"The temporary folder '{places[0]}' has characters in its path that make FMUs crash "
        "(only plain letters, digits and _ . - are safe); set the environment variable TMPDIR to another one."
    )
