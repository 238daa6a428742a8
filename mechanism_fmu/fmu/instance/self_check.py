"""Start of a mechanism with its default values: the check when its FMU is built, and the engine compiled before it."""

from __future__ import annotations

import functools
import gc
import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from ...engine.run import compiled_library
from ...model import MechanismError, Model
from ...moving import MovingMechanism


class StartError(MechanismError):
    """The mechanism cannot start with its default values."""


@contextmanager
def start_explained() -> Iterator[None]:
    """Say of a refusal that it concerns the start with the default values.

    Raises:
        StartError: in place of a `MechanismError`.
    """
    try:
        yield
    except MechanismError as error:
        raise StartError(
            f"with its default values, the mechanism cannot start. {error} Look at start and start_rate of the bodies, "
            "the points of the joints, and held."
        ) from error


def require_numbers(values: Mapping[str, float]) -> None:
    """Check what the outputs are at the start.

    Raises:
        MechanismError: one is not finite.
    """
    for name, value in values.items():
        if not math.isfinite(value):
            raise MechanismError(f"{name} is {value} there, which is not a finite number.")


@functools.cache
def compile_engine(model: Model) -> None:
    """Compile the engine, or load it from the cache: in the constructor, never in the first step."""
    if compiled_library() is not None:
        return
    collects = gc.isenabled()
    gc.disable()  # the compiler makes millions of small objects and keeps them: looking for garbage costs a tenth
    try:
        with start_explained():
            simulation = MovingMechanism(model.build(model.values()))
        simulation.advance(1e-3)
        simulation.read()
    finally:
        if collects:
            gc.enable()
