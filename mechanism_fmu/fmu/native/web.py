"""A model as a WebAssembly module, for a page: the engine and the FMI 3.0 surface, which import nothing.

The module exports the functions of FMI 3.0 that a page needs, and those of page.c.
"""

from __future__ import annotations

import uuid
from dataclasses import dataclass
from types import ModuleType

from ...model import Model, compile_mechanism
from ...model.baked import NOTHING_BAKED, Baked
from ...model.trace import trace
from ...tables.layout import pack
from ..disk.archive import content_hash
from ..disk.folders import temporary_folder
from ..parts.contents import model_of
from .formulas import formulas
from .link import WEB, link, linked_with, need_linker, surface
from .model_data import model_source
from .objects import Report, compiled_engine, silently, web_object
from .package import HEADERS, STANDARD, SURFACE

_SURFACE = (*(name for name in SURFACE if name != "fmi2.c"), "page.c")

#: Of FMI 3.0, and of the C library, what a page calls.
EXPORTS = (
    "malloc",
    "free",
    "fmi3FreeInstance",
    "fmi3Terminate",
    "fmi3Reset",
    *(f"fmi3{access}{kind}" for access in ("Get", "Set") for kind in ("Float64", "Int32", "Boolean", "FMUState")),
    "fmi3FreeFMUState",
    "fmi3DoStep",
    "fmi3GetOutputDerivatives",
)


@dataclass(frozen=True)
class WebModule:
    """A model for a page.

    Attributes:
        model: the model.
        token: FMI 3.0's instantiation token, which the module asks for.
        binary: the WebAssembly module.
    """

    model: Model
    token: str
    binary: bytes


def web_module(module: ModuleType, report: Report = silently, *, baked: Baked = NOTHING_BAKED) -> WebModule:
    """The WebAssembly module of a model: the same bytes from the same sources and versions of the tools.

    Args:
        module: what holds `MODEL`, e.g. `models.ratchet.model`.
        report: see `compiled_engine`.
        baked: numbers that it has as its own.

    Raises:
        MechanismError: there is no linker, the module has no model, or one that cannot be traced.
    """
    need_linker()
    model = model_of(module, baked).model
    traced = formulas(trace(model), pack(compile_mechanism(model.build(model.values()))))
    made_from = {"model.c": model_source(model, traced, "", bytes(16)).encode(), **linked_with(*_SURFACE, *HEADERS)}
    engine = web_object(report)
    guid = uuid.UUID(content_hash(made_from | {engine.name: engine.read_bytes()})[:32])
    headers = compiled_engine(report).headers
    with temporary_folder() as folder:
        (folder / "model.c").write_text(model_source(model, traced, f"{{{guid}}}", guid.bytes), encoding="ascii")
        made = folder / f"{model.name}{WEB.suffix}"
        link(WEB, [*surface(*_SURFACE), folder / "model.c", engine], [headers, STANDARD], made, EXPORTS)
        return WebModule(model, f"{{{guid}}}", made.read_bytes())
