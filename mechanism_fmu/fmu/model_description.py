"""modelDescription.xml of FMI 2.0 for co-simulation.

Section numbers refer to the FMI specification 2.0.4.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from pythonfmu import __version__ as pythonfmu_version

from .. import __version__
from ..model import Model
from .units import BASE_UNITS, OFFERED_DISPLAY_UNITS, UnitError, display_factor, parse_unit
from .variables import Variable, variables_of

#: FMI log categories (section 2.2.4) and when a message falls into one.
LOG_CATEGORIES = {
    "logEvents": "Impacts and events: what fired, closed contacts before and after, impulse.",
    "logStatusWarning": "Legal, but worth a look.",
    "logStatusDiscard": "A step that could not be made.",
    "logStatusError": "A call or a value that was refused.",
    "logStatusFatal": "The instance must be reset or freed.",
    "logAll": "All messages.",
}

#: Capability flags in which the flavours differ. Of the machine that runs it, the one by pythonfmu asks for a Python.
_BY_PYTHONFMU = {"needsExecutionTool": "true", "canNotUseMemoryManagementFunctions": "true"}
_NATIVE = {"needsExecutionTool": "false", "canInterpolateInputs": "true", "maxOutputDerivativeOrder": "1"}

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
    root = Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=model.name,
        guid=guid,
        description=model.description,
        version=__version__,
        generationTool=f"mechanism_fmu {__version__}" + ("" if native else f" (pythonfmu {pythonfmu_version})"),
        variableNamingConvention="structured",
    )
    _co_simulation(root, model, _NATIVE if native else _BY_PYTHONFMU)
    _unit_definitions(root, variables)
    types = _type_definitions(root, variables)
    categories = SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=description)
    _default_experiment(root, model)
    elements = SubElement(root, "ModelVariables")
    for variable in variables:
        _scalar_variable(elements, variable, types)
    _model_structure(root, variables)
    return root


def to_bytes(root: Element) -> bytes:
    """An XML document as UTF-8, the same bytes for the same elements."""
    indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{tostring(root, encoding="unicode")}\n'.encode()


def _co_simulation(root: Element, model: Model, flags: dict[str, str]) -> None:
    """Capability flags (section 4.3.1)."""
    SubElement(
        root,
        "CoSimulation",
        modelIdentifier=model.name,
        canHandleVariableCommunicationStepSize="true",
        canGetAndSetFMUstate="true",
        canSerializeFMUstate="true",
        **flags,
    )


def _default_experiment(root: Element, model: Model) -> None:
    tolerance = model.mechanism(model.values()).settings.relative_tolerance
    SubElement(
        root,
        "DefaultExperiment",
        startTime=_real(0.0),
        stopTime=_real(model.stop_time),
        tolerance=_real(tolerance),
        stepSize=_real(model.step_size),
    )


def _unit_definitions(root: Element, variables: Iterable[Variable]) -> None:
    """Units with their base units and display units (section 2.2.2)."""
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


def _type_definitions(root: Element, variables: Sequence[Variable]) -> dict[str, str]:
    """Types of the recurring quantities (section 2.2.3); returns the type's name of each unit that has one."""
    used = {v.unit for v in variables if v.unit is not None}
    types = {unit: name for unit, name in _TYPES.items() if unit in used}
    if types:
        definitions = SubElement(root, "TypeDefinitions")
        for unit, name in types.items():
            real = SubElement(SubElement(definitions, "SimpleType", name=name), "Real", quantity=name, unit=unit)
            display_units = {v.display_unit for v in variables if v.unit == unit}
            if len(display_units) == 1 and (common := display_units.pop()):
                real.set("displayUnit", common)
    return types


def _scalar_variable(elements: Element, variable: Variable, types: dict[str, str]) -> None:
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
    value = SubElement(element, variable.type)
    if variable.unit is not None:
        if variable.unit in types:
            value.set("declaredType", types[variable.unit])
        # Said again, because many tools do not look into the declared type.
        value.set("unit", variable.unit)
    if variable.display_unit is not None:
        value.set("displayUnit", variable.display_unit)
    limits = (("min", variable.minimum), ("max", variable.maximum), ("nominal", variable.nominal))
    for name, number in (*limits, ("start", variable.start)):
        if number is not None:
            value.set(name, _number(variable.type, number))


def _model_structure(root: Element, variables: Sequence[Variable]) -> None:
    """Outputs and initial unknowns with their dependencies (section 2.2.8); indices count from 1."""
    structure = SubElement(root, "ModelStructure")
    outputs = [v for v in variables if v.causality == "output"]
    if outputs:
        element = SubElement(structure, "Outputs")
        for variable in outputs:
            _unknown(element, variable, variable.dependencies)
    unknowns = [v for v in variables if v.initial == "calculated"]
    if unknowns:
        element = SubElement(structure, "InitialUnknowns")
        for variable in unknowns:
            _unknown(element, variable, variable.initial_dependencies)


def _unknown(parent: Element, variable: Variable, dependencies: Sequence[int]) -> None:
    SubElement(
        parent,
        "Unknown",
        index=str(variable.value_reference + 1),
        dependencies=" ".join(str(reference + 1) for reference in dependencies),
        dependenciesKind=" ".join("dependent" for _ in dependencies),
    )


def _number(kind: str, value: float) -> str:
    if kind == "Boolean":
        return "true" if value else "false"
    return str(int(value)) if kind == "Integer" else _real(value)


def _real(value: float) -> str:
    """The shortest text that reads back as the same double."""
    return repr(float(value))
