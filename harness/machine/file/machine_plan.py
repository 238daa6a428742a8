"""Contents of a machine's file, and what a command changes in it for one run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property
from importlib.util import find_spec
from pathlib import Path

from mechanism_fmu.fmu.disk.user_cache import was_built_here

from ...errors import UsageError
from ...fmu.description import Description, Value, Variable
from ...fmu.instances.integration import Integrator
from ...fmu.values import parse_value
from ...run.experiment import start_values
from ...run.master import TimeGrid
from ..connection import Connection
from ..part import Extrapolation


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
        integrator: for its interface for Model Exchange; None: co-simulation, if it has that.
    """

    path: Path | None = None
    model: str = ""
    flavour: str = "native"
    fmi: int = 2
    integrator: Integrator | None = None


@dataclass(frozen=True)
class ComponentPlan:
    """One component.

    Attributes:
        name: in the machine.
        source: of its FMU.
        process: whether it runs in a process of its own; None: the file does not say.
        time_limit: for each of its calls, in a process of its own [s]; None: the file does not say.
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


def usual_format() -> str:
    """What is written where nothing is said: Parquet; CSV where pyarrow, of the extra `designs`, is not installed."""
    return "parquet" if find_spec("pyarrow") is not None else "csv"


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
    format: str = field(default_factory=usual_format)


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
        inputs: table of signals for free inputs (`harness/run/inputs.py`); None: there is none.
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


# What a command changes in a machine's file for one run.

#: What other tools do: fixed steps, all components at once, inputs held, each output read once.
AS_OTHERS = Policy(1.0, 1.0, Scheme.JACOBI, Extrapolation.CONSTANT, reads_once=True)


@dataclass(frozen=True)
class Changes:
    """As the user wrote them.

    Attributes:
        step: with its unit, or in seconds; None: that of the file.
        settings: "<component>.<variable>=<value>", with a unit if need be.
        as_others: whether to step as other tools do.
    """

    step: str | None = None
    settings: Sequence[str] = ()
    as_others: bool = False


#: The machine as its file says.
NO_CHANGES = Changes()


def changed(plan: Plan, changes: Changes, description: Description, fixed: Sequence[str] = ()) -> Plan:
    """The plan with the changes.

    Args:
        plan: of the file.
        changes: of the command.
        description: of the machine, connected.
        fixed: names of components that must take steps of one size.

    Raises:
        UsageError: a change that cannot be; the message says why.
    """
    policy = plan.policy
    if changes.step is not None:
        policy = replace(policy, step=_step(changes.step, policy.stop_time, fixed))
    if changes.as_others:
        policy = replace(AS_OTHERS, stop_time=policy.stop_time, step=policy.step)
    values = start_values(changes.settings, _without_connected(plan, changes, description))
    components = tuple(
        replace(
            component,
            values={
                **component.values,
                **{n.partition(".")[2]: v for n, v in values.items() if n.startswith(f"{component.name}.")},
            },
        )
        for component in plan.components
    )
    return replace(plan, policy=policy, components=components)


def _step(text: str, stop_time: float, fixed: Sequence[str]) -> float:
    variable = Variable("--step", -1, "Real", "parameter", unit="s", minimum=0.0)
    step = float(parse_value(text, variable, Description("the machine", "", "", {})))
    if not TimeGrid.of(stop_time, step).even and fixed:
        raise UsageError(
            f"--step {text}: the last step to {stop_time:g} s would be shorter, which {', '.join(fixed)} cannot take "
            "(canHandleVariableCommunicationStepSize); give one of which the stop time is a multiple."
        )
    return step


def _without_connected(plan: Plan, changes: Changes, description: Description) -> Description:
    """The machine's description, once nothing is set that follows something."""
    for setting in changes.settings:
        name = setting.partition("=")[0].strip()
        if name in plan.sources:
            raise UsageError(f"'{name}' follows {plan.sources[name]}, by a connection; it cannot be set as well.")
    return description
