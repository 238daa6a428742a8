"""User's model file made ready to be built: from the command line to an imported module."""

from __future__ import annotations

import importlib.util
import os
import sys
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType

from ...model import MechanismError, Model
from ..parts.contents import OWN
from .examine import examine
from .find import find
from .mistakes import explained

# A user's file as a module.


def load(path: Path) -> ModuleType:
    """Execute a user's file as a module of a package that is its folder.

    Because of that package, its name cannot hide that of another module, and `from .neighbour import ...` finds the
    file beside it. Nothing is put on `sys.path`, and nothing is written into the folder.

    Raises:
        MechanismError: the file cannot be executed, or it sets no MODEL.
    """
    folder = Path(os.path.abspath(path)).parent
    package = f"{OWN}{zlib.crc32(str(folder / path.name).encode()):08x}"
    for name in [name for name in sys.modules if name.partition(".")[0] == package]:
        del sys.modules[name]
    whole = ModuleSpec(package, None, is_package=True)
    whole.submodule_search_locations = [str(folder)]
    sys.modules[package] = importlib.util.module_from_spec(whole)
    spec = importlib.util.spec_from_file_location(f"{package}.{path.stem}", path)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    module.__file__ = str(path)  # as the user wrote it, for messages
    sys.modules[module.__name__] = module
    with explained(path), _nothing_written():
        exec(compile(_source(path), str(path), "exec", dont_inherit=True), module.__dict__)
        _require_model(module)
    return module


def _source(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise MechanismError("the file is not in UTF-8; save it in that encoding.") from None


@contextmanager
def _nothing_written() -> Iterator[None]:
    """Leave no compiled copy of what is imported in the user's folder."""
    before, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        yield
    finally:
        sys.dont_write_bytecode = before


def _require_model(module: ModuleType) -> None:
    model = getattr(module, "MODEL", None)
    if isinstance(model, Model):
        return
    how = "MODEL = Model(name, description, parameters, mechanism)"
    if model is not None:
        what = type(model).__name__
        raise MechanismError(
            f"MODEL is of type {what}, but it must be a Model. Write {how}, where mechanism is a function that takes "
            "the parameter values and returns a Mechanism."
        )
    others = [name for name, value in vars(module).items() if isinstance(value, Model)]
    if others:
        raise MechanismError(f"it sets no MODEL, but {others[0]} is a Model: name it MODEL.")
    raise MechanismError(f"it sets no MODEL; end the file with {how}. To see one, run: mechanism-fmu new my_mechanism")


def prepare(text: str, native: bool, warn: Callable[[str], None]) -> tuple[ModuleType, Path]:
    """Find, load and examine a user's file.

    Args:
        text: the path as it was written.
        native: see `examine`.
        warn: is called with each warning.

    Returns:
        The module that holds `MODEL`, and the file.

    Raises:
        WrongUseError: there is no such file.
        MechanismError: there is a mistake in it.
    """
    path = find(text)
    module = load(path)
    for remark in examine(module, path, native):
        warn(remark)
    return module, path
