"""The variables of an FMU: the ports of a model, numbered, and arrays of them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from ...model import Calculated, Input, Model, Output, Parameter
from ...model.ports import VariableType

Causality = Literal["input", "output", "parameter", "calculatedParameter", "independent", "local"]
Variability = Literal["fixed", "discrete", "continuous"]
Initial = Literal["exact", "calculated"]

#: Of the first variable: OMSimulator 3.0 resolves no dependency on 0.
FIRST_REFERENCE = 1

#: An output source that changes at impacts and events only, and says nothing at the start (see
#: `mechanism_fmu.model.Output`).
_OF_IMPACT = re.compile(r"impacts?(\[\d+\])?\.|events\[\d+\]\.|event\.in_step$")


@dataclass(frozen=True)
class Variable:
    """A scalar variable of FMI 2.0 (specification 2.0.4, section 2.2.7).

    Attributes:
        name, description: of the port.
        value_reference: position among all variables, from 1: some importers take 0 for none.
        type, causality, variability: as in the specification.
        initial: None for inputs and time, for which the specification forbids it.
        unit: SI unit of a Real, None for the other types.
        display_unit: unit in which a tool should show a Real; None for `unit` itself.
        start: value before initialization, None for what is calculated.
        minimum, maximum: inclusive limits, in `unit`.
        nominal: typical magnitude, in `unit`.
        dependencies: value references of the inputs on which an output depends at the same communication point.
        initial_dependencies: value references of the inputs and parameters on which a calculated variable depends
            in initialization mode.
        source: what an output reads (see `mechanism_fmu.model.Output`); "" of all others.
        derivative: value reference of the state whose derivative it is, or None.
        state: whether it is a continuous state, which events may change.
    """

    name: str
    value_reference: int
    type: VariableType
    causality: Causality
    variability: Variability
    initial: Initial | None
    description: str
    unit: str | None = None
    display_unit: str | None = None
    start: float | int | bool | None = None
    minimum: float | None = None
    maximum: float | None = None
    nominal: float | None = None
    dependencies: tuple[int, ...] = ()
    initial_dependencies: tuple[int, ...] = ()
    source: str = ""
    derivative: int | None = None
    state: bool = False


def variables_of(model: Model) -> tuple[Variable, ...]:
    """All variables of a model's FMU: inputs, outputs, parameters, calculated parameters.

    The value reference of a variable is its position in the tuple, from `FIRST_REFERENCE`.
    """
    mechanism = model.mechanism(model.values())
    inputs, outputs = mechanism.inputs, mechanism.outputs
    first_output = FIRST_REFERENCE + len(inputs)
    first_parameter = first_output + len(outputs)
    parameters = tuple(range(first_parameter, first_parameter + len(model.parameters)))
    input_references = {port.name: reference for reference, port in enumerate(inputs, FIRST_REFERENCE)}

    def variables() -> Iterator[Variable]:
        for reference, port in enumerate(inputs, FIRST_REFERENCE):
            yield _input(port, reference)
        for reference, output in enumerate(outputs, first_output):
            feedthrough = tuple(sorted(input_references[name] for name in output.feedthrough))
            yield _output(output, reference, feedthrough, parameters)
        for reference, parameter in zip(parameters, model.parameters, strict=True):
            yield _parameter(parameter, reference)
        for reference, calculated in enumerate(mechanism.calculated, first_parameter + len(parameters)):
            yield _calculated(calculated, reference, parameters)

    return tuple(variables())


def _input(port: Input, reference: int) -> Variable:
    return Variable(
        port.name,
        reference,
        "Real",
        "input",
        "continuous",
        None,
        port.description,
        port.unit,
        port.display_unit,
        float(port.start),
        port.minimum,
        port.maximum,
    )


def _output(port: Output, reference: int, feedthrough: tuple[int, ...], parameters: tuple[int, ...]) -> Variable:
    # What the last impact left is the same in every new instance: it depends on nothing.
    of_impact = bool(_OF_IMPACT.match(port.source))
    real = port.type == "Real"
    return Variable(
        port.name,
        reference,
        port.type,
        "output",
        "continuous" if real and not of_impact else "discrete",
        "calculated",
        port.description,
        port.unit if real else None,
        port.display_unit if real else None,
        nominal=port.nominal,
        dependencies=feedthrough,
        initial_dependencies=() if of_impact else feedthrough + parameters,
        source=port.source,
    )


def _parameter(port: Parameter, reference: int) -> Variable:
    real = port.type == "Real"
    cast = {"Real": float, "Integer": int, "Boolean": bool}[port.type]
    return Variable(
        port.name,
        reference,
        port.type,
        "parameter",
        "fixed",
        "exact",
        port.description,
        port.unit if real else None,
        port.display_unit if real else None,
        cast(port.start),
        port.minimum,
        port.maximum,
    )


def _calculated(port: Calculated, reference: int, parameters: tuple[int, ...]) -> Variable:
    return Variable(
        port.name,
        reference,
        "Real",
        "calculatedParameter",
        "fixed",
        "calculated",
        port.description,
        port.unit,
        port.display_unit,
        initial_dependencies=parameters,
    )


# Outputs that are numbered elements of something: `impacts[1].time`, `impacts[2].time`, ... belong together.

_ELEMENT = re.compile(r"(?P<array>.+)\[(?P<index>\d+)\](?P<field>\.\w+)")


def numbered(variables: Iterable[Variable]) -> Iterator[list[Variable]]:
    """Discrete outputs `name[1].field`, `name[2].field`, ... that differ in nothing else and lie equally far apart."""
    groups: dict[tuple[str, str], list[Variable]] = {}
    for variable in variables:
        match = _ELEMENT.fullmatch(variable.name)
        if match and variable.causality == "output" and variable.variability == "discrete":
            groups.setdefault((match["array"], match["field"]), []).append(variable)
    for (array, field), elements in groups.items():
        first, apart = elements[0], stride(elements)
        expected = [
            (f"{array}[{k + 1}]{field}", first.value_reference + k * apart, _nature(first))
            for k in range(len(elements))
        ]
        if [(v.name, v.value_reference, _nature(v)) for v in elements] == expected:
            yield elements


def _nature(variable: Variable) -> Variable:
    """All that the elements of an array share."""
    return replace(variable, name="", description="", value_reference=0, source="", dependencies=())


def stride(elements: Sequence[Variable]) -> int:
    """How many value references the elements lie apart; 0 of a single one."""
    return 0 if len(elements) == 1 else elements[1].value_reference - elements[0].value_reference


def array_name(first: Variable) -> str:
    """What an array is called whose first element this is: `impacts.time`."""
    match = _ELEMENT.fullmatch(first.name)
    assert match is not None  # `numbered` has matched it
    return match["array"] + match["field"]


def common_description(descriptions: Sequence[str]) -> str:
    """The first description, with k for the numbers that count the elements."""
    split = [re.split(r"(\d+)", description) for description in descriptions]
    if len(split) == 1 or len({len(parts) for parts in split}) > 1:
        return descriptions[0]
    indices = [str(k) for k in range(1, len(split) + 1)]
    return "".join("k" if list(column) == indices else column[0] for column in zip(*split, strict=True))
