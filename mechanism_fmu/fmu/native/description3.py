"""modelDescription.xml of FMI 3.0 for co-simulation.

The variables are those of FMI 2.0 under the same value references, with two differences: what is numbered there
(`impacts[1].time` to `impacts[8].time`) is one array here (`impacts.time`), and the Boolean that tells of an impact is
a clock. Section numbers refer to the FMI specification 3.0.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Literal
from xml.etree.ElementTree import Element, SubElement

from ... import __version__
from ...model import MechanismError, Model
from ..model_description import (
    CommonType,
    common_types,
    default_experiment,
    log_categories,
    unit_definitions,
    value_attributes,
)
from ..variables import Variable, variables_of

_ELEMENT = re.compile(r"(?P<array>.+)\[(?P<index>\d+)\](?P<field>\.\w+)")
_CLOCK_SOURCE = "impact.any"
#: Fields of the last impact; counters are not among them.
_CLOCKED_SOURCE = re.compile(r"impact\.(?!count$|in_step$|lost$|any$)")
_TYPES: dict[str, Type3] = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}

Type3 = Literal["Float64", "Int32", "Boolean", "Clock"]


@dataclass(frozen=True)
class Variable3:
    """A variable of FMI 3.0 (section 2.4.7).

    Attributes:
        name, description: of the variable; those of an array speak of its element k.
        value_reference: that of FMI 2.0, of an array that of its first element; the clock and time come behind.
        type: element's name in the XML file.
        scalar: the rest; of an array its first element.
        dimension: number of elements of an array, None of a scalar.
        dependencies: value references of the inputs on which an output depends at the same instant.
        clock: value reference of the clock at whose ticks the variable changes, or None.
    """

    name: str
    description: str
    value_reference: int
    type: Type3
    scalar: Variable
    dimension: int | None = None
    dependencies: tuple[int, ...] = ()
    clock: int | None = None


def array_layout(variables: Sequence[Variable]) -> list[tuple[int, int]]:
    """Where the elements of FMI 3.0's variables are among those of FMI 2.0.

    Args:
        variables: all of a model, see `variables_of`.

    Returns:
        For each variable of FMI 2.0 the number of elements of FMI 3.0's variable under the same value reference, and
        how many value references these lie apart; 0 elements: there is no such variable.
    """
    layout = [(1, 0)] * len(variables)
    for elements in _arrays(variables):
        for element in elements:
            layout[element.value_reference] = (0, 0)
        layout[elements[0].value_reference] = (len(elements), _stride(elements))
    for variable in variables:
        if variable.source == _CLOCK_SOURCE:
            layout[variable.value_reference] = (0, 0)
    return layout


def variables3(model: Model) -> tuple[Variable3, ...]:
    """All variables of a model's FMU for FMI 3.0, by value reference.

    Raises:
        MechanismError: two of them have the same name.
    """
    variables = variables_of(model)
    found = tuple(_variables3(variables))
    names = sorted(variable.name for variable in found)
    for name, same in groupby(names):
        if len(list(same)) > 1:
            raise MechanismError(
                f"In FMI 3.0, two variables of {model.name} are called {name!r}, one of them time or an array made of "
                f"numbered outputs; give the port another name."
            )
    return found


def model_description3(model: Model, token: str) -> Element:
    """The root element `fmiModelDescription` of a model's native FMU.

    Args:
        model: what the FMU simulates.
        token: instantiation token, the fingerprint of the FMU.

    Raises:
        UnitError: a port has a unit or display unit that cannot be.
        MechanismError: two variables have the same name.
    """
    variables = variables3(model)
    scalars = [variable.scalar for variable in variables]
    root = Element(
        "fmiModelDescription",
        fmiVersion="3.0",
        modelName=model.name,
        instantiationToken=token,
        description=model.description,
        version=__version__,
        generationTool=f"mechanism_fmu {__version__}",
        variableNamingConvention="structured",
    )
    _co_simulation(root, model)
    unit_definitions(root, scalars)
    types = common_types(scalars)
    _type_definitions(root, types)
    log_categories(root)
    default_experiment(root, model)
    elements = SubElement(root, "ModelVariables")
    for variable in variables:
        _variable(elements, variable, types)
    _model_structure(root, variables)
    return root


def _variables3(variables: Sequence[Variable]) -> Iterator[Variable3]:
    behind = len(variables)
    ticks = next((v for v in variables if v.source == _CLOCK_SOURCE), None)
    arrays = {elements[0].value_reference: elements for elements in _arrays(variables)}
    for variable, (count, _) in zip(variables, array_layout(variables), strict=True):
        if count == 0:
            continue
        elements = arrays.get(variable.value_reference, [variable])
        is_array = variable.value_reference in arrays
        yield Variable3(
            _array_name(variable) if is_array else variable.name,
            _common_description([element.description for element in elements]),
            variable.value_reference,
            _TYPES[variable.type],
            variable,
            len(elements) if is_array else None,
            tuple(sorted({reference for element in elements for reference in element.dependencies})),
            behind if ticks and _CLOCKED_SOURCE.match(variable.source) else None,
        )
    if ticks:
        yield Variable3(ticks.name, "Ticks at an impact", behind, "Clock", ticks)
    time = Variable("time", behind + 1, "Real", "independent", "continuous", None, "Time", "s")
    yield Variable3(time.name, time.description, time.value_reference, "Float64", time)


def _arrays(variables: Iterable[Variable]) -> Iterator[list[Variable]]:
    """Outputs `name[1].field`, `name[2].field`, ... that differ in nothing else and lie equally far apart."""
    groups: dict[tuple[str, str], list[Variable]] = {}
    for variable in variables:
        match = _ELEMENT.fullmatch(variable.name)
        if match and variable.causality == "output":
            groups.setdefault((match["array"], match["field"]), []).append(variable)
    for (array, field), elements in groups.items():
        first, stride = elements[0], _stride(elements)
        expected = [
            (f"{array}[{k + 1}]{field}", first.value_reference + k * stride, _nature(first))
            for k in range(len(elements))
        ]
        if [(v.name, v.value_reference, _nature(v)) for v in elements] == expected:
            yield elements


def _nature(variable: Variable) -> Variable:
    """All that the elements of an array share."""
    return replace(variable, name="", description="", value_reference=0, source="", dependencies=())


def _stride(elements: Sequence[Variable]) -> int:
    return 0 if len(elements) == 1 else elements[1].value_reference - elements[0].value_reference


def _array_name(first: Variable) -> str:
    match = _ELEMENT.fullmatch(first.name)
    assert match is not None  # `_arrays` has matched it
    return match["array"] + match["field"]


def _common_description(descriptions: Sequence[str]) -> str:
    """The first description, with k for the numbers that count the elements."""
    split = [re.split(r"(\d+)", description) for description in descriptions]
    if len(split) == 1 or len({len(parts) for parts in split}) > 1:
        return descriptions[0]
    indices = [str(k) for k in range(1, len(split) + 1)]
    return "".join("k" if list(column) == indices else column[0] for column in zip(*split, strict=True))


def _co_simulation(root: Element, model: Model) -> None:
    """Capability flags (section 4.4)."""
    SubElement(
        root,
        "CoSimulation",
        modelIdentifier=model.name,
        canGetAndSetFMUState="true",
        canSerializeFMUState="true",
        canHandleVariableCommunicationStepSize="true",
        maxOutputDerivativeOrder="1",
        providesIntermediateUpdate="true",
        mightReturnEarlyFromDoStep="true",
        canReturnEarlyAfterIntermediateUpdate="true",
        hasEventMode="true",
    )


def _type_definitions(root: Element, types: dict[str, CommonType]) -> None:
    if types:
        definitions = SubElement(root, "TypeDefinitions")
        for common in types.values():
            SubElement(definitions, "Float64Type", {"name": common.name, **common.attributes})


def _variable(elements: Element, variable: Variable3, types: dict[str, CommonType]) -> None:
    scalar = variable.scalar
    element = SubElement(
        elements,
        variable.type,
        name=variable.name,
        valueReference=str(variable.value_reference),
        description=variable.description,
        causality=scalar.causality,
        variability=scalar.variability,
    )
    if variable.type == "Clock":
        element.set("intervalVariability", "triggered")
        return
    if scalar.initial is not None:
        element.set("initial", scalar.initial)
    element.attrib.update(value_attributes(scalar, types))
    if variable.clock is not None:
        element.set("clocks", str(variable.clock))
    if scalar.causality == "output" and scalar.variability == "continuous":
        element.set("intermediateUpdate", "true")
    if variable.dimension is not None:
        SubElement(element, "Dimension", start=str(variable.dimension))


def _model_structure(root: Element, variables: Sequence[Variable3]) -> None:
    """Outputs and initial unknowns with their dependencies (section 2.4.8).

    Clocked variables have no value of interest before their clock ticks and are no initial unknowns. The clock itself
    is listed: it is an output and no clocked variable, and FMPy insists (the text leaves open whether a type that has
    no attribute `initial` belongs there).
    """
    structure = SubElement(root, "ModelStructure")
    for variable in variables:
        if variable.scalar.causality == "output":
            _unknown(structure, "Output", variable, variable.dependencies)
    for variable in variables:
        if variable.scalar.initial == "calculated" and variable.clock is None:
            _unknown(structure, "InitialUnknown", variable, variable.scalar.initial_dependencies)


def _unknown(parent: Element, element: str, variable: Variable3, dependencies: Sequence[int]) -> None:
    SubElement(
        parent,
        element,
        valueReference=str(variable.value_reference),
        dependencies=" ".join(map(str, dependencies)),
        dependenciesKind=" ".join("dependent" for _ in dependencies),
    )
