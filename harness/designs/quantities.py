"""The quantities that a file asks for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..declared import NO_BEAM
from ..description import Description, Variable, hint_at, not_in_step_mode
from ..impacts import ImpactCollector
from ..toml_file import Section
from ..tooth_damage import DAMAGE_UNITS
from ..tooth_stress import STRESS_UNITS
from .task import Quantity, When

_NUMBERS = ("Real", "Integer", "Boolean")


class UnknownQuantityError(ValueError):
    """A quantity that cannot be had; the message says which can."""


def recorded(section: Section, description: Description) -> list[Quantity]:
    """The quantities of the table [record]: for each `When` a list of names."""
    found = []
    for when in When:
        for name in section.texts(when):
            try:
                found.append(quantity(when, name, description))
            except UnknownQuantityError as error:
                section.wrong(when, str(error))
    section.done()
    return found


def with_slenderness(quantities: Sequence[Quantity], description: Description) -> tuple[Quantity, ...]:
    """The quantities, and where stresses are among them the slenderness of the beam, if the FMU has it.

    It says of each design how far beam theory, and so its stress, may be trusted.
    """
    struck = description.analysis.struck
    known = None if struck is None else description.variables.get(struck.slenderness)
    if known is None or not any(asks_for_stress(one) for one in quantities):
        return tuple(quantities)
    slenderness = Quantity(When.PARAMETER, known.name, known.type, known.unit, known.display_unit)
    return tuple(dict.fromkeys([*quantities, slenderness]))


def asks_for_stress(quantity: Quantity) -> bool:
    """Whether a quantity is about what impacts do to a beam."""
    return quantity.when is When.ALL_IMPACTS or (quantity.when.of_impacts and quantity.name in STRESS_UNITS)


def quantity(when: When, name: str, description: Description) -> Quantity:
    """The quantity with this name.

    Raises:
        UnknownQuantityError: there is none.
    """
    variables = _variables(when, description)
    if name in variables:
        variable = variables[name]
        return Quantity(when, name, variable.type, variable.unit, variable.display_unit)
    raise UnknownQuantityError(_objection(when, name, description, variables))


def column(text: str, description: Description) -> Quantity:
    """The quantity of a column, as "largest_impact.stress_max".

    Raises:
        UnknownQuantityError: there is none.
    """
    when, _, name = text.partition(".")
    if when not in list(When) or not name:
        raise UnknownQuantityError(
            f"'{text}' is no quantity; write when and what, as in \"end.wheel_angle\"; "
            f"when is one of {', '.join(When)}.{hint_at(when, list(When))}"
        )
    return quantity(When(when), name, description)


def _variables(when: When, description: Description) -> Mapping[str, Variable]:
    """What can be had at this time, by name."""
    if when.of_impacts:
        fields = ImpactCollector(description).fields
        if when is When.ALL_IMPACTS:
            return _stresses(description, fields, DAMAGE_UNITS)
        return {**fields, **_stresses(description, fields, STRESS_UNITS)}
    causalities = ("parameter", "calculatedParameter") if when is When.PARAMETER else ("input", "output")
    return {variable.name: variable for variable in description.of(*causalities) if variable.type in _NUMBERS}


def _stresses(
    description: Description, fields: Mapping[str, Variable], units: Mapping[str, str]
) -> dict[str, Variable]:
    """What impacts do to a beam, if the FMU declares one and reports the jump that makes it ring."""
    struck = description.analysis.struck
    if struck is None or struck.jump not in fields:
        return {}
    return {
        name: Variable(name, reference=-1, type="Real", causality="local", unit="" if unit == "1" else unit)
        for name, unit in units.items()
    }


def _objection(when: When, name: str, description: Description, variables: Mapping[str, Variable]) -> str:
    if when.of_impacts:
        if not ImpactCollector(description).fields:
            return f"{description.model} reports no impacts, so there is no '{name}' of one."
        if name in (DAMAGE_UNITS if when is When.ALL_IMPACTS else STRESS_UNITS) or not variables:
            return f"{description.model} gives no '{name}': {description.analysis.objection or NO_BEAM}"
        return f"an impact has no '{name}'.{_way_out(name, variables)}"
    if name in description.variables:
        variable = description.variable(name)
        if variable.in_event_mode_only:
            return f"{not_in_step_mode(variable)}.{hint_at(name, variables)}"
        why = "a text" if variable.type in ("String", "Binary") else f"a variable of causality {variable.causality}"
        others = [w for w in When if name in _variables(w, description)]
        hint = f" Write it at {' or '.join(others)}." if others else ""
        return f"'{name}' is {why}, which cannot be had {when.meaning()}.{hint}"
    known = "parameter" if when is When.PARAMETER else "input or output"
    return f"{description.model} has no {known} '{name}'.{_way_out(name, variables)}"


def _way_out(name: str, variables: Mapping[str, Variable]) -> str:
    plain = [known for known in variables if "[" not in known]
    return hint_at(name, variables) or f" There are: {', '.join(plain)}."
