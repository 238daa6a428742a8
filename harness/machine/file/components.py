"""The tables [component.<name>]."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping
from dataclasses import replace
from os.path import isfile

from ...assignments import settable_variable
from ...description import Description, Value, hint_at
from ...errors import UsageError
from ...toml_file import Section, TomlFile
from ...toml_values import as_text, parsed, time_at
from .plan import ComponentPlan, Source

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_WRITE = 'write e.g. [component.ratchet] and below it model = "ratchet", or file = "Ratchet.fmu"'
_NO_DESCRIPTION = Description("the machine", "", "", {})


def components(file: TomlFile, models: Collection[str]) -> list[ComponentPlan]:
    """All components, without their values; mistakes are noted.

    Args:
        file: of the machine.
        models: names of the ready-made models.
    """
    tables = file.section("component", why=_WRITE)
    found = []
    for name in tables.table:
        section = file.section("component", name)
        if not _NAME.fullmatch(name):
            section.file.wrong(section.key, "is no name for a component; take letters, digits and _, no digit first")
        found.append(_component(section, name, models))
    if tables.given and not found:
        file.wrong(("component",), f"is empty; {_WRITE}")
    return found


def _component(section: Section, name: str, models: Collection[str]) -> ComponentPlan:
    path, model = section.text("file"), section.text("model")
    flavour = section.choice("flavour", ("native", "pythonfmu"))
    fmi = section.whole("fmi", least=2, most=3)
    process = section.flag_if_said("process")
    limit = None
    if section.take("time_limit") is not None:
        limit = time_at(section, "time_limit", None, _NO_DESCRIPTION)
        if limit is not None and (limit <= 0.0 or not math.isfinite(limit)):
            section.wrong("time_limit", 'must be above 0, as in time_limit = "10 s"')
        if not process:
            section.wrong("time_limit", "needs process = true: only another process can be ended when it hangs")
    section.take("set")
    section.done()
    folder = section.file.path.parent
    if not (isinstance(section.table.get("file"), str) ^ isinstance(section.table.get("model"), str)):
        section.wrong("file", 'either file = "Ratchet.fmu" or model = "ratchet" must be given, and not both')
    if path is not None:
        for key in ("flavour", "fmi"):
            if key in section.table:
                section.wrong(key, "goes with model = only; an FMU file is what it is")
        if not isfile(folder / path):
            section.wrong("file", f"there is no FMU file '{folder / path}'")
        return ComponentPlan(name, Source(folder / path), process, limit)
    model = model or ""
    if model.endswith(".py"):
        if not isfile(folder / model):
            section.wrong("model", f"there is no file '{folder / model}'")
        model = str(folder / model)
    elif model and model not in models:
        known = hint_at(model, models) or f" There are: {', '.join(models)}; or give the file of your own, NAME.py."
        section.wrong("model", f"there is no model '{model}'.{known}")
    if fmi == 3 and flavour == "pythonfmu":
        section.wrong("fmi", "3 comes in the native flavour only")
    return ComponentPlan(name, Source(None, model, flavour or "native", fmi or 2), process, limit)


def with_values(
    file: TomlFile, component: ComponentPlan, description: Description, connected: Mapping[str, str]
) -> ComponentPlan:
    """A component with its table [component.<name>.set].

    Args:
        file: of the machine.
        component: it.
        description: of its FMU.
        connected: by input of the machine, what it follows.
    """
    section = file.section("component", component.name, "set", needed=False)
    values: dict[str, Value] = {}
    for name, given in section.table.items():
        try:
            variable = settable_variable(name, description)
        except UsageError as error:
            section.wrong(name, str(error))
            continue
        source = connected.get(f"{component.name}.{name}")
        if source is not None:
            section.wrong(name, f"follows {source}, by a connection; it cannot be set as well")
            continue
        value = parsed(section, name, as_text(given), variable, description)
        if value is not None:
            values[name] = value
    return replace(component, values=values)
