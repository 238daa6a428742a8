"""modelDescription.xml of a container: a machine as one FMU of FMI 2.0."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from xml.etree.ElementTree import Element, SubElement

from mechanism_fmu import __version__

from ...fmu.description import Description, Variable
from ...fmu.units import BASE_UNITS, parse_unit
from ..file.machine_plan import Plan

_INITIAL = {"output": "calculated", "parameter": "exact"}


@dataclass(frozen=True)
class Exposed:
    """A variable of the container.

    Attributes:
        variable: by its name in the machine, with its start value in the container.
        component: number of the component that has it.
        reference: its value reference there.
    """

    variable: Variable
    component: int
    reference: int


def container_description(
    identifier: str, token: str, plan: Plan, exposed: Sequence[Exposed], machine: Description
) -> Element:
    """The description of a machine as one FMU.

    Value references are places among the exposed variables, from 1: fmpy's container takes 0 for the time.
    """
    root = Element("fmiModelDescription", fmiVersion="2.0", modelName=identifier, guid=token)
    root.set("description", plan.title)
    root.set("generationTool", f"mechanism_fmu {__version__}, container by fmpy")
    root.set("variableNamingConvention", "structured")
    # fmpy's container takes multiples of its own step only, which FMI 2.0 has no word for.
    SubElement(root, "CoSimulation", modelIdentifier="container_fmu", canHandleVariableCommunicationStepSize="false")
    variables = [each.variable for each in exposed]
    _units(root, (variable.unit for variable in variables), machine)
    times = SubElement(root, "DefaultExperiment", startTime="0", stopTime=repr(plan.policy.stop_time))
    times.set("stepSize", repr(plan.policy.step))
    elements = SubElement(root, "ModelVariables")
    for place, variable in enumerate(variables, start=1):
        _variable(elements, variable, place)
    structure = SubElement(root, "ModelStructure")
    found = [str(place) for place, variable in enumerate(variables, start=1) if variable.causality == "output"]
    if found:
        outputs, unknowns = SubElement(structure, "Outputs"), SubElement(structure, "InitialUnknowns")
        for index in found:
            SubElement(outputs, "Unknown", index=index)
            SubElement(unknowns, "Unknown", index=index)
    return root


def _variable(parent: Element, variable: Variable, place: int) -> None:
    element = SubElement(parent, "ScalarVariable", name=variable.name, valueReference=str(place))
    if variable.description:
        element.set("description", variable.description)
    varies = "continuous" if variable.type == "Real" else "discrete"
    fixed = variable.causality == "parameter"
    element.attrib.update(causality=variable.causality, variability="fixed" if fixed else varies)
    if variable.causality in _INITIAL:
        element.set("initial", _INITIAL[variable.causality])
    kind = SubElement(element, variable.type)
    if variable.type == "Real" and variable.unit:
        kind.set("unit", variable.unit)
    if variable.display_unit:
        kind.set("displayUnit", variable.display_unit)
    for name, limit in (("min", variable.minimum), ("max", variable.maximum)):
        if limit is not None:
            kind.set(name, repr(limit) if variable.type == "Real" else f"{limit:.0f}")
    if variable.type == "Real" and variable.nominal != 1.0:
        kind.set("nominal", repr(variable.nominal))
    if variable.start is not None:
        kind.set("start", variable.start)


def _units(root: Element, names: Iterable[str], machine: Description) -> None:
    """The definitions of the units that are used."""
    used = [name for name in dict.fromkeys(names) if name]
    if not used:
        return
    definitions = SubElement(root, "UnitDefinitions")
    for name in used:
        unit = SubElement(definitions, "Unit", name=name)
        meaning = machine.units.defined.get(name) or parse_unit(name)
        if meaning is not None:
            exponents = {base: str(n) for base, n in zip(BASE_UNITS, meaning.exponents, strict=True) if n}
            base = SubElement(unit, "BaseUnit", exponents)
            if meaning.factor != 1.0:
                base.set("factor", repr(meaning.factor))
            if meaning.offset != 0.0:
                base.set("offset", repr(meaning.offset))
        for display, (factor, offset) in machine.units.displayed.get(name, {}).items():
            element = SubElement(unit, "DisplayUnit", name=display, factor=repr(factor))
            if offset != 0.0:
                element.set("offset", repr(offset))
