"""From what the user wrote on the command line to a module that can be built."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

from .examine import examine
from .find import find
from .load import load


def prepare(text: str, native: bool, warn: Callable[[str], None]) -> tuple[ModuleType, Path]:
    """Find, load and examine a user's file.

    Args:
        text: the path as it was written.
        native: see `examine`.
        warn: is told each warning.

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
