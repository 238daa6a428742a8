"""What SSP has no words for, in annotations: how the machine steps, what is kept, bonds, rates, processes."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element

from ..connection import Connection
from ..extrapolation import Extrapolation
from ..file.plan import BondPlan, ComponentPlan, Plan, Policy, Recording, Scheme
from .xml import OWN, annotated, annotation, child, tag


def write_machine(parent: Element, plan: Plan, inputs: str | None) -> None:
    """How a machine steps, and what is kept; `inputs` is the name of the table of inputs within the .ssp."""
    own = child(annotation(parent, OWN, "ssd"), "own:Machine", {"inputs": inputs, "material": plan.material})
    policy = plan.policy
    run = {"step": policy.step, "algorithm": policy.scheme, "extrapolation": policy.extrapolation}
    child(own, "own:Run", {**run, "tolerance": policy.tolerance})
    record = child(own, "own:Record", {"every": plan.recording.every, "format": plan.recording.format})
    for signal in plan.recording.signals:
        child(record, "own:Signal", {"name": signal})
    for bond in plan.bonds:
        ends = {"flow": bond.flow.target, "effort": bond.effort.target}
        child(own, "own:Bond", {"name": bond.name, **ends, "reaction": True if bond.reaction else None})


def write_component(parent: Element, component: ComponentPlan) -> None:
    """That a component runs in a process of its own."""
    if component.process:
        attributes = {"process": component.process, "time_limit": component.time_limit}
        child(annotation(parent, OWN, "ssd"), "own:Component", attributes)


def write_connection(parent: Element, connection: Connection, converted: bool) -> None:
    """The rate of a connection, whether it converts; gain and offset if the transformation `converted` units, too."""
    numbers = {"gain": connection.gain, "offset": connection.offset} if converted else {}
    if connection.rate or connection.convert or converted:
        attributes = {"rate": connection.rate or None, "convert": connection.convert or None, **numbers}
        child(annotation(parent, OWN, "ssd"), "own:Connection", attributes)


def read_component(element: Element) -> tuple[bool | None, float | None]:
    """Whether a component runs in a process of its own, and its time limit.

    That it shall not is for the user to say, and not for a file that others have made.
    """
    own = annotated(element, OWN, "own:Component")
    if own is None or own.get("process") != "true":
        return None, None
    limit = own.get("time_limit")
    return True, None if limit is None else float(limit)


def read_connection(element: Element) -> tuple[str, float | None, float | None, bool]:
    """Rate, gain and offset of a connection, None for those that the transformation has; whether it converts."""
    own = annotated(element, OWN, "own:Connection")
    if own is None:
        return "", None, None, False
    gain, offset = (None if number is None else float(number) for number in (own.get("gain"), own.get("offset")))
    return own.get("rate", ""), gain, offset, own.get("convert") == "true"


def machine_element(root: Element) -> Element | None:
    """What `write_machine` wrote; None in a file of another tool."""
    return annotated(root, OWN, "own:Machine")


def read_policy(own: Element, stop_time: float) -> Policy:
    """How a machine steps.

    Raises:
        KeyError, ValueError: somebody has changed what we wrote.
    """
    run = own.find(tag("own:Run"))
    if run is None:
        raise KeyError("own:Run")
    tolerance = run.get("tolerance")
    return Policy(
        stop_time,
        float(run.attrib["step"]),
        Scheme(run.attrib["algorithm"]),
        Extrapolation(run.attrib["extrapolation"]),
        None if tolerance is None else float(tolerance),
    )


def read_recording(own: Element) -> Recording:
    """What is kept.

    Raises:
        KeyError, ValueError: somebody has changed what we wrote.
    """
    record = own.find(tag("own:Record"))
    if record is None:
        raise KeyError("own:Record")
    signals = tuple(signal.attrib["name"] for signal in record.findall(tag("own:Signal")))
    return Recording(signals, int(record.attrib["every"]), record.attrib["format"])


def read_bonds(own: Element, connections: Sequence[Connection]) -> tuple[BondPlan, ...]:
    """Power bonds whose connections are still there."""
    by_target = {connection.target: connection for connection in connections}
    found = []
    for bond in own.findall(tag("own:Bond")):
        flow, effort = by_target.get(bond.attrib["flow"]), by_target.get(bond.attrib["effort"])
        if flow is not None and effort is not None:
            found.append(BondPlan(bond.attrib["name"], flow, effort, bond.get("reaction") == "true"))
    return tuple(found)
