"""Varied parameters of a file of designs, their limits, and what all designs share."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mechanism_fmu.stress import STEEL_CARD, MaterialCard, material_card

from ..errors import UsageError
from ..fmu.description import Description, Value, Variable
from ..fmu.units import UnitMismatchError
from ..fmu.values import settable_variable
from ..run.inputs import InputSignals, read_inputs
from ..run.master import TimeGrid, nanoseconds, seconds
from ..toml_file import Section, TomlFile, as_text, is_number, parsed, time_at
from .task import MOST_DESIGNS

# What all designs of a file share: the FMU, the run, the fixed values.


@dataclass(frozen=True)
class Source:
    """Where the FMU comes from: a file, or (path is None) a ready-made model that is built."""

    path: Path | None = None
    model: str = ""


def source(file: TomlFile) -> Source:
    """The table [fmu].

    Raises:
        UsageError: the file does not say; without the FMU nothing else can be checked.
    """
    section = file.section("fmu", why='write [fmu] and below it file = "Ratchet.fmu", or model = "ratchet"')
    path, model = section.text("file"), section.text("model")
    if section.given and not file.mistakes and (path is None) == (model is None):
        section.wrong("file", 'either file = "Ratchet.fmu" or model = "ratchet" must be given, and not both')
    section.done()
    file.check()
    return Source(None if path is None else file.path.parent / path, model or "")


def shared(
    file: TomlFile, tables: Sequence[str], description: Description, other: tuple[str, str]
) -> tuple[str, Course, dict[str, Value]]:
    """What a sweep and an optimum have in common: the title, [run] and [set]; nothing else than `tables` is known.

    `other` is the table that only the other of the two has, which is also its command, and what that is called.

    Raises:
        UsageError: the file is the other's.
    """
    table, what = other
    if table in file.data:
        file.wrong((table,), f"belongs to {what}: mechanism-fmu {table} {file.path}")
        file.check()
    file.only_tables(tables)
    title = file.data.get("title", file.path.stem)
    if not isinstance(title, str):
        file.wrong(("title",), "must be a text in quotes")
    running = course(file, description)
    return str(title), running, fixed_values(file, description, running.inputs)


@dataclass(frozen=True)
class Course:
    """How each design runs.

    Attributes:
        grid: communication points; None if the file is wrong there.
        inputs: signals that drive inputs; None without a table.
        material: of the beam that impacts strike.
    """

    grid: TimeGrid | None
    inputs: InputSignals | None
    material: MaterialCard


def course(file: TomlFile, description: Description) -> Course:
    """The table [run]."""
    section = file.section("run", needed=False)
    stop_time = time_at(section, "stop_time", description.stop_time, description)
    step = time_at(section, "step", description.step, description)
    input_file, material = section.text("input"), section.text("material")
    section.done()
    card, times, inputs = STEEL_CARD, None, None
    if material is not None:
        try:
            card = material_card(material)
        except ValueError as error:
            section.wrong("material", str(error))
    if stop_time is None or step is None:
        return Course(None, None, card)
    key = "step"
    try:
        key = "stop_time" if nanoseconds(step, "step") else key
        times = TimeGrid.of(stop_time, step)
        if input_file is not None:
            key = "input"
            inputs = read_inputs(file.path.parent / input_file, description, seconds(times.start), seconds(times.stop))
    except UsageError as error:
        section.wrong(key, str(error))
    return Course(times, inputs, card)


def fixed_values(file: TomlFile, description: Description, inputs: InputSignals | None) -> dict[str, Value]:
    """The table [set]: values by name, in the units of the variables."""
    section = file.section("set", needed=False)
    values = {}
    for name in section.table:
        variable = settable(section, name, name, description, inputs)
        if variable is None:
            continue
        value = parsed(section, name, as_text(section.table[name]), variable, description)
        if value is not None:
            values[name] = value
    return values


def settable(
    section: Section, key: str, name: str, description: Description, inputs: InputSignals | None
) -> Variable | None:
    """The variable `name`, which a file sets at `key`; None when it cannot be set there."""
    try:
        variable = settable_variable(name, description)
    except UsageError as error:
        section.wrong(key, str(error))
        return None
    if inputs is not None and variable in inputs.variables:
        section.wrong(key, f"'{name}' is in the table of inputs, too (run.input); give it in one place.")
        return None
    return variable


# What is varied, and between which limits.

#: Columns of the results that no variable may have the name of.
RESERVED = ("design", "way", "status", "message", "warnings")


@dataclass(frozen=True)
class Axis:
    """One variable that is varied.

    Attributes:
        variable: it is.
        unit: of what the file says, and of charts; "" when it has none.
        low, high: limits in `unit`; both belong to it.
        values: the only values there are, in the unit of the variable; None when there are limits instead.
        grid: the values of a grid, in the unit of the variable.
        description: of the FMU.
    """

    variable: Variable
    unit: str
    low: float
    high: float
    values: tuple[Value, ...] | None
    grid: tuple[Value, ...]
    description: Description

    @property
    def name(self) -> str:
        """Of the variable."""
        return self.variable.name

    @property
    def count(self) -> float:
        """How many values there are; infinite for Real ones between limits."""
        if self.values is not None:
            return len(self.values)
        return int(self.high) - int(self.low) + 1 if self.variable.type == "Integer" else math.inf

    def at(self, fraction: float) -> Value:
        """The value at a fraction in [0, 1) of the way; whole numbers and values of a list are all equally wide."""
        if self.values is not None:
            return self.values[min(int(fraction * len(self.values)), len(self.values) - 1)]
        if self.variable.type == "Integer":
            low, high = int(self.low), int(self.high)
            return min(low + int(fraction * (high - low + 1)), high)
        return self.real(self.low + fraction * (self.high - self.low))

    def real(self, number: float) -> float:
        """A number in `unit`, kept within the limits, in the unit of the variable."""
        within = min(max(number, self.low), self.high)
        return _converted(within, self.unit, self.variable, self.description)

    def fraction(self, value: float) -> float:
        """Where a value in the unit of the variable lies between the limits, in [0, 1]."""
        low, high = self.real(self.low), self.real(self.high)
        return min(max((value - low) / (high - low), 0.0), 1.0)


def axes(
    file: TomlFile, description: Description, inputs: InputSignals | None, fixed: Sequence[str], *, grid: bool | None
) -> list[Axis]:
    """The tables [vary.NAME]; in a grid, each says how many values there are (None: not known)."""
    section = file.section("vary", why="write [vary.NAME] for each variable, with from and to, or values")
    if section.given and not section.table:
        file.wrong(("vary",), "is empty; write [vary.NAME] for each variable, with from and to, or values")
    found = []
    for name in section.table:
        axis = _axis(file.section("vary", name), name, description, inputs, fixed, grid=grid)
        if axis is not None:
            found.append(axis)
    return found


def _axis(
    section: Section,
    name: str,
    description: Description,
    inputs: InputSignals | None,
    fixed: Sequence[str],
    *,
    grid: bool | None,
) -> Axis | None:
    said = len(section.file.mistakes)
    low, high, values = section.take("from"), section.take("to"), section.take("values")
    unit, steps = section.text("unit"), section.whole("steps", least=2, most=MOST_DESIGNS)
    section.done()
    variable = _variable(section, name, description, inputs, fixed)
    if variable is None:
        return None
    by_values = values is not None
    if by_values and not (low is high is steps is None):
        section.wrong("values", "stands beside from, to or steps; give either values, or from and to")
    if not by_values:
        _check_limits_given(section, variable, low, high, steps, grid=grid)
    if is_number(low) and is_number(high) and low >= high:
        section.wrong("from", f"= {low} is not below to = {high}; exchange them, or give different limits")
    if unit is not None:
        _check_unit(section, unit, variable, description)
    if len(section.file.mistakes) > said:
        return None
    shown = unit or variable.unit
    if by_values:
        listed = _listed(section, values, unit, variable, description)
        return None if listed is None else Axis(variable, shown, 0.0, 0.0, listed, listed, description)
    limits = [_limit(section, key, given, unit, variable, description) for key, given in (("from", low), ("to", high))]
    if None in limits:
        return None
    if grid and variable.type == "Integer" and high - low >= MOST_DESIGNS:
        section.wrong("to", f"= {high} makes {high - low + 1:,} values, more than {MOST_DESIGNS:,} designs; list some")
        return None
    axis = Axis(variable, shown, float(low), float(high), None, (), description)
    return Axis(variable, shown, float(low), float(high), None, _grid(axis, steps) if grid else (), description)


def _variable(
    section: Section, name: str, description: Description, inputs: InputSignals | None, fixed: Sequence[str]
) -> Variable | None:
    parent = Section(section.file, section.key[:-1], {})
    variable = settable(parent, name, name, description, inputs)
    if name in fixed:
        parent.wrong(name, f"'{name}' is fixed in [set] and varied here; give it in one place")
    if name in RESERVED:
        parent.wrong(name, "cannot be varied: the table of results has a column of its own with that name")
    return variable


def _check_limits_given(
    section: Section, variable: Variable, low: object, high: object, steps: int | None, *, grid: bool | None
) -> None:
    if variable.type in ("Boolean", "String"):
        section.wrong("values", f"is missing; {variable.name} is {variable.type}, so its values must be listed")
        return
    for key, given in (("from", low), ("to", high)):
        if given is None:
            section.wrong(key, "is missing; give from and to, or values")
    if steps is not None and grid is False:
        section.wrong("steps", 'goes with a grid only: [sweep] method = "grid"')
    if steps is not None and variable.type == "Integer":
        section.wrong("steps", "goes with Real variables; of whole numbers a grid takes all, or those listed in values")
    if grid and steps is None and variable.type == "Real" and "steps" not in section.table:
        section.wrong("steps", "is missing; a grid needs to know how many values to take, both ends among them")


def _check_unit(section: Section, unit: str, variable: Variable, description: Description) -> None:
    if not variable.unit:
        section.wrong("unit", f"'{unit}': {variable.name} has no unit; leave it out")
        return
    try:
        description.units.convert(1.0, unit, variable.unit)
    except UnitMismatchError as mismatch:
        section.wrong("unit", f"{mismatch}.")


def _limit(
    section: Section, key: str, given: object, unit: str | None, variable: Variable, description: Description
) -> Value | None:
    if isinstance(given, str | bool):
        text = as_text(given)
        section.wrong(key, f"is '{text}', but must be a number; its unit has a key of its own, as in unit = \"deg\"")
        return None
    return parsed(section, key, _with_unit(given, unit), variable, description)


def _listed(
    section: Section, values: object, unit: str | None, variable: Variable, description: Description
) -> tuple[Value, ...] | None:
    if not isinstance(values, list) or not values:
        section.wrong("values", "must be a list, as in values = [10, 15, 20]")
        return None
    found: list[Value] = []
    for given in values:
        if isinstance(given, str) and variable.type != "String":
            section.wrong("values", f"has '{given}', which is a text; its unit has a key of its own")
            continue
        value = parsed(section, "values", _with_unit(given, unit), variable, description)
        if value is not None:
            found.append(value)
    if len(set(found)) < len(found):
        section.wrong("values", "has the same value twice; the same design would run twice")
        return None
    return tuple(found) if len(found) == len(values) else None


def _grid(axis: Axis, steps: int | None) -> tuple[Value, ...]:
    if axis.variable.type == "Integer":
        return tuple(range(int(axis.low), int(axis.high) + 1))
    return tuple(axis.real(float(number)) for number in np.linspace(axis.low, axis.high, steps or 2))


def _with_unit(value: object, unit: str | None) -> str:
    return as_text(value) if unit is None else f"{as_text(value)} {unit}"


def _converted(number: float, unit: str, variable: Variable, description: Description) -> float:
    return description.units.convert(number, unit, variable.unit) if unit else number
