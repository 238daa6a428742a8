"""What the file of a machine says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from pathlib import Path

from mechanism_fmu.fmu.built import was_built_here

from ...description import Value
from ..connection import Connection
from ..extrapolation import Extrapolation


class Scheme(StrEnum):
    """Algorithms by name (`harness/machine/algorithms`)."""

    JACOBI = "jacobi"
    GAUSS_SEIDEL = "gauss_seidel"
    EVENT_AWARE = "event_aware"
    ADAPTIVE = "adaptive"


@dataclass(frozen=True)
class Source:
    """Where a component's FMU comes from: a file, or (path is None) a model that is built.

    Attributes:
        path: of the FMU.
        model: name of a ready-made model, or file of an own one.
        flavour: of a model, "native" or "pythonfmu".
        fmi: of a model, version of the standard.
    """

    path: Path | None = None
    model: str = ""
    flavour: str = "native"
    fmi: int = 2


@dataclass(frozen=True)
class ComponentPlan:
    """One component.

    Attributes:
        name: in the machine.
        source: of its FMU.
        process: whether it runs in a process of its own; None: nobody has said.
        time_limit: for each of its calls, in a process of its own [s]; None: nobody has said.
        values: start values of its parameters and free inputs, in their units.
    """

    name: str
    source: Source
    process: bool | None = None
    time_limit: float | None = None
    values: Mapping[str, Value] = field(default_factory=dict)

    @cached_property
    def foreign(self) -> bool:
        """Whether no build of this user has made its FMU."""
        return self.source.path is not None and not was_built_here(self.source.path)

    @property
    def apart(self) -> bool:
        """Whether it runs in a process of its own (docs/decisions/028-whose-fmu-runs-where.md)."""
        return self.foreign if self.process is None else self.process


@dataclass(frozen=True)
class BondPlan:
    """A power bond whose energy is watched.

    Attributes:
        name: for people.
        flow: a speed, from the driving component to the driven one.
        effort: a torque or force, back.
        reaction: whether its output is what acts on the driving component (`bonds.Bond`).
    """

    name: str
    flow: Connection
    effort: Connection
    reaction: bool = False


@dataclass(frozen=True)
class Policy:
    """How a machine steps.

    Attributes:
        stop_time: of the run [s].
        step: from one communication point to the next; the largest one of adaptive steps [s].
        scheme: algorithm.
        extrapolation: of inputs between communication points.
        tolerance: of adaptive steps; None for others.
        reads_once: outputs are read once at a communication point (`Machine.reads_once`); no key of the file says so.
    """

    stop_time: float
    step: float
    scheme: Scheme = Scheme.EVENT_AWARE
    extrapolation: Extrapolation = Extrapolation.DERIVATIVES
    tolerance: float | None = None
    reads_once: bool = False


@dataclass(frozen=True)
class Recording:
    """What is kept of a run.

    Attributes:
        signals: names of variables, with * for any part of a name.
        every: so many steps make one row.
        format: of the file, "parquet" or "csv".
    """

    signals: tuple[str, ...] = ("*",)
    every: int = 1
    format: str = "parquet"


@dataclass(frozen=True)
class Plan:
    """A machine and its run.

    Attributes:
        title: for people.
        components: in the order of the file.
        connections: in the order of the file.
        bonds: in the order of the file.
        policy: how it steps.
        recording: what is kept.
        inputs: table of signals for free inputs (`harness/inputs.py`); None: there is none.
        material: of the beams that impacts strike.
    """

    title: str
    components: tuple[ComponentPlan, ...]
    connections: tuple[Connection, ...]
    bonds: tuple[BondPlan, ...]
    policy: Policy
    recording: Recording = Recording()
    inputs: Path | None = None
    material: str = "steel"

    @property
    def sources(self) -> dict[str, str]:
        """By connected input, the output that it follows."""
        return {connection.target: connection.source for connection in self.connections}

    @property
    def start_values(self) -> dict[str, Value]:
        """Start values by the names that variables have in the machine."""
        return {f"{part.name}.{name}": value for part in self.components for name, value in part.values.items()}
