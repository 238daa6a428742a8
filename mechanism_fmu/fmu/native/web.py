"""A model for a page: the engine and the FMI 3.0 surface as one WebAssembly module for all models, and its data."""

from __future__ import annotations

import sys
import uuid
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from ...model import Model, compile_mechanism
from ...model.baked import NOTHING_BAKED, Baked
from ...model.trace import trace
from ...tables.layout import pack
from ..disk.archive import content_hash
from ..parts.contents import model_of
from .formulas import formulas
from .model_data import model_data
from .model_image import model_image
from .objects import Report, silently, web_library
from .sources import fingerprint


@dataclass(frozen=True)
class WebModule:
    """A model for a page.

    Attributes:
        model: the model.
        token: FMI 3.0's instantiation token, which the module asks for.
        binary: the WebAssembly module, the same for all models. It imports nothing; it exports the functions of FMI 3.0
            that a page needs, and those of page.c and loaded.c.
        image: the model, which the module loads once, before anything else is called.
    """

    model: Model
    token: str
    binary: bytes
    image: bytes


def web_module(module: ModuleType, report: Report = silently, *, baked: Baked = NOTHING_BAKED) -> WebModule:
    """As `web_model`, of what a Python module holds.

    Args:
        module: what holds `MODEL`, e.g. `models.ratchet.model`.
        report: see `compiled_engine`.
        baked: numbers that it has as its own.

    Raises:
        MechanismError: the module has no model, or as of `web_model`.
    """
    return web_model(model_of(module, baked).model, report)


def web_model(model: Model, report: Report = silently) -> WebModule:
    """A model for a page; without a compiler, where the module of all models is there.

    Args:
        model: the model.
        report: see `compiled_engine`.

    Raises:
        MechanismError: the model cannot be traced; or the module of all models is to be made, and there is no linker.
    """
    traced = formulas(trace(model), pack(compile_mechanism(model.build(model.values()))))
    binary = web_library(report)
    unnamed = model_image(model_data(model, traced, "", bytes(16)), traced)
    guid = uuid.UUID(content_hash({"image": unnamed, "binary": binary})[:32])
    image = model_image(model_data(model, traced, f"{{{guid}}}", guid.bytes), traced)
    return WebModule(model, f"{{{guid}}}", binary, image)


def sources_of(module: ModuleType) -> str:
    """A digest of what a model is made from: its module, what of its package it has imported, the engine's sources.

    Args:
        module: what holds `MODEL`, just loaded.

    Raises:
        OSError: a file of it is gone.
    """
    package = f"{module.__name__.rpartition('.')[0]}."
    files = {
        name.removeprefix(package): Path(file).read_bytes()
        for name, found in list(sys.modules.items())
        if name.startswith(package) and (file := getattr(found, "__file__", None))
    }
    return content_hash({**files, "engine": fingerprint(Path(__file__).parents[2]).encode()})
