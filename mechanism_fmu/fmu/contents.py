"""What the FMU of a model holds in every flavour, and what is asked of a model before it becomes one."""

from __future__ import annotations

import inspect
import keyword
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from xml.etree.ElementTree import Element, SubElement

from ..model import MechanismError, Model
from ..model.baked import NOTHING_BAKED, Baked, baked_model
from .analysis import analysis
from .documentation import documentation
from .drawing import drawing
from .logic import logic
from .model_description import NO_SOURCES, to_bytes
from .terminals import terminals

#: Beginning of the name of the package that a user's own file is loaded into (see `own.load`).
OWN = "own_mechanism_"


@dataclass(frozen=True)
class Origin:
    """Where a model comes from.

    Attributes:
        model: the model.
        folder: of the module that holds it; its neighbours may be imported.
        own: the module is a file of the user's own, and whatever else lies in the folder is none of its business.
        notes: the docstring of such a file, as Markdown.
    """

    model: Model
    folder: Path
    own: bool
    notes: str


def model_of(module: ModuleType, baked: Baked = NOTHING_BAKED) -> Origin:
    """The model that a module holds, with what is baked into this FMU of it, and where it comes from.

    Raises:
        MechanismError: the module has no model, or one whose name no FMU can have, or nothing to bake that into.
    """
    model = getattr(module, "MODEL", None)
    if not isinstance(model, Model) or module.__file__ is None:
        raise MechanismError(f"{module.__name__} holds no model; it must set MODEL = Model(...).")
    if not re.fullmatch(r"[A-Za-z_]\w*", model.name, re.ASCII) or keyword.iskeyword(model.name):
        raise MechanismError(
            f"The model name {model.name!r} cannot name an FMU; use letters, digits and '_', and no Python keyword."
        )
    own = module.__name__.startswith(OWN)
    return Origin(
        baked_model(model, baked), Path(module.__file__).parent, own, inspect.getdoc(module) or "" if own else ""
    )


def file_in(destination: Path, name: str) -> Path:
    """Path of the FMU `name` in the folder `destination`, which is made if need be.

    Raises:
        MechanismError: the destination is no folder.
        OSError: it cannot be made.
    """
    if destination.suffix == ".fmu" or destination.is_file():
        raise MechanismError(
            f"{destination} is not a folder; give the folder for {name} (tools expect that file name)."
        )
    destination.mkdir(parents=True, exist_ok=True)
    return destination / name


def no_sources(model: Model) -> dict[str, bytes]:
    """What a tool meets that wants to compile the FMU for a platform without a binary: an error that says what to do.

    Without it, such tools end in an error of their own (FMPy 0.3: IndexError).
    """
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = SubElement(root, "BuildConfiguration", modelIdentifier=model.name, description="None: see the file")
    SubElement(SubElement(configuration, "SourceFileSet", language="C99"), "SourceFile", name=NO_SOURCES)
    text = (
        f"{model.name} has no C sources: its engine is compiled Python. Platforms with a binary are in its folder "
        "binaries; for others, run mechanism-fmu build there without --flavour native, which needs Python."
    )
    return {"sources/buildDescription.xml": to_bytes(root), f"sources/{NO_SOURCES}": f'#error "{text}"\n'.encode()}


def common_entries(origin: Origin, facts: Sequence[str], licences: Sequence[str], fmi: int = 2) -> dict[str, bytes]:
    """Documentation, drawing, logic, analyses, terminals and icon of a model, by their paths within the FMU.

    Args:
        origin: the model, and its folder with README.md and model.png, if there are any.
        facts: what the documentation says of running this flavour, as HTML.
        licences: distributions whose code travels in the FMU.
        fmi: major version of the standard.
    """
    model, folder = origin.model, None if origin.own else origin.folder
    icons = [*([folder / "model.png"] if folder else []), Path(__file__).with_name("model.png")]
    icon = next(path for path in icons if path.is_file())
    return {
        **documentation(model, folder, facts, licences, origin.notes),
        **drawing(model),
        **logic(model),
        **analysis(model),
        **terminals(model, fmi),
        **no_sources(model),
        "model.png": icon.read_bytes(),
    }
