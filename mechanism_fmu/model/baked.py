"""Numbers that a copy of a model has as its own: start values, and what is made of an input before it acts.

For importers that pass outputs on to inputs as they are, and apply no parameters: what a connection between FMUs does
to a signal is then done by the FMU that gets it (docs/decisions/029-baked-machines.md).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from types import SimpleNamespace
from typing import TypeVar

from .errors import MechanismError
from .mechanism import Mechanism
from .model import Model, check_value
from .ports import Input, Parameter

_Port = TypeVar("_Port", Parameter, Input)


@dataclass(frozen=True)
class Seen:
    """How the outside gives an input: the mechanism gets factor * value + offset.

    Attributes:
        factor, offset: the offset in the model's unit of the input; the factor is not 0.
        unit: of the value; None for the model's own.
    """

    factor: float = 1.0
    offset: float = 0.0
    unit: str | None = None


@dataclass(frozen=True)
class Baked:
    """What a copy of a model has as its own.

    Attributes:
        starts: start values of parameters and inputs, by name, in the model's units.
        inputs: by name, those that are given otherwise than in the model.
    """

    starts: Mapping[str, float] = field(default_factory=dict)
    inputs: Mapping[str, Seen] = field(default_factory=dict)


#: The model as it is.
NOTHING_BAKED = Baked()


def baked_model(model: Model, baked: Baked) -> Model:
    """A copy of a model with other start values and inputs.

    Raises:
        MechanismError: it has no such parameter or input, or a value is out of its limits.
    """
    if baked == NOTHING_BAKED:
        return model
    parameters = {parameter.name: parameter for parameter in model.parameters}
    own = {name: start for name, start in baked.starts.items() if name in parameters}
    model.values(**own)
    inputs = {port.name: port for port in model.mechanism(model.values()).inputs}
    unknown = (baked.starts.keys() - own.keys() | baked.inputs.keys()) - inputs.keys()
    if unknown:
        raise MechanismError(f"{model.name} has no parameter or input {', '.join(sorted(unknown))}.")
    for name in baked.starts.keys() & inputs.keys():
        check_value(inputs[name], baked.starts[name])
    for name, seen in baked.inputs.items():
        if seen.factor == 0.0:
            raise MechanismError(f"{model.name}: the factor of input {name} is 0; then leave it unconnected.")
    return replace(
        model,
        parameters=tuple(_started(p, own.get(p.name, p.start)) for p in model.parameters),
        mechanism=partial(_mechanism, model, baked),
    )


def _mechanism(model: Model, baked: Baked, values: SimpleNamespace) -> Mechanism:
    mechanism = model.mechanism(values)
    return replace(mechanism, inputs=tuple(_input(port, baked) for port in mechanism.inputs))


def _input(port: Input, baked: Baked) -> Input:
    """An input as the outside gives it; its start value means what it meant, unless another one is given."""
    seen = baked.inputs.get(port.name)
    start = baked.starts.get(port.name, port.start)
    if seen is None:
        return _started(port, start)

    def outside(value: float) -> float:
        return (value - seen.offset) / seen.factor + 0.0  # no -0.0

    low, high = (None if limit is None else outside(limit) for limit in (port.minimum, port.maximum))
    other_unit = seen.unit is not None and seen.unit != port.unit
    return replace(
        port,
        start=outside(start),
        minimum=low if seen.factor > 0.0 else high,
        maximum=high if seen.factor > 0.0 else low,
        unit=port.unit if seen.unit is None else seen.unit,
        display_unit=None if other_unit else port.display_unit,
        usual=None,
        factor=seen.factor * port.factor,
        offset=port.factor * seen.offset + port.offset,
        description=f"{port.description} (acts as {_formula(seen, port.unit)})",
    )


def _started(port: _Port, start: float) -> _Port:
    """A port with a start value of its own, which may lie beyond what is usual."""
    usual = port.usual if port.usual and port.usual[0] <= start <= port.usual[1] else None
    return replace(port, start=start, usual=usual)


def _formula(seen: Seen, unit: str) -> str:
    """What is made of a value, for the description of an input."""
    shift = f" + {seen.offset:.12g}{'' if unit == '1' else f' {unit}'}" if seen.offset else ""
    return f"{seen.factor:.12g} * value{shift}"
