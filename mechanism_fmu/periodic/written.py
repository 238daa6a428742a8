"""A problem as it is written on a command line: names, values with units, what is unknown and what advances."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ..model import MechanismError, Model
from ..model.quantities import quantity
from .passage import Direction, Section
from .start import UNITS, Problem, Unknown, finely, numbers_of_bodies

_START = "_start"


def problem_of(
    model: Model,
    unknowns: Sequence[str] = (),
    settings: Sequence[str] = (),
    advances: Sequence[str] = (),
    tolerance: float = 1e-11,
    section: str = "",
) -> Problem:
    """A problem as it is written on a command line.

    Args:
        model: the model.
        unknowns: names, "wheel.angle" or "pendulum_angle_start"; with another output than that of the same name
            without `_start`: "start=bird"; none: all parameters that end in `_start` and have such an output.
        settings: "name=value", of parameters and inputs, with or without unit.
        advances: "name=value", of unknowns that grow each cycle.
        tolerance: relative, of the integration [1].
        section: output of the section, which may advance, too.

    Raises:
        MechanismError: a name, value or unit that cannot be; the message says what can.

    Source: R. Seydel, Practical Bifurcation and Stability Analysis, 3rd ed. (2010), sections 7.4 and 7.5.
    """
    values, inputs = _settings(model, settings)
    bare = Problem(model, values, inputs, (), tolerance=tolerance)
    mechanism = finely(bare, {})
    outputs = {output.name: output.unit for output in mechanism.outputs}
    parameters = {p.name: p.unit for p in model.parameters}
    wanted = list(unknowns) or [name for name in parameters if name.endswith(_START) and _bare(name) in outputs]
    if not wanted:
        raise MechanismError(
            f"{model.name} has no parameter like angle{_START} with an output of the same name; say what is unknown at "
            f"the beginning of a cycle, --unknown NAME for each: {', '.join(numbers_of_bodies(mechanism))}."
        )
    found = [_unknown(text, parameters, outputs) for text in wanted]
    for name, text in (_pair(entry, "--advance") for entry in advances):
        places = [k for k, u in enumerate(found) if name in (u.name, u.output)]
        if not places and name == section:
            continue
        if not places:
            raise MechanismError(f"{name} advances, but is not unknown; unknown: {', '.join(u.name for u in found)}.")
        unknown = found[places[0]]
        found[places[0]] = replace(unknown, advance=_number(text, unknown.unit, name))
    return replace(bare, unknowns=tuple(found))


def section_of(
    problem: Problem,
    text: str,
    direction: Direction,
    passages: int = 1,
    longest: float | None = None,
    advances: Sequence[str] = (),
) -> Section:
    """A section as it is written on a command line.

    Args:
        problem: whose outputs it may name.
        text: "output", "output=value", with or without unit.
        direction: "rising" or "falling".
        passages: of a cycle.
        longest: a cycle that takes longer is none [s]; None: twice the stop time of the model.
        advances: as of `problem_of`.

    Raises:
        MechanismError: there is no such output, or the value is none of it.

    Source: R. Seydel, Practical Bifurcation and Stability Analysis, 3rd ed. (2010), sections 7.4 and 7.5.
    """
    name, _, value = text.partition("=")
    units = {output.name: output.unit for output in finely(problem, {}).outputs}
    if name not in units:
        raise MechanismError(f"There is no output {name!r} for a section; there are: {', '.join(units)}.")
    advance = dict(_pair(entry, "--advance") for entry in advances).get(name, "0")
    number, step = (_number(each, units[name], name) for each in (value or "0", advance))
    return Section(name, number, direction, passages, longest or 2.0 * problem.model.stop_time, step)


def _number(text: str, unit: str, name: str) -> float:
    """A number in an SI unit, which may be left out."""
    try:
        return float(text)
    except ValueError:
        return float(quantity(text, unit, name))


def _unknown(text: str, parameters: Mapping[str, str], outputs: Mapping[str, str]) -> Unknown:
    name, _, output = text.partition("=")
    if "." in name:
        if name not in outputs:
            known = ", ".join(other for other in outputs if other.rpartition(".")[2] in UNITS and "[" not in other)
            raise MechanismError(f"There is no {name!r} to be unknown; of bodies there are: {known}.")
        return Unknown(name, name, UNITS[name.rpartition(".")[2]])
    if name not in parameters:
        starts = ", ".join(other for other in parameters if "start" in other) or "none"
        raise MechanismError(
            f"There is no parameter {name!r} to be unknown; with 'start' in their names there are: {starts}; or name "
            "coordinates and rates of bodies, 'body.angle'."
        )
    output = output or _bare(name)
    if output not in outputs:
        raise MechanismError(
            f"{name} is compared at the end of the cycle with the output {output!r}, which is not there; write "
            f"--unknown {name}=OUTPUT with one of: {', '.join(o for o in outputs if '[' not in o)}."
        )
    if outputs[output] != parameters[name]:
        raise MechanismError(
            f"{name} in {parameters[name]} cannot be compared with {output} in {outputs[output]}; write --unknown "
            f"{name}=OUTPUT with one in {parameters[name]}."
        )
    return Unknown(name, output, parameters[name])


def _settings(model: Model, settings: Sequence[str]) -> tuple[dict[str, float], dict[str, float]]:
    """Parameters and inputs that are set, as numbers."""
    units = {p.name: p.unit for p in model.parameters}
    ports = {port.name: port for port in model.build(model.values()).inputs}
    values, inputs = {}, {}
    for name, text in (_pair(entry, "--set") for entry in settings):
        if name in ports:
            inputs[name] = _number(text, ports[name].unit, name)
        else:
            values[name] = _number(text, units.get(name, "1"), name)
    model.values(**values)
    return values, inputs


def _pair(entry: str, option: str) -> tuple[str, str]:
    name, equals, text = entry.partition("=")
    if not equals or not text:
        raise MechanismError(f"{option} {entry}: write {option} NAME=VALUE, as in {option} angle=5deg.")
    return name, text


def _bare(name: str) -> str:
    return name.removesuffix(_START)
