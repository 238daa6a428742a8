"""Instances of FMUs without a library: its functions are Python's, so that they can answer whatever a test wants."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from harness.fmu.description import Description, Variable
from harness.fmu.instances.fmi2 import Fmi2Slave
from harness.fmu.instances.message_log import discard_message

VARIABLES = {name: Variable(name, k, "Real", "output", fmi_type="Real") for k, name in enumerate(("a", "b"))}


def _plain(function: Callable[..., int]) -> Callable[..., int]:
    """A function that takes attributes, as one of a library does."""
    return lambda *arguments: function(*arguments)


class _Instance:
    component = 1

    def __init__(self, functions: Mapping[str, Callable[..., int]]) -> None:
        self.dll = {name: _plain(lambda *_: 0) for name in ("fmi2DoStep", "fmi2GetReal", "fmi2SetReal")}
        self.dll |= {name: _plain(function) for name, function in functions.items()}

    def instantiate(self, **_how: object) -> None:
        pass

    setupExperiment = enterInitializationMode = exitInitializationMode = lambda *_: 0  # noqa: N815


class Fake2(Fmi2Slave):
    """An instance "pump" of FMI 2.0 whose library has the given functions."""

    def __init__(self, **functions: Callable[..., int]) -> None:
        self._functions = functions
        super().__init__(Description("Fake", "fake", "", VARIABLES), Path("nowhere"), "pump", discard_message)
        self.initialize(0.0, 10.0)

    def _load(self, **where: str) -> Any:
        return _Instance(self._functions)
