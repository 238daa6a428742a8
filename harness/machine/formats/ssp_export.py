"""Export of a machine as an SSP file (.ssp)."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping
from pathlib import Path
from xml.etree.ElementTree import Element

from mechanism_fmu.fmu.disk.archive import write_archive

from ...errors import UsageError
from ...fmu.description import Description, Variable
from ..connection import Connection, linked
from ..file.machine_plan import ComponentPlan, Plan
from ..observers.record import chosen
from ..structure import structure_of
from . import ssp_xml
from .ssp_xml import OMS, OSP, TOOL, TYPES, annotation, child, root, to_bytes, unit_elements, value_element

_FMU = "application/x-fmu-sharedlibrary"


def write_ssp(plan: Plan, fmus: Mapping[str, tuple[Path, Description]], path: Path, *, by_name: bool = False) -> Path:
    """Write a machine as SSP 1.0: SystemStructure.ssd, and FMUs, parameters (.ssv) and input table in resources.

    Args:
        plan: the machine.
        fmus: file and description of each component's FMU, by the component's name.
        path: of the .ssp file.
        by_name: each component has an FMU of its own, which is named after it.

    Raises:
        UsageError: the disk refuses.
    """
    paths = {name: file for name, (file, _) in fmus.items()}
    files = {name: f"resources/{name}.fmu" for name in paths} if by_name else _fmu_names(paths)
    descriptions = {name: description for name, (_, description) in fmus.items()}
    machine = structure_of(descriptions).description
    entries: dict[str, bytes] = {}
    try:
        for name, (file, _) in fmus.items():
            entries[files[name]] = file.read_bytes()
        inputs = None if plan.inputs is None else "resources/inputs.csv"
        if plan.inputs is not None and inputs is not None:
            entries[inputs] = plan.inputs.read_bytes()
        for component in plan.components:
            if component.values:
                entries[_values_name(component)] = to_bytes(
                    _values(plan.title, component, descriptions[component.name])
                )
        entries["SystemStructure.ssd"] = to_bytes(_structure(plan, files, descriptions, machine, inputs))
        write_archive(entries, path)
    except OSError as error:
        raise UsageError(f"'{path}' cannot be written: {error}.") from error
    return path


def _structure(
    plan: Plan,
    files: Mapping[str, str],
    descriptions: Mapping[str, Description],
    machine: Description,
    inputs: str | None,
) -> Element:
    # Tools make names of files and prefixes of variables of these names.
    named = {"name": identifier(plan.title), "description": plan.title}
    structure = root("ssd:SystemStructureDescription", {"version": "1.0", **named, "generationTool": TOOL})
    system = child(structure, "ssd:System", named)
    elements = child(system, "ssd:Elements")
    connectors = _connectors(plan, machine)
    for component in plan.components:
        element = child(
            elements,
            "ssd:Component",
            {"name": component.name, "type": _FMU, "source": files[component.name], "implementation": "CoSimulation"},
        )
        _add_connectors(element, connectors[component.name], descriptions[component.name])
        if component.values:
            binding = child(element, "ssd:ParameterBindings")
            child(binding, "ssd:ParameterBinding", {"source": _values_name(component)})
        ssp_xml.write_component(element, component)
    if plan.connections:
        connections = child(system, "ssd:Connections")
        for connection in plan.connections:
            _add_connection(connections, connection, machine)
    _add_step(system, plan.policy.step)
    units = [v.unit for name, found in connectors.items() for v in _of(found, descriptions[name]) if v.unit]
    unit_elements(structure, "ssd", units, machine)
    experiment = child(structure, "ssd:DefaultExperiment", {"startTime": 0.0, "stopTime": plan.policy.stop_time})
    algorithm = child(annotation(experiment, OSP, "ssd"), "osp:Algorithm")
    child(algorithm, "osp:FixedStepAlgorithm", {"baseStepSize": plan.policy.step})
    ssp_xml.write_machine(structure, plan, inputs)
    return structure


def identifier(title: str) -> str:
    """A title as a C identifier: "Geared cam" is Geared_cam."""
    plain = unicodedata.normalize("NFKD", title).encode("ascii", "ignore").decode()
    plain = re.sub(r"\W+", "_", plain).strip("_") or "machine"
    return f"_{plain}" if plain[0].isdigit() else plain


def _add_step(system: Element, step: float) -> None:
    """The step where OMSimulator looks for it; its tolerances mean nothing to a fixed step."""
    tolerances = {"absoluteTolerance": "1e-4", "relativeTolerance": "1e-4"}
    information = child(child(annotation(system, OMS, "ssd"), "oms:Annotations"), "oms:SimulationInformation")
    child(information, "oms:FixedStepMaster", {"description": "oms-ma", "stepSize": step, **tolerances})


def _connectors(plan: Plan, machine: Description) -> dict[str, list[str]]:
    """For each component the variables that others see: what is connected, and outputs that are recorded.

    Free inputs and parameters are none: fmpy takes every input connector for a connected one.
    """
    for connection in plan.connections:
        if linked(connection, machine).ticks:
            raise UsageError(
                f"connection {connection} is one of clocks, which SSP 1.0 does not know; the machine runs here only."
            )
    wanted = [end for c in plan.connections for end in (c.source, c.target)]
    wanted += [v.name for v in chosen(plan.recording.signals, machine) if v.causality == "output" and v.type in TYPES]
    found: dict[str, list[str]] = {component.name: [] for component in plan.components}
    for name in dict.fromkeys(wanted):
        part, _, variable = name.partition(".")
        found[part].append(variable)
    return found


def _of(names: list[str], description: Description) -> list[Variable]:
    return [description.variables[name] for name in names]


def _add_connectors(element: Element, names: list[str], description: Description) -> None:
    if not names:
        return
    connectors = child(element, "ssd:Connectors")
    for variable in _of(names, description):
        connector = child(connectors, "ssd:Connector", {"name": variable.name, "kind": variable.causality})
        child(connector, f"ssc:{variable.type}", {"unit": variable.unit or None} if variable.type == "Real" else None)


def _add_connection(parent: Element, connection: Connection, machine: Description) -> None:
    """A connection; where units differ, the transformation converts them, because not every tool does."""
    link = linked(connection, machine)
    start, end = connection.source.partition("."), connection.target.partition(".")
    converted = machine.variables[connection.source].unit != machine.variables[connection.target].unit
    converted = converted or (link.factor, link.offset) != (connection.gain, connection.offset)
    element = child(
        parent,
        "ssd:Connection",
        {
            "startElement": start[0],
            "startConnector": start[2],
            "endElement": end[0],
            "endConnector": end[2],
            "suppressUnitConversion": True if converted else None,
        },
    )
    if link.factor != 1.0 or link.offset != 0.0:
        child(element, "ssc:LinearTransformation", {"factor": link.factor, "offset": link.offset})
    ssp_xml.write_connection(element, connection, converted)


def _values_name(component: ComponentPlan) -> str:
    return f"resources/{component.name}.ssv"


def _values(title: str, component: ComponentPlan, description: Description) -> Element:
    """The start values of a component; the sets of all have one name, by which ecos chooses them."""
    values = root("ssv:ParameterSet", {"version": "1.0", "name": identifier(title), "generationTool": TOOL})
    parameters = child(values, "ssv:Parameters")
    for name, value in component.values.items():
        parameter = child(parameters, "ssv:Parameter", {"name": name})
        value_element(parameter, value, description.variables[name])
    units = [description.variables[name].unit for name in component.values]
    unit_elements(values, "ssv", [unit for unit in units if unit], description)
    return values


def _fmu_names(files: Mapping[str, Path]) -> dict[str, str]:
    """Where each component's FMU goes: plain names, the same file only once."""
    names: dict[str, str] = {}
    taken: dict[str, Path] = {}
    for component, file in files.items():
        plain = re.sub(r"[^A-Za-z0-9_.-]+", "_", file.stem)
        name = f"resources/{plain}.fmu"
        if taken.setdefault(name, file) != file:
            name = f"resources/{component}_{plain}.fmu"
            taken[name] = file
        names[component] = name
    return names
