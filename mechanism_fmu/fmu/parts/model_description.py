"""modelDescription.xml of FMI 2.0: co-simulation, and Model Exchange where the FMU is native.

Section numbers refer to the FMI specification 2.0.4.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from pythonfmu import __version__ as pythonfmu_version

from ... import __version__
from ...model import Model
from ...units import BASE_UNITS
from .fmi_units import OFFERED_DISPLAY_UNITS, UnitError, display_factor, parse_unit
from .states import indicator_count, state_variables
from .variables import FIRST_REFERENCE, Variable, variables_of

#: FMI log categories (section 2.2.4) and when a message falls into one.
LOG_CATEGORIES = {
    "logEvents": "Impacts and events: what fired, closed contacts before and after, impulse.",
    "logStatusWarning": "Legal, but worth a look.",
    "logStatusDiscard": "A step that could not be made.",
    "logStatusError": "A call or a value that was refused.",
    "logStatusFatal": "The instance must be reset or freed.",
    "logAll": "All messages.",
}

#: In the folder `sources`: an error for who wants to compile the FMU (see `contents.no_sources`).
NO_SOURCES = "no_sources.c"

#: Capability flags in which the flavours differ. Of the machine that runs it, the one by pythonfmu asks for a Python.
_BY_PYTHONFMU = {"needsExecutionTool": "true", "canNotUseMemoryManagementFunctions": "true"}
_DERIVATIVES = {"providesDirectionalDerivative": "true"}
_NATIVE = {
    "needsExecutionTool": "false",
    "canInterpolateInputs": "true",
    "maxOutputDerivativeOrder": "1",
    **_DERIVATIVES,
}

#: Declared type (its name is also the quantity, as in the Modelica Standard Library) of a unit.
_TYPES = {
    "rad": "Angle",
    "rad/s": "AngularVelocity",
    "m": "Length",
    "m/s": "Velocity",
    "s": "Time",
    "1/s": "Rate",
    "kg": "Mass",
    "kg.m2": "MomentOfInertia",
    "N": "Force",
    "N.m": "Torque",
    "N.m/rad": "RotationalSpringConstant",
    "N.m.s/rad": "RotationalDampingConstant",
    "N.s": "Impulse",
    "J": "Energy",
}


def model_description(model: Model, guid: str, native: bool = False) -> Element:
    """The root element `fmiModelDescription` of a model's FMU.

    Args:
        model: what the FMU simulates.
        guid: fingerprint of the FMU.
        native: the FMU needs no Python where it runs.

    Raises:
        UnitError: a port has a unit or display unit that cannot be.
    """
    variables = variables_of(model)
    wrapper = "" if native else f" (pythonfmu {pythonfmu_version})"
    root = description_root(model, "2.0", {"guid": guid}, wrapper)
    if native:  # pythonfmu's wrapper has no Model Exchange
        mechanism = model.mechanism(model.values())
        names = {variable.name for variable in variables}
        variables += state_variables(mechanism, FIRST_REFERENCE + len(variables), names)
        root.set("numberOfEventIndicators", str(indicator_count(mechanism)))
        _interface(root, "ModelExchange", model, {"needsExecutionTool": "false", **_DERIVATIVES})
    co_simulation = {"canHandleVariableCommunicationStepSize": "true", **(_NATIVE if native else _BY_PYTHONFMU)}
    _interface(root, "CoSimulation", model, co_simulation)
    types, elements = definitions(root, model, variables, _simple_type)
    for variable in variables:
        _scalar_variable(elements, variable, types)
    _model_structure(root, variables)
    return root


# What is alike in FMI 2.0 and 3.0.


def description_root(model: Model, fmi: str, fingerprint: Mapping[str, str], wrapper: str = "") -> Element:
    """The root element with what says what the FMU is, and who made it.

    There is no generationDateAndTime: the same sources shall give the same bytes.

    Args:
        model: what the FMU simulates.
        fmi: version of the standard.
        fingerprint: of the FMU, as the attribute that this version has for it.
        wrapper: what else made it, behind this project's name.
    """
    given = {
        "fmiVersion": fmi,
        "modelName": model.name,
        **fingerprint,
        "description": model.description,
        "generationTool": f"mechanism_fmu {__version__}{wrapper}",
        "variableNamingConvention": "structured",
    }
    origin = {"author": model.author, "version": __version__, "license": model.license}
    return Element("fmiModelDescription", given | {name: value for name, value in origin.items() if value})


def definitions(
    root: Element, model: Model, variables: Sequence[Variable], define: Callable[[Element, CommonType], object]
) -> tuple[dict[str, CommonType], Element]:
    """Append all between `CoSimulation` and the variables; `define` appends one type.

    Returns:
        The types by unit, and the empty element `ModelVariables`.
    """
    _unit_definitions(root, variables)
    types = _common_types(variables)
    if types:
        elements = SubElement(root, "TypeDefinitions")
        for common in types.values():
            define(elements, common)
    categories = SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=description)
    SubElement(
        root,
        "DefaultExperiment",
        startTime=_real(0.0),
        stopTime=_real(model.stop_time),
        tolerance=_real(model.mechanism(model.values()).settings.relative_tolerance),
        stepSize=_real(model.step_size),
    )
    return types, SubElement(root, "ModelVariables")


def to_bytes(root: Element) -> bytes:
    """An XML document as UTF-8, the same bytes for the same elements."""
    indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{tostring(root, encoding="unicode")}\n'.encode()


def _interface(root: Element, name: str, model: Model, flags: dict[str, str]) -> None:
    """Capability flags of an interface (sections 3.3.1 and 4.3.1)."""
    common = {"canGetAndSetFMUstate": "true", "canSerializeFMUstate": "true"}
    element = SubElement(root, name, {"modelIdentifier": model.name, **common, **flags})
    SubElement(SubElement(element, "SourceFiles"), "File", name=NO_SOURCES)


def _unit_definitions(root: Element, variables: Iterable[Variable]) -> None:
    """Append units with their base units and display units (section 2.2.2)."""
    shown: dict[str, set[str]] = {}
    for variable in variables:
        if variable.unit is not None:
            _check_units(variable.name, variable.unit, variable.display_unit)
            display_units = shown.setdefault(variable.unit, set(OFFERED_DISPLAY_UNITS.get(variable.unit, ())))
            display_units.update(filter(None, [variable.display_unit]))
    if not shown:
        return
    definitions = SubElement(root, "UnitDefinitions")
    for name, display_units in sorted(shown.items()):
        definition = SubElement(definitions, "Unit", name=name)
        unit = parse_unit(name)
        base = SubElement(definition, "BaseUnit")
        for symbol, exponent in zip(BASE_UNITS, unit.exponents, strict=True):
            if exponent:
                base.set(symbol, str(exponent))
        if unit.factor != 1.0:
            base.set("factor", _real(unit.factor))
        for display_unit in sorted(display_units):
            factor = display_factor(name, display_unit)
            SubElement(definition, "DisplayUnit", name=display_unit, factor=_real(factor))


def _check_units(name: str, unit: str, display_unit: str | None) -> None:
    try:
        display_factor(unit, display_unit or unit)
    except UnitError as error:
        raise UnitError(f"{name}: {error}") from None


@dataclass(frozen=True)
class CommonType:
    """A declared type of all variables of a unit; its name is also the quantity.

    Attributes:
        name, unit: of the type.
        display_unit: the one that all these variables share, or None.
    """

    name: str
    unit: str
    display_unit: str | None

    @property
    def attributes(self) -> dict[str, str]:
        """The attributes of a Real type in FMI 2.0 and 3.0, beside its name."""
        shown = {"displayUnit": self.display_unit} if self.display_unit else {}
        return {"quantity": self.name, "unit": self.unit, **shown}


def _common_types(variables: Sequence[Variable]) -> dict[str, CommonType]:
    """Types of the recurring quantities (section 2.2.3), by unit."""

    def shared_by(unit: str) -> str | None:
        shown = {v.display_unit for v in variables if v.unit == unit}
        return shown.pop() if len(shown) == 1 else None

    used = {v.unit for v in variables if v.unit is not None}
    return {unit: CommonType(name, unit, shared_by(unit)) for unit, name in _TYPES.items() if unit in used}


def _simple_type(elements: Element, common: CommonType) -> None:
    SubElement(SubElement(elements, "SimpleType", name=common.name), "Real", common.attributes)


def _scalar_variable(elements: Element, variable: Variable, types: dict[str, CommonType]) -> None:
    element = SubElement(
        elements,
        "ScalarVariable",
        name=variable.name,
        valueReference=str(variable.value_reference),
        description=variable.description,
        causality=variable.causality,
        variability=variable.variability,
    )
    if variable.initial is not None:
        element.set("initial", variable.initial)
    attributes = value_attributes(variable, types)
    if variable.derivative is not None:
        attributes["derivative"] = str(_index(variable.derivative))
    if variable.state:
        attributes["reinit"] = "true"
    SubElement(element, variable.type, attributes)


def value_attributes(variable: Variable, types: dict[str, CommonType]) -> dict[str, str]:
    """Type, units, limits and start value as attributes, alike in FMI 2.0 and 3.0."""
    attributes = {}
    if variable.unit is not None:
        if variable.unit in types:
            attributes["declaredType"] = types[variable.unit].name
        # Said again, because many tools do not look into the declared type.
        attributes["unit"] = variable.unit
    if variable.display_unit is not None:
        attributes["displayUnit"] = variable.display_unit
    limits = (("min", variable.minimum), ("max", variable.maximum), ("nominal", variable.nominal))
    for name, number in (*limits, ("start", variable.start)):
        if number is not None:
            attributes[name] = _number(variable.type, number)
    return attributes


def with_states(output: Variable, variables: Iterable[Variable]) -> tuple[int, ...]:
    """What an output depends on: its inputs, and in Model Exchange all states where it varies continuously."""
    states = (v.value_reference for v in variables if v.state)
    return (*output.dependencies, *states) if output.variability == "continuous" else output.dependencies


def _model_structure(root: Element, variables: Sequence[Variable]) -> None:
    """Outputs and initial unknowns with their dependencies (section 2.2.8); indices count from 1."""
    structure = SubElement(root, "ModelStructure")
    outputs = [v for v in variables if v.causality == "output"]
    if outputs:
        element = SubElement(structure, "Outputs")
        for variable in outputs:
            _unknown(element, variable, with_states(variable, variables))
    rates = [v for v in variables if v.derivative is not None]
    if rates:
        element = SubElement(structure, "Derivatives")
        for variable in rates:
            _unknown(element, variable, None)
    unknowns = [v for v in variables if v.initial == "calculated"]
    if unknowns:
        element = SubElement(structure, "InitialUnknowns")
        for variable in unknowns:
            _unknown(element, variable, None if variable.causality == "local" else variable.initial_dependencies)


def _unknown(parent: Element, variable: Variable, dependencies: Sequence[int] | None) -> None:
    """An unknown; where its dependencies are not said, it may depend on all."""
    element = SubElement(parent, "Unknown", index=str(_index(variable.value_reference)))
    if dependencies is not None:
        element.set("dependencies", " ".join(str(_index(reference)) for reference in dependencies))
        element.set("dependenciesKind", " ".join("dependent" for _ in dependencies))


def _index(reference: int) -> int:
    """Place of a variable in the list, which the standard counts from 1, whatever the value references."""
    return reference - FIRST_REFERENCE + 1


def _number(kind: str, value: float) -> str:
    if kind == "Boolean":
        return "true" if value else "false"
    return str(int(value)) if kind == "Integer" else _real(value)


def _real(value: float) -> str:
    """The shortest text that reads back as the same double."""
    return repr(float(value))
