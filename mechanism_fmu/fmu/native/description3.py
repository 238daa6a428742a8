"""modelDescription.xml of FMI 3.0: Model Exchange and co-simulation.

The variables are those of FMI 2.0 under the same names and value references, and time. With a clock of impacts there
are more: the clock, what it clocks, and as one array each what is numbered elsewhere (`impacts.time` is all of
`impacts[1].time` to `impacts[8].time`). Behind all stand the states of Model Exchange, their derivatives and the event
indicators. Section numbers refer to the FMI specification 3.0.2.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Literal
from xml.etree.ElementTree import Element, SubElement

from ...model import MechanismError, Model
from ..parts.model_description import CommonType, definitions, description_root, value_attributes, with_states
from ..parts.states import indicator_count, state_variables
from ..parts.variables import FIRST_REFERENCE, Variable, array_name, common_description, numbered, stride, variables_of

_IMPACT_FLAG = "impact.any"
#: Fields of the last impact; counters are not among them.
_OF_LAST_IMPACT = re.compile(r"impact\.(?!count$|in_step$|lost$|any$)")
_CLOCK = "impact.clock"
_CLOCKED = "impact.tick."
_TYPES: dict[str, Type3] = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}

Type3 = Literal["Float64", "Int32", "Boolean", "Clock"]


@dataclass(frozen=True)
class Variable3:
    """A variable of FMI 3.0 (section 2.4.7).

    Attributes:
        name, description: of the variable; those of an array speak of its element k.
        value_reference: that of FMI 2.0; time, the clock and what comes with it stand behind.
        type: element's name in the XML file.
        scalar: the rest; of an array its first element.
        dimension: number of elements of an array, None of a scalar.
        clock: value reference of the clock at whose ticks the variable changes, or None.
    """

    name: str
    description: str
    value_reference: int
    type: Type3
    scalar: Variable
    dimension: int | None = None
    clock: int | None = None


@dataclass(frozen=True)
class Again:
    """Outputs once more, beside a clock: as an array, or as what the clock brings.

    Attributes:
        name, description: of the variable.
        first: the output that it begins with.
        count: number of elements; None of a scalar.
        stride: how many value references the elements lie apart.
        clocked: whether it has a value at ticks of the clock only.
    """

    name: str
    description: str
    first: Variable
    count: int | None = None
    stride: int = 0
    clocked: bool = False


def reports_impacts(variables: Sequence[Variable]) -> bool:
    """Whether there can be a clock: an output says that there was an impact."""
    return any(variable.source == _IMPACT_FLAG for variable in variables)


def outputs_again(variables: Sequence[Variable]) -> tuple[Again, ...]:
    """What there is beside a clock of impacts, in the order of its value references."""
    clocked = (
        Again(
            _CLOCKED + v.name.removeprefix("impact_"), v.description.replace("last impact", "impact"), v, clocked=True
        )
        for v in variables
        if _OF_LAST_IMPACT.match(v.source)
    )
    arrays = (
        Again(
            array_name(elements[0]),
            common_description([element.description for element in elements]),
            elements[0],
            len(elements),
            stride(elements),
        )
        for elements in numbered(variables)
    )
    return (*clocked, *arrays)


def variables3(model: Model, clocks: bool = False) -> tuple[Variable3, ...]:
    """All variables of a model's FMU for FMI 3.0, by value reference.

    Args:
        model: what the FMU simulates.
        clocks: with a clock of impacts, what it clocks, and arrays.

    Raises:
        MechanismError: two of them have the same name, or there are no impacts for a clock.
    """
    variables = variables_of(model)
    if clocks and not reports_impacts(variables):
        raise MechanismError(
            f"{model.name} has no output that says whether there was an impact, and so no clock; build it without "
            "--clocks."
        )
    found = tuple(_variables3(variables, clocks))
    taken = {variable.name for variable in found}
    found += tuple(_of_exchange(model, found[-1].value_reference + 1, taken))
    names = sorted(variable.name for variable in found)
    for name, same in groupby(names):
        if len(list(same)) > 1:
            raise MechanismError(
                f"In FMI 3.0, two variables of {model.name} are called {name!r}, one of them time or an array made of "
                f"numbered outputs; give the port another name."
            )
    return found


def model_description3(model: Model, token: str, clocks: bool = False) -> Element:
    """The root element `fmiModelDescription` of a model's native FMU.

    Args:
        model: what the FMU simulates.
        token: instantiation token, the fingerprint of the FMU.
        clocks: as of `variables3`.

    Raises:
        UnitError: a port has a unit or display unit that cannot be.
        MechanismError: as of `variables3`.
    """
    variables = variables3(model, clocks)
    scalars = [variable.scalar for variable in variables]
    root = description_root(model, "3.0", {"instantiationToken": token})
    _interfaces(root, model)
    types, elements = definitions(root, model, scalars, _float_type)
    for variable in variables:
        _variable(elements, variable, types)
    _model_structure(root, variables)
    return root


def _variables3(variables: Sequence[Variable], clocks: bool) -> Iterator[Variable3]:
    for variable in variables:
        yield Variable3(variable.name, variable.description, variable.value_reference, _TYPES[variable.type], variable)
    behind = FIRST_REFERENCE + len(variables)
    time = Variable("time", behind, "Real", "independent", "continuous", None, "Time", "s")
    yield Variable3(time.name, time.description, time.value_reference, "Float64", time)
    if not clocks or not reports_impacts(variables):
        return
    clock = behind + 1
    scalar = Variable(_CLOCK, clock, "Boolean", "output", "discrete", None, "Ticks at an impact")
    yield Variable3(scalar.name, scalar.description, clock, "Clock", scalar)
    for reference, one in enumerate(outputs_again(variables), clock + 1):
        yield Variable3(
            one.name,
            one.description,
            reference,
            _TYPES[one.first.type],
            one.first,
            one.count,
            clock if one.clocked else None,
        )


def _of_exchange(model: Model, first: int, taken: Collection[str]) -> Iterator[Variable3]:
    """States, derivatives and event indicators of Model Exchange (section 3)."""
    mechanism = model.mechanism(model.values())
    states = state_variables(mechanism, first, taken)
    behind = first + len(states)
    indicators = [
        Variable(
            f"event_indicator[{k + 1}]", behind + k, "Real", "local", "continuous", "calculated", "Event indicator"
        )
        for k in range(indicator_count(mechanism))
    ]
    for variable in (*states, *indicators):
        yield Variable3(variable.name, variable.description, variable.value_reference, "Float64", variable)


def _is_indicator(variable: Variable3) -> bool:
    return variable.scalar.causality == "local" and variable.scalar.unit is None


def _interfaces(root: Element, model: Model) -> None:
    """Capability flags (sections 3.3 and 4.4)."""
    SubElement(
        root,
        "ModelExchange",
        modelIdentifier=model.name,
        canGetAndSetFMUState="true",
        canSerializeFMUState="true",
        needsCompletedIntegratorStep="true",
        providesDirectionalDerivatives="true",
        providesAdjointDerivatives="true",
    )
    SubElement(
        root,
        "CoSimulation",
        modelIdentifier=model.name,
        canGetAndSetFMUState="true",
        canSerializeFMUState="true",
        canHandleVariableCommunicationStepSize="true",
        providesDirectionalDerivatives="true",
        providesAdjointDerivatives="true",
        maxOutputDerivativeOrder="1",
        providesIntermediateUpdate="true",
        mightReturnEarlyFromDoStep="true",
        canReturnEarlyAfterIntermediateUpdate="true",
        hasEventMode="true",
    )


def _float_type(elements: Element, common: CommonType) -> None:
    SubElement(elements, "Float64Type", {"name": common.name, **common.attributes})


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
    if scalar.derivative is not None:
        element.set("derivative", str(scalar.derivative))
    if scalar.state:
        element.set("reinit", "true")
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
            _unknown(structure, "Output", variable, with_states(variable.scalar, [one.scalar for one in variables]))
    for variable in variables:
        if variable.scalar.derivative is not None:
            _unknown(structure, "ContinuousStateDerivative", variable, None)
    for variable in variables:
        calculated = variable.scalar.initial == "calculated" and not _is_indicator(variable)
        if variable.type == "Clock" or (calculated and variable.clock is None):
            of_exchange = variable.scalar.causality == "local"
            _unknown(
                structure, "InitialUnknown", variable, None if of_exchange else variable.scalar.initial_dependencies
            )
    for variable in variables:
        if _is_indicator(variable):
            _unknown(structure, "EventIndicator", variable, None)


def _unknown(parent: Element, element: str, variable: Variable3, dependencies: Sequence[int] | None) -> None:
    """An unknown; where its dependencies are not said, it may depend on all."""
    unknown = SubElement(parent, element, valueReference=str(variable.value_reference))
    if dependencies is not None:
        unknown.set("dependencies", " ".join(map(str, dependencies)))
        unknown.set("dependenciesKind", " ".join("dependent" for _ in dependencies))
