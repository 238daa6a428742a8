"""What the FMU of a model holds in every flavour, and what is asked of a model before it becomes one."""

from __future__ import annotations

import keyword
import re
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

from ..model import MechanismError, Model
from .documentation import documentation
from .drawing import drawing
from .logic import logic


def model_of(module: ModuleType) -> tuple[Model, Path]:
    """The model that a module holds, and the folder of the module.

    Raises:
        MechanismError: the module has no model, or one whose name no FMU can have.
    """
    model = getattr(module, "MODEL", None)
    if not isinstance(model, Model) or module.__file__ is None:
        raise MechanismError(f"{module.__name__} holds no model; it must set MODEL = Model(...).")
    if not re.fullmatch(r"[A-Za-z_]\w*", model.name, re.ASCII) or keyword.iskeyword(model.name):
        raise MechanismError(
            f"The model name {model.name!r} cannot name an FMU; use letters, digits and '_', and no Python keyword."
        )
    return model, Path(module.__file__).parent


def file_in(destination: Path, name: str) -> Path:
    """Path of the FMU `name` in the folder `destination`, which is made if need be.

    Raises:
        MechanismError: the destination is no folder.
        OSError: it cannot be made.
    """
    if destination.suffix == ".fmu" or destination.is_file():
        raise MechanismError(f"{destination} is not a folder; give the folder for {name} (tools expect that file name).")
    destination.mkdir(parents=True, exist_ok=True)
    return destination / name


def common_entries(model: Model, folder: Path, facts: Sequence[str], licences: Sequence[str]) -> dict[str, bytes]:
    """Documentation, drawing, logic and icon of a model, by their paths within the FMU.

    Args:
        model: the model.
        folder: of the model, with its README.md and model.png, if there are any.
        facts: what the documentation says of running this flavour, as HTML.
        licences: distributions whose code travels in the FMU.
    """
    icon = next(path for path in (folder / "model.png", Path(__file__).with_name("model.png")) if path.is_file())
    return {
        **documentation(model, folder, facts, licences),
        **drawing(model),
        **logic(model),
        "model.png": icon.read_bytes(),
    }
