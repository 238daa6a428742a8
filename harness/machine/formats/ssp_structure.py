"""System structure description of an SSP file: components, connectors and connections, as they are written."""

from __future__ import annotations

import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from os.path import isfile
from pathlib import Path
from urllib.parse import unquote
from xml.etree.ElementTree import Element

from mechanism_fmu.fmu.disk.archive import read_entries

from ...errors import UsageError
from .ssp_xml import OSP, OWN, TYPES, annotated, from_bytes, read_component, read_connection, tag

_STRUCTURE = "SystemStructure.ssd"


@dataclass(frozen=True)
class Parameter:
    """A start value: its type, its text, and its unit ("" for that of the variable)."""

    type: str
    text: str
    unit: str = ""


@dataclass
class SspComponent:
    """A component.

    Attributes:
        name: of it.
        source: name of its FMU within the file.
        parameters: start values.
        process, time_limit: of our own annotation.
    """

    name: str
    source: str
    parameters: dict[str, Parameter] = field(default_factory=dict)
    process: bool | None = None
    time_limit: float | None = None


@dataclass(frozen=True)
class SspConnection:
    """A connection: target = factor * source + offset.

    Attributes:
        source, target: "<component>.<connector>".
        factor, offset: of the transformation.
        converts: whether units are still to be converted, before the transformation.
        rate, gain, own_offset, convert: of our own annotation.
    """

    source: str
    target: str
    factor: float
    offset: float
    converts: bool
    rate: str = ""
    gain: float | None = None
    own_offset: float | None = None
    convert: bool = False


@dataclass
class Structure:
    """A system.

    Attributes:
        entries: contents of the file, by name.
        root: of its description.
        title: of it.
        components: by name.
        connections: between components.
        stop_time, step: of its default experiment [s]; None when it has none.
        left_out: what it has and this project does not, in sentences.
    """

    entries: Mapping[str, bytes]
    root: Element
    title: str
    components: dict[str, SspComponent] = field(default_factory=dict)
    connections: list[SspConnection] = field(default_factory=list)
    stop_time: float | None = None
    step: float | None = None
    left_out: list[str] = field(default_factory=list)


def read_structure(path: Path) -> Structure:
    """Read an .ssp file.

    Raises:
        UsageError: it is none, or has what cannot be taken over.
    """
    if not isfile(path):
        raise UsageError(f"There is no file '{path}'.")
    try:
        entries = read_entries(path)
        root = from_bytes(entries[_STRUCTURE])
    except KeyError:
        raise UsageError(f"'{path}' is no SSP file: it has no {_STRUCTURE}.") from None
    except (OSError, zipfile.BadZipFile, ValueError) as error:
        raise UsageError(f"'{path}' cannot be read as an SSP file: {error}.") from error
    system = root.find(tag("ssd:System"))
    if root.tag != tag("ssd:SystemStructureDescription") or system is None:
        raise UsageError(f"'{path}' is no SSP 1.0 file: {_STRUCTURE} has no ssd:System.")
    # Our own files have the title there; in others it may be a text of any length.
    title = root.get("description") if annotated(root, OWN, "own:Machine") is not None else None
    structure = Structure(entries, root, title or root.get("name") or system.get("name") or path.stem)
    _read_elements(structure, system, path)
    for element in system.iterfind(f"{tag('ssd:Connections')}/{tag('ssd:Connection')}"):
        _read_connection(structure, element, path)
    _read_bindings(structure, system, "")
    _read_experiment(structure)
    return structure


def _read_elements(structure: Structure, system: Element, path: Path) -> None:
    for element in system.find(tag("ssd:Elements")) or ():
        name = element.get("name", "")
        if element.tag == tag("ssd:System"):
            raise UsageError(f"'{path}': '{name}' is a system within the system; only flat ones can be imported.")
        source = unquote(element.get("source", ""))
        if element.tag != tag("ssd:Component") or not source.endswith(".fmu"):
            structure.left_out.append(f"'{name}' is no FMU and was left out.")
            continue
        if source not in structure.entries:
            raise UsageError(f"'{path}': the FMU '{source}' of '{name}' is not in the file.")
        process, limit = read_component(element)
        structure.components[name] = SspComponent(name, source, process=process, time_limit=limit)
        _read_bindings(structure, element, name)
    if not structure.components:
        raise UsageError(f"'{path}' has no component that is an FMU.")


