"""What a page gets to know of a model beyond its FMU: usual ranges, cases, names of contacts, what is struck."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from ...model import Case, ImpactStress, Model, settings_parameters
from ...model.case_values import START, case_values
from ...model.ports import Range

#: What a page calls the start values of a model whose first case has others.
_START = Case(START, "The start values of the model")


@dataclass(frozen=True)
class WebData:
    """Beyond the variables.

    Attributes:
        usual: ranges of parameters and inputs that have one, by name.
        settings: names of the parameters of the integration.
        contacts: names, by number.
        struck: kind of the beam that impacts strike, its name, and the field of the records of impacts with v_I [m/s];
            None where nothing is struck.
        cases: as JSON; the first one has the start values. Keys: `name`, `description`, `stop` [s], `step` [s],
            `values` in SI units, `signals`: sines as {mean, amplitude, period, phase}, tables as {times, values}.
    """

    usual: dict[str, Range]
    settings: frozenset[str]
    contacts: tuple[str, ...]
    struck: tuple[str, str, str] | None
    cases: list[dict[str, Any]]


def web_data(model: Model) -> WebData:
    """What a page gets to know of a model.

    Raises:
        MechanismError: a case cannot be.
    """
    mechanism = model.mechanism(model.values())
    ports = (*mechanism.inputs, *model.parameters)
    struck = (one for one in model.analysis if isinstance(one, ImpactStress))
    return WebData(
        {port.name: port.usual for port in ports if port.usual is not None},
        frozenset(parameter.name for parameter in settings_parameters()),
        tuple(contact.name for contact in mechanism.contacts),
        next(((type(one.beam).__name__, one.name, one.jump) for one in struck), None),
        _cases(model, {port.name: port.start for port in ports}),
    )


def _cases(model: Model, starts: dict[str, float]) -> list[dict[str, Any]]:
    flags = {parameter.name for parameter in model.parameters if parameter.type == "Boolean"}
    found = []
    for case in model.cases:
        values = case_values(model, case)
        found.append(_told(model, case, {n: bool(v) if n in flags else v for n, v in values.items()}))
    if found and not found[0]["signals"] and all(starts[n] == v for n, v in found[0]["values"].items()):
        return found
    return [_told(model, _START, {}), *found]


def _told(model: Model, case: Case, values: dict[str, Any]) -> dict[str, Any]:
    return {
        "name": case.name,
        "description": case.description,
        "stop": model.stop_time if case.stop_time is None else case.stop_time,
        "step": model.step_size if case.step_size is None else case.step_size,
        "values": values,
        "signals": {name: asdict(signal) for name, signal in case.signals.items()},
    }
