"""The libraries that an FMU brings along, and which of them runs here."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path, PurePosixPath

import fmpy

from ..description import Description
from ..errors import UsageError

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
