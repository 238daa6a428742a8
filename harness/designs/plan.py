"""What all designs of a file share: the FMU, the run, the fixed values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mechanism_fmu.stress import STEEL_CARD, MaterialCard, material_card

from ..assignments import settable_variable
from ..clock import TimeGrid, nanoseconds, seconds
from ..description import Description, Value, Variable
from ..errors import UsageError
from ..inputs import InputSignals, read_inputs
from ..toml_file import Section, TomlFile
from ..toml_values import as_text, parsed, time_at


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


def shared(file: TomlFile, tables: Sequence[str], description: Description) -> tuple[str, Course, dict[str, Value]]:
    """What a sweep and an optimum have in common: the title, [run] and [set]; nothing else than `tables` is known."""
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
