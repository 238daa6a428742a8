"""XML of SSP 1.0: namespaces, prefixes that libcosim expects letter for letter, numbers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from mechanism_fmu import __version__

from ...description import Description, Value, Variable
from ...si import BASE_UNITS, parse_unit

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


def annotation(parent: Element, kind: str, room: str) -> Element:
    """A new annotation of a kind among those of an element, `room` being the prefix of their list."""
    found = parent.find(tag(f"{room}:Annotations"))
    found = child(parent, f"{room}:Annotations") if found is None else found
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


def unit_elements(parent: Element, room: str, names: Iterable[str], description: Description) -> None:
    """The units with these names."""
    meanings = {name: description.units.defined.get(name) or parse_unit(name) for name in dict.fromkeys(names)}
    known = {name: meaning for name, meaning in meanings.items() if meaning is not None}
    if not known:
        return
    units = child(parent, f"{room}:Units")
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