def _read_connection(structure: Structure, element: Element, path: Path) -> None:
    parts = element.get("startElement", ""), element.get("endElement", "")
    names = element.get("startConnector", ""), element.get("endConnector", "")
    source, target = (f"{part}.{name}" for part, name in zip(parts, names, strict=True))
    if not all(part in structure.components for part in parts):
        structure.left_out.append(f"The connection from '{source}' to '{target}' leaves the system and was left out.")
        return
    if any(_has_mapping(element, kind) for kind in ("Boolean", "Integer", "Enumeration")):
        raise UsageError(f"'{path}': the connection from '{source}' to '{target}' maps values one by one.")
    linear = element.find(tag("ssc:LinearTransformation"))
    given = {} if linear is None else linear.attrib
    rate, gain, offset, convert = read_connection(element)
    structure.connections.append(
        SspConnection(
            source,
            target,
            float(given.get("factor", 1.0)),
            float(given.get("offset", 0.0)),
            element.get("suppressUnitConversion", "false") not in ("true", "1"),
            rate,
            gain,
            offset,
            convert,
        )
    )


def _has_mapping(element: Element, kind: str) -> bool:
    return element.find(tag(f"ssc:{kind}MappingTransformation")) is not None


def _read_bindings(structure: Structure, element: Element, component: str) -> None:
    """The parameters bound to a component, or ("") to the system, where they have the component's name before them."""
    for binding in element.iterfind(f"{tag('ssd:ParameterBindings')}/{tag('ssd:ParameterBinding')}"):
        if binding.find(tag("ssd:ParameterMapping")) is not None:
            structure.left_out.append(f"A parameter mapping of '{component or 'the system'}' was left out.")
        for name, parameter in _parameters(structure, binding, component):
            full = binding.get("prefix", "") + name
            part, own = (component, full) if component else (full.partition(".")[0], full.partition(".")[2])
            if part in structure.components and own:
                structure.components[part].parameters[own] = parameter
            else:
                structure.left_out.append(f"The parameter '{full}' belongs to no component and was left out.")


def _parameters(structure: Structure, binding: Element, component: str) -> Iterator[tuple[str, Parameter]]:
    source = binding.get("source")
    sets: list[Element] = []
    if source is None:
        sets += binding.iterfind(f"{tag('ssd:ParameterValues')}/{tag('ssv:ParameterSet')}")
    elif source in structure.entries:
        try:
            sets.append(from_bytes(structure.entries[source]))
        except ValueError as error:
            raise ValueError(f"its parameters '{source}' cannot be read: {error}") from error
    else:
        structure.left_out.append(f"The parameters '{source}' of '{component or 'the system'}' are not in the file.")
    for parameters in sets:
        for parameter in parameters.iterfind(f"{tag('ssv:Parameters')}/{tag('ssv:Parameter')}"):
            name = parameter.get("name", "")
            for kind in TYPES:
                value = parameter.find(tag(f"ssv:{kind}"))
                if value is not None:
                    yield name, Parameter(kind, value.get("value", ""), value.get("unit", ""))
                    break
            else:
                structure.left_out.append(f"The parameter '{name}' is of a type that is not known, and was left out.")


def _read_experiment(structure: Structure) -> None:
    experiment = structure.root.find(tag("ssd:DefaultExperiment"))
    if experiment is None:
        return
    stop = experiment.get("stopTime")
    structure.stop_time = None if stop is None else float(stop)
    algorithm = annotated(experiment, OSP, "osp:Algorithm")
    step = None if algorithm is None else algorithm.find(tag("osp:FixedStepAlgorithm"))
    structure.step = None if step is None else float(step.attrib["baseStepSize"])
