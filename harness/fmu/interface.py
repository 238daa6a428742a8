"""Co-simulation interface (slave) as the harness uses it: the smallest of interfaces, so that a test can fake it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, MutableSequence, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, Protocol

from ..errors import LogMessage
from .description import Description, Value


class Observable(Protocol):
    """What an observer sees of a unit: it can be read, and nothing else."""

    @property
    def description(self) -> Description:
        """What the unit says about itself."""

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables, in the order of `names`.

        Args:
            names: of variables.
        """


def whole_step(advance: Callable[[float, float], float], time: float, size: float) -> None:
    """Take a step of `size` [s] from `time` by `advance`, which returns the time reached: it may return early."""
    end = time + size
    reached = advance(time, size)
    while reached < end:
        reached = advance(reached, end - reached)


class Slave(Observable, Protocol):
    """One instance of a co-simulation unit, as a master sees it.

    The calls come in this order, and `get` at any time:

    1. `set`: start values of parameters and inputs
    2. `initialize`
    3. as often as there are steps: `set` (inputs), then `step`
    4. `terminate`

    Every method raises `FmuError` when the unit refuses or fails; the master then calls nothing more.
    """

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name.

        Args:
            values: by name, each in the unit of its variable.
        """

    def initialize(self, start_time: float, stop_time: float) -> None:
        """Fix the parameters and find a consistent state at `start_time` [s]; no step will end behind `stop_time`.

        Args:
            start_time: of the run [s].
            stop_time: of the run [s].
        """

    def step(self, time: float, size: float) -> None:
        """Advance by `size` [s] from `time`, where the last step ended; a step that is not completed is an error.

        Args:
            time: where the step begins [s].
            size: of the step [s], > 0.
        """

    def terminate(self) -> None:
        """End the simulation run."""


class Instance(Slave, Protocol):
    """An instance of an FMU, here or in a process of its own."""

    @property
    def messages(self) -> list[LogMessage]:
        """Everything it has said so far."""

    def reset(self) -> None:
        """Be as just after the instantiation."""

    def save(self, state: Any = None) -> Any:
        """A snapshot of the whole state, in the place of one that is given; give it back with `free_state`.

        Args:
            state: a snapshot that is overwritten, or None for a new one.
        """

    def restore(self, state: Any) -> None:
        """Continue from a snapshot.

        Args:
            state: that `save` gave.
        """

    def free_state(self, state: Any) -> None:
        """Release a snapshot.

        Args:
            state: that `save` gave.
        """

    def serialize(self, state: Any) -> bytes:
        """A snapshot as bytes.

        Args:
            state: that `save` gave.
        """

    def deserialize(self, data: bytes) -> Any:
        """A snapshot from bytes.

        Args:
            data: that `serialize` gave.
        """


class Instances(Protocol):
    """An extracted FMU, of which instances can be made."""

    @property
    def path(self) -> Path:
        """The file it came from."""

    @property
    def description(self) -> Description:
        """What it says about itself."""

    @property
    def folder(self) -> Path:
        """Where it is extracted."""

    def instantiate(
        self, name: str, on_message: Callable[[LogMessage], None] = ...
    ) -> AbstractContextManager[Instance]:
        """A new instance; it is freed afterwards. `on_message` receives its messages.

        Args:
            name: of the instance.
            on_message: called with each message of the FMU.
        """


# What a component is to a machine: a `Slave` whose numbers are bound once, and which may be put back.


class Reals(Protocol):
    """Some Real variables of a component, bound once, so that a step costs little."""

    @property
    def values(self) -> MutableSequence[float]:
        """In the order in which they were bound: what `read` found and `write` takes."""

    def read(self) -> None:
        """Fill `values` with those of now."""

    def read_slopes(self) -> bool:
        """Fill `values` with derivatives of outputs [unit/s]; of components with `Description.gives_slopes` only.

        False where the component does not return some of them (fmi2Discard): then `values` mean nothing.
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
        """Bind Real variables.

        Args:
            names: of Real variables of the component.
        """

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        """The first half of `initialize`: from now on, outputs may be read; the component may refuse to return them.

        Args:
            start_time: of the run [s].
            stop_time: of the run [s].
        """

    def exit_initialization(self) -> None:
        """The other half: the state is what the inputs of now make of it."""

    def advance(self, time: float, size: float) -> float:
        """As `step`, but a component may return early, at an event of its own; the time reached [s].

        Args:
            time: where the step begins [s].
            size: of the step [s], > 0.
        """

    def save(self, state: Any = None) -> Any:
        """A snapshot of the whole state, for `restore`; one that is given is overwritten, and returned.

        Args:
            state: a snapshot that is overwritten, or None for a new one.
        """

    def restore(self, state: Any) -> None:
        """Be again as when the snapshot was taken.

        Args:
            state: that `save` gave.
        """

    def free_state(self, state: Any) -> None:
        """Release a snapshot.

        Args:
            state: that `save` gave.
        """
