"""Notes on a machine that are no mistakes: cycles, algebraic loops, free inputs, missing units, held signals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...fmu.description import Description, Variable
from ...fmu.values import shown
from ..connection import Connection, own_of, part_of
from ..observers.bonds import Bond, pushes
from ..part import Extrapolation
from ..structure import structure_of
from .machine_plan import BondPlan, Plan, Scheme


def notes(plan: Plan, descriptions: Mapping[str, Description], driven: Sequence[str] = ()) -> list[str]:
    """Sentences for the user.

    Args:
        plan: the machine.
        descriptions: of its components' FMUs.
        driven: inputs that the table of inputs drives.
    """
    machine = structure_of(descriptions, plan.connections)
    found = [
        f"{', '.join(cycle)} follow each other: a cycle. A fixed step shows what one of them does to the others "
        "only in the next step."
        if len(cycle) > 1
        else f"{cycle[0]} follows itself."
        for cycle in machine.cycles
    ]
    found += [
        f"{', '.join(loop)} follow each other at once, as far as the FMUs declare: a loop without any delay. It is "
        "gone round a few times at each communication point, and not solved."
        for loop in machine.loops
    ]
    found += _free_inputs(plan, machine.description, driven)
    found += _without_units(plan.connections, machine.description)
    flowing = {link.target for link in machine.links if not link.held}
    connections = [connection for connection in plan.connections if connection.target in flowing]
    found += _extrapolation(plan.policy.extrapolation, connections, descriptions)
    held = [f"{link.source} -> {link.target}" for link in machine.links if link.held and not link.ticks]
    if held:
        found.append(
            f"Held, and never interpolated or extrapolated: {', '.join(held)}. A change takes effect at the first "
            "communication point at which it is seen, with every algorithm; until there its receiver has the old value."
        )
    ticking = [f"{link.source} -> {link.target}" for link in machine.links if link.ticks]
    if ticking:
        found.append(
            f"By clocks: {', '.join(ticking)}. They are passed on in event mode, at the first communication point "
            "behind an event; with event_aware that is the event itself, where an FMU can end its step there."
        )
    if plan.policy.reads_once:
        found.append(
            "Stepped as the masters of other tools do (--as-others): fixed steps, all components at once, inputs held, "
            "each output read once at a communication point."
        )
    found += [_pushed(bond) for bond in plan.bonds if pushes(Bond(bond.flow, bond.effort, bond.reaction))]
    found += _apart(plan)
    stiff = [name for name, description in descriptions.items() if not description.saves_state]
    if plan.policy.scheme is Scheme.EVENT_AWARE and stiff:
        found.append(
            f"{', '.join(stiff)} cannot be put back (canGetAndSetFMUstate): impacts there are felt by the others only "
            "at the end of the step."
        )
    return found


def _apart(plan: Plan) -> list[str]:
    others = [part.name for part in plan.components if part.process is None and part.apart]
    if not others:
        return []
    return [
        f"In a process of its own, as no build of yours has made its FMU: {', '.join(others)}. process = false below "
        "[component.NAME], or --in-process, runs it here, faster by a round trip a step."
    ]


def _without_units(connections: Sequence[Connection], machine: Description) -> list[str]:
    guessed: dict[str, str] = {}
    for connection in connections:
        source, target = machine.variables[connection.source], machine.variables[connection.target]
        if source.type == target.type == "Real" and bool(source.unit) is not bool(target.unit):
            bare, other = (target, source) if source.unit else (source, target)
            guessed[bare.name] = f"{bare.name} ({other.unit}, as {other.name})"
        rate = machine.variables.get(connection.rate)
        if rate is not None and source.unit and not rate.unit:
            guessed[rate.name] = f"{rate.name} ({source.unit}/s)"
    names = ", ".join(guessed.values())
    return [f"No unit is known of {names}: that of what it goes with was taken."] if guessed else []


def _pushed(bond: BondPlan) -> str:
    effort = bond.effort
    driving, driven = part_of(effort.target), part_of(effort.source)
    meaning = f"the reaction on {driving} (reaction = true)" if bond.reaction else f"the torque or force on {driven}"
    also = "" if bond.reaction else " An output that is the reaction itself needs reaction = true below [[bond]]."
    return (
        f"Bond '{bond.name}': {effort.target} follows {effort.source} with gain = {effort.gain:g}, so {driving} is "
        f"pushed on by what it drives, if that output is {meaning}. Perhaps the gain should be {-effort.gain:g}.{also}"
    )


def _free_inputs(plan: Plan, machine: Description, driven: Sequence[str]) -> list[str]:
    known = {*driven, *plan.start_values}
    free: dict[str, list[Variable]] = {}
    for variable in machine.of("input"):
        if variable.name not in known:
            free.setdefault(part_of(variable.name), []).append(variable)
    return [
        f"Inputs of {part} that follow nobody and are not set keep their start values: "
        f"{', '.join(_kept(variable, machine) for variable in variables)}."
        for part, variables in free.items()
    ]


def _kept(variable: Variable, machine: Description) -> str:
    name = own_of(variable.name)
    if variable.start is None:
        return name
    if variable.type != "Real":
        return f"{name} = {variable.start}"
    return f"{name} = {shown(float(variable.start), variable.name, machine)}"


def _extrapolation(
    kind: Extrapolation, connections: Sequence[Connection], descriptions: Mapping[str, Description]
) -> list[str]:
    if kind is Extrapolation.CONSTANT:
        return []
    targets = {part_of(connection.target) for connection in connections}
    held = [name for name, description in descriptions.items() if name in targets and not description.takes_slopes]
    found = []
    if held:
        found.append(
            f"{', '.join(held)} takes no slopes of inputs (canInterpolateInputs): its inputs are held during a step, "
            "at what they would be in its middle."
        )
    unknown = [c.source for c in connections if _has_no_slope(c, descriptions)]
    if kind is Extrapolation.DERIVATIVES and unknown:
        found.append(
            f"No derivative is known of {', '.join(dict.fromkeys(unknown))}: what follows goes on as in the step "
            'before (extrapolation = "linear"), unless the connection names a rate.'
        )
    return found


def _has_no_slope(connection: Connection, descriptions: Mapping[str, Description]) -> bool:
    return not connection.rate and not descriptions[part_of(connection.source)].gives_slopes
