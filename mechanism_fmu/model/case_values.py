"""The values of a model's cases, checked."""

from __future__ import annotations

import math

from .cases import Case, SineSignal, TableSignal
from .errors import MechanismError
from .model import Model
from .ports import Input, Parameter
from .quantities import quantity

#: What the start values of a model are called where its cases are shown: no case of its own has that name.
START = "start"


def case_values(model: Model, case: Case) -> dict[str, float]:
    """The values of a case in SI units, checked.

    Args:
        model: whose case it is.
        case: one of its cases.

    Raises:
        MechanismError: the name is none or taken, a name of a value or signal is unknown, a value or signal is outside
            its limits, or a time is not positive and finite.
    """
    label = f"{model.name}: case {case.name!r}"
    for name, signal in case.signals.items():
        if not isinstance(signal, SineSignal | TableSignal):
            raise MechanismError(f"{label}: {name} over time is {signal!r}; give a SineSignal or a TableSignal.")
    if not case.name.isidentifier() or not case.name.islower():
        raise MechanismError(f"{label}: its name must be of small letters, digits and underscores.")
    if case.name == START:
        raise MechanismError(f"{label}: that is what the start values of the model are called; give it another name.")
    if sum(one.name == case.name for one in model.cases) > 1:
        raise MechanismError(f"{label} is there twice; give each a name of its own.")
    for what, time in (("stop_time", case.stop_time), ("step_size", case.step_size)):
        if time is not None and not 0.0 < time < math.inf:
            raise MechanismError(f"{label}: {what} = {time:g} s, but it must be positive and finite.")
    inputs: dict[str, Input | Parameter] = {port.name: port for port in model.mechanism(model.values()).inputs}
    ports = inputs | {parameter.name: parameter for parameter in model.parameters}
    for name, known in (*((n, ports) for n in case.values), *((n, inputs) for n in case.signals)):
        if name not in known:
            raise MechanismError(f"{label}: there is no {name!r}; there are: {', '.join(sorted(known))}.")
    values = {name: float(quantity(value, ports[name].unit, name)) for name, value in case.values.items()}
    extremes = list(values.items())
    extremes += [(name, end) for name, signal in case.signals.items() for end in signal.span]
    for name, value in extremes:
        _check(label, ports[name], value)
    model.checked({p.name: p.start for p in model.parameters} | {n: v for n, v in values.items() if n not in inputs})
    return values


def _check(label: str, port: Input | Parameter, value: float) -> None:
    least = -math.inf if port.minimum is None else port.minimum
    most = math.inf if port.maximum is None else port.maximum
    if not least <= value <= most or not math.isfinite(value):
        raise MechanismError(f"{label}: {port.name} = {value:g}, but it must be from {least:g} to {most:g}.")
