"""XML of SSP 1.0, and what SSP has no words for, in annotations."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from mechanism_fmu import __version__

from ...fmu.description import Description, Value, Variable
from ...fmu.units import BASE_UNITS, parse_unit
from ..connection import Connection
from ..file.machine_plan import BondPlan, ComponentPlan, Plan, Policy, Recording, Scheme
from ..part import Extrapolation

# XML of SSP 1.0: namespaces, prefixes that libcosim expects letter for letter, numbers.

_NAMESPACES = {
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    "osp": "http://opensimulationplatform.com/SSP/OSPAnnotations",
    "oms": "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd",
    "own": "urn:mechanism-fmu:machine",
}
for _prefix, _address in _NAMESPACES.items():
    ElementTree.register_namespace(_prefix, _address)

#: Of the annotations of the Open Simulation Platform, of OMSimulator, and of our own.
OSP, OMS, OWN = "com.opensimulationplatform", "org.openmodelica", "mechanism_fmu"

#: What FMI and SSP call the types alike.
TYPES = ("Real", "Integer", "Boolean", "String")

TOOL = f"mechanism_fmu {__version__}"


def tag(name: str) -> str:
    """A name with its prefix, "ssd:System", as ElementTree has it."""
    prefix, _, local = name.partition(":")
    return f"{{{_NAMESPACES[prefix]}}}{local}"


def child(parent: Element, name: str, attributes: Mapping[str, object] | None = None) -> Element:
    """A new element in another one; attributes that are None are left out."""
    given = {key: text(value) for key, value in (attributes or {}).items() if value is not None}
    return SubElement(parent, tag(name), given)


def root(name: str, attributes: Mapping[str, str]) -> Element:
    """A new outermost element."""
    return Element(tag(name), dict(attributes))


def annotation(parent: Element, kind: str, prefix: str) -> Element:
    """A new annotation of a kind among those of an element, `prefix` being that of their list."""
    found = parent.find(tag(f"{prefix}:Annotations"))
    found = child(parent, f"{prefix}:Annotations") if found is None else found
    return child(found, "ssc:Annotation", {"type": kind})


def annotated(parent: Element, kind: str, name: str) -> Element | None:
    """The element `name` in an annotation of a kind; None when there is none."""
    for found in parent.findall(f"{tag('ssd:Annotations')}/{tag('ssc:Annotation')}"):
        if found.get("type") == kind:
            return found.find(tag(name))
    return None


def text(value: object) -> str:
    """A value as XML Schema writes it; a number is the shortest text that reads back as the same."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(float(value)) if isinstance(value, float) else str(value)


def value_element(parent: Element, value: Value, variable: Variable) -> None:
    """The value of a parameter, with its unit."""
    kind = variable.type
    value = float(value) if kind == "Real" else value
    child(parent, f"ssv:{kind}", {"value": value, "unit": variable.unit or None})


def unit_elements(parent: Element, prefix: str, names: Iterable[str], description: Description) -> None:
    """The units with these names."""
    meanings = {name: description.units.defined.get(name) or parse_unit(name) for name in dict.fromkeys(names)}
    known = {name: meaning for name, meaning in meanings.items() if meaning is not None}
    if not known:
        return
    units = child(parent, f"{prefix}:Units")
    for name, meaning in known.items():
        unit = child(units, "ssc:Unit", {"name": name})
        exponents = {base: n for base, n in zip(BASE_UNITS, meaning.exponents, strict=True) if n}
        scale = {"factor": meaning.factor if meaning.factor != 1.0 else None}
        shift = {"offset": meaning.offset if meaning.offset != 0.0 else None}
        child(unit, "ssc:BaseUnit", {**exponents, **scale, **shift})


def from_bytes(file: bytes) -> Element:
    """The root of a file.

    Raises:
        ValueError: it is no XML, or in an encoding that nobody knows.
    """
    try:
        return ElementTree.fromstring(file)
    except (ElementTree.ParseError, LookupError) as error:
        raise ValueError(str(error)) from error


def to_bytes(element: Element) -> bytes:
    """A whole file."""
    ElementTree.indent(element)
    data: bytes = ElementTree.tostring(element, encoding="UTF-8", xml_declaration=True)
    return data + b"\n"


# What SSP has no words for, in annotations: how the machine steps, what is kept, bonds, rates, processes.


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
