"""A machine of which only descriptions are known: enough to check what is connected, and in which order it goes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, cast

from ...description import Description
from ..component import Component
from ..connection import Connection
from ..machine import Machine


def described(descriptions: Mapping[str, Description], connections: Sequence[Connection] = ()) -> Machine:
    """The machine of components that are not there yet; nothing can be asked of it but what it is.

    Raises:
        UsageError: as `Machine`.
    """
    absent = {name: cast(Component, _Absent(name, description)) for name, description in descriptions.items()}
    return Machine(absent, connections)


class _Absent:
    """As much of a `Component` as a machine asks for before it begins."""

    def __init__(self, name: str, description: Description) -> None:
        self.name = name
        self.description = description

    def reals(self, names: Sequence[str]) -> _NoReals:
        return _NoReals(names)

    def __getattr__(self, name: str) -> Any:
        """Whatever else a component can do is not to be called."""
        return _not_there


def _not_there(*_: object) -> Any:
    raise NotImplementedError("this component is known by its description only")


class _NoReals:
    """Values that nobody has."""

    def __init__(self, names: Sequence[str]) -> None:
        self.values = [0.0] * len(names)

    def __getattr__(self, name: str) -> Any:
        """Whatever else they can do is not to be called."""
        return _not_there
