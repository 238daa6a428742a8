"""What a command changes in a machine's file for one run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ...assignments import parse_value, start_values
from ...clock import TimeGrid
from ...description import Description, Variable
from ...errors import UsageError
from ..extrapolation import Extrapolation
from .plan import Plan, Policy, Scheme

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
