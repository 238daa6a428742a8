"""The tables [run] and [record]."""

from __future__ import annotations

from collections.abc import Mapping

from mechanism_fmu.stress import material_card

from ...clock import TimeGrid, nanoseconds
from ...description import Description, Variable, hint_at, not_in_step_mode
from ...errors import UsageError
from ...inputs import read_inputs
from ...recorder import recorded_variables
from ...toml_file import Section, TomlFile
from ...toml_values import time_at
from ..extrapolation import Extrapolation
from ..recorded import chosen
from .plan import Policy, Recording, Scheme

_TOLERANCE = 1e-4
_NO_DESCRIPTION = Description("the machine", "", "", {})


def policy(file: TomlFile) -> tuple[Policy | None, Section]:
    """How the machine steps, None if the file is wrong there; and the table [run], for what else is in it."""
    section = file.section("run", why='write [run] and below it stop_time = "10 s" and step = "5 ms"')
    times: list[float | None] = [None, None]
    if section.given:
        times = [time_at(section, name, None, _NO_DESCRIPTION) for name in ("stop_time", "step")]
    scheme = section.choice("algorithm", [scheme.value for scheme in Scheme]) or Scheme.EVENT_AWARE.value
    extrapolation = section.choice("extrapolation", [kind.value for kind in Extrapolation])
    tolerance = None
    if scheme == Scheme.ADAPTIVE:
        tolerance = section.number("tolerance", _TOLERANCE)
        if tolerance is not None and not 0.0 < tolerance < 1.0:
            section.wrong("tolerance", f"is {tolerance:g}, but must be above 0 and below 1, as in tolerance = 1e-4")
    elif section.take("tolerance") is not None:
        section.wrong("tolerance", f'goes with algorithm = "{Scheme.ADAPTIVE}" only')
    stop_time, step = times
    if stop_time is None or step is None:
        return None, section
    key = "step"
    try:
        key = "stop_time" if nanoseconds(step, "step") else key
        TimeGrid.of(stop_time, step)
    except UsageError as error:
        section.wrong(key, str(error))
        return None, section
    kind = Extrapolation(extrapolation) if extrapolation else Extrapolation.DERIVATIVES
    return Policy(stop_time, step, Scheme(scheme), kind, tolerance), section


def input_table(
    section: Section, description: Description, stop_time: float | None, followed: Mapping[str, str]
) -> tuple[str | None, set[str]]:
    """The file of input signals in [run], None if there is none or it is wrong, and the inputs that it drives."""
    name = section.text("input")
    if name is None or stop_time is None:
        return name, set()
    try:
        signals = read_inputs(section.file.path.parent / name, description, 0.0, stop_time, followed)
    except UsageError as error:
        section.wrong("input", str(error))
        return None, set()
    return name, {variable.name for variable in signals.variables}


def material(section: Section) -> str:
    """The steel in [run]."""
    name = section.text("material") or "steel"
    try:
        material_card(name)
    except ValueError as error:
        section.wrong("material", str(error))
    return name


def recording(file: TomlFile, description: Description, complete: bool) -> Recording:
    """What is kept; mistakes are noted.

    Args:
        file: of the machine.
        description: of the machine, of those components that could be described.
        complete: whether these are all.
    """
    section = file.section("record", needed=False)
    signals = section.texts("signals") or ["*"]
    every = section.whole("every", least=1) or 1
    kind = section.choice("format", ("parquet", "csv")) or "parquet"
    section.done()
    if complete:
        for signal in signals:
            if not chosen([signal], description):
                section.wrong("signals", _nothing(signal, description))
    return Recording(tuple(signals), every, kind)


def _nothing(signal: str, description: Description) -> str:
    known: list[Variable] = recorded_variables(description)
    names = [variable.name for variable in known]
    named = description.variables.get(signal)
    if named is not None and named.in_event_mode_only:
        return f"{not_in_step_mode(named)}{hint_at(signal, names)}"
    if named is not None:
        return f"'{signal}' is a text, which is not recorded"
    return f"'{signal}' is no variable of the machine, and no pattern that fits one.{hint_at(signal, names)}"
