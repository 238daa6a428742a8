"""What a component is to a machine: a `Slave` whose numbers are bound once, and which may be put back."""

from __future__ import annotations

from collections.abc import MutableSequence, Sequence
from typing import Any, Protocol

from ..slave import Slave


class Reals(Protocol):
    """Some Real variables of a component, bound once, so that a step costs little."""

    @property
    def values(self) -> MutableSequence[float]:
        """In the order in which they were bound: what `read` found and `write` takes."""

    def read(self) -> None:
        """Fill `values` with those of now."""

    def read_slopes(self) -> bool:
        """Fill `values` with derivatives of outputs [unit/s]; of components with `Description.gives_slopes` only.

        False where the component does not tell some of them (fmi2Discard): then `values` mean nothing.
        """

    def write(self) -> None:
        """Set the variables to `values`."""

    def write_slopes(self) -> None:
        """Let inputs change by `values` [unit/s] in the next step; of components that take slopes only."""


class Component(Slave, Protocol):
    """One part of a machine.

    Every method raises `FmuError` when the component refuses or fails; the run then ends.
    """

    @property
    def name(self) -> str:
        """Of the part, in the machine."""

    def reals(self, names: Sequence[str]) -> Reals:
        """Bind Real variables."""

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        """The first half of `initialize`: from now on, outputs may be read; the component may refuse to tell them."""

    def exit_initialization(self) -> None:
        """The other half: the state is what the inputs of now make of it."""

    def advance(self, time: float, size: float) -> float:
        """As `step`, but a component may return early, at an event of its own; the time reached [s]."""

    def save(self, state: Any = None) -> Any:
        """A snapshot of the whole state, for `restore`; one that is given is overwritten, and returned."""

    def restore(self, state: Any) -> None:
        """Be again as when the snapshot was taken."""

    def free_state(self, state: Any) -> None:
        """Release a snapshot."""
