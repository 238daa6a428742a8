"""Model of an FMU from the Python sources that travel in it, if they are for the engine that stands here."""

from __future__ import annotations

import os
import re
import sys
import tempfile
import zipfile
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from types import ModuleType

from ..engine.run import library_path
from ..fmu.disk.archive import read_entries
from ..fmu.start import import_checked, private_cache
from ..model import Model

_LIBRARY = Path(__file__).parents[1]

#: What decides on an FMU's numbers, beside its model.
_DECISIVE = re.compile(r"(engine|model|tables)/.*\.py|(codes|simulation|tolerances)\.py")

#: The slave file, and what it says to `start.slave_class`.
_START = re.compile(r'= slave_class\("(\w+)", "models\.([\w.]+)"\)')


class NoBatchError(ValueError):
    """An FMU's designs cannot run in one call with the same numbers; the message says why, and what can be done."""


def model_of_fmu(path: Path) -> tuple[Model, Path | None]:
    """The model of an FMU file, and the engine's library that travels in it (None: none for this platform).

    The model's sources are those of the FMU, and are run in this process: give it no FMU that you would not run.
    Everything that turns them into numbers must be the same here as there.

    Raises:
        NoBatchError: the FMU holds no such sources, or they are for another engine.
    """
    try:
        entries = read_entries(path)
    except (OSError, zipfile.BadZipFile) as error:
        raise NoBatchError(f"'{path}' cannot be read as an FMU: {error}.") from error
    package, module = _named_by_slave(path, entries)
    prefix = f"resources/{package}/"
    files = {name.removeprefix(prefix): data for name, data in entries.items() if name.startswith(prefix)}
    _require_same_engine(path, files)
    place = library_path(Path("engine/compiled"))
    library = "" if place is None else place.as_posix()
    wanted = {name: data for name, data in files.items() if name.startswith("models/") or name == library}
    try:
        folder = _unpacked(wanted, private_cache() / package)
    except OSError as error:
        raise NoBatchError(
            f"The model of '{path}' cannot be unpacked ({error}); set the environment variable MECHANISM_FMU_CACHE to "
            "a folder that you alone can write."
        ) from error
    try:
        model: Model = _imported(folder / "models", f"{_LIBRARY.name}.{package}", module).MODEL
    except ImportError as error:
        raise NoBatchError(f"The model of '{path}' cannot be imported here: {error}.") from error
    return model, folder / library if library in files else None


def _named_by_slave(path: Path, entries: Mapping[str, bytes]) -> tuple[str, str]:
    """Name of the package that travels, and of the model's module in its folder of models."""
    for name, data in entries.items():
        found = (
            name.startswith("resources/") and name.count("/") == 1 and _START.search(data.decode("utf-8", "replace"))
        )
        if found:
            return found[1], found[2]
    raise NoBatchError(
        f"'{path}' holds no Python model of mechanism_fmu, so only the FMU itself can run its designs; for many of "
        "them in one call, build it without --flavour native."
    )


def _require_same_engine(path: Path, files: Mapping[str, bytes]) -> None:
    """Refuse an FMU whose sources of numbers are not those that stand here."""
    for name, data in sorted(files.items()):
        if _DECISIVE.fullmatch(name):
            here = _LIBRARY / name
            if not here.is_file() or here.read_text(encoding="utf-8-sig").encode() != data:
                raise NoBatchError(
                    f"'{path}' was built from another state of mechanism_fmu ({name} is not the same), and might give "
                    "other numbers; build it anew."
                )


def _unpacked(files: Mapping[str, bytes], folder: Path) -> Path:
    """Files in a folder that is named after their contents; an FMU that starts here finds them."""
    for name, data in files.items():
        path = folder / name
        if not path.is_file() or path.read_bytes() != data:
            path.parent.mkdir(parents=True, exist_ok=True)
            with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as temporary:
                temporary.write(data)
            os.chmod(temporary.name, 0o644)
            os.replace(temporary.name, path)
    return folder


def _imported(folder: Path, package: str, module: str) -> ModuleType:
    """A module of the FMU's folder of models, whose imports lead to the library that stands here."""
    if package not in sys.modules:
        import_checked(folder)
        whole = ModuleType(package)
        whole.__path__ = [str(folder)]
        sys.modules[package] = whole
    return import_module(f"{package}.{module}")
