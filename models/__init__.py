"""Ready-made mechanisms, one folder each: `model.py` with `MODEL`, README, drawing, reference curve.

And machines of them, in `machines`, one file each.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType

from mechanism_fmu.model import MechanismError


def available() -> dict[str, Path]:
    """Folders of all models, by name."""
    return {path.parent.name: path.parent for path in sorted(Path(__file__).parent.glob("*/model.py"))}


def machines() -> dict[str, Path]:
    """Files of all machines, by name."""
    return {path.stem: path for path in sorted((Path(__file__).parent / "machines").glob("*.toml"))}


def load(name: str) -> ModuleType:
    """The module `models.<name>.model`, which holds `MODEL`.

    Args:
        name: one of `available()`.

    Raises:
        MechanismError: there is no such model; the message lists those that there are.
    """
    if name not in available():
        raise MechanismError(f"There is no model {name!r}; there are: {', '.join(available())}.")
    return import_module(f"{__name__}.{name}.model")
