"""Start check: whether a mechanism can start with its default values, asked once when its FMU is built."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from ...model import MechanismError


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
