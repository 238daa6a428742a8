"""A machine's file, checked as a whole against the descriptions of its components."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from os.path import isfile

from mechanism_fmu.stress import material_card

from ...errors import UsageError
from ...fmu.description import Description, Value, Variable, hint_at, not_in_step_mode
from ...fmu.instances.integration import METHODS, Integrator
from ...fmu.values import settable_variable
from ...run.inputs import read_inputs
from ...run.master import TimeGrid, nanoseconds, recorded_variables
from ...toml_file import Section, TomlFile, as_text, parsed, time_at
from ..connection import Connection
from ..observers.record import chosen
from ..part import Extrapolation
from ..structure import structure_of
from .connect_tables import bonds, connections
from .machine_plan import ComponentPlan, Plan, Policy, Recording, Scheme, Source, usual_format

# The tables [component.<name>].

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
    integrator = _integrator(section)
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
        return ComponentPlan(name, Source(folder / path, integrator=integrator), process, limit)
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
    if integrator is not None and flavour == "pythonfmu":
        section.wrong("integrator", "needs Model Exchange, which comes in the native flavour only")
    return ComponentPlan(name, Source(None, model, flavour or "native", fmi or 2, integrator), process, limit)


def _integrator(section: Section) -> Integrator | None:
    """What integrates a component by its interface for Model Exchange; None: it is used for co-simulation."""
    method = section.choice("integrator", METHODS)
    said = "tolerance" in section.table
    tolerance = section.number("tolerance", Integrator().relative_tolerance)
    if method is None:
        if said and "integrator" not in section.table:
            section.wrong("tolerance", 'goes with integrator = only, e.g. integrator = "DOP853"')
        return None
    try:
        return Integrator(method, Integrator().relative_tolerance if tolerance is None else tolerance)
    except UsageError as error:
        section.wrong("tolerance", str(error))
        return None


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


# The tables [run] and [record].

_TOLERANCE = 1e-4


def read_policy(file: TomlFile) -> tuple[Policy | None, Section]:
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


def read_material(section: Section) -> str:
    """The steel in [run]."""
    name = section.text("material") or "steel"
    try:
        material_card(name)
    except ValueError as error:
        section.wrong("material", str(error))
    return name


def read_recording(file: TomlFile, description: Description, complete: bool) -> Recording:
    """What is kept; mistakes are noted.

    Args:
        file: of the machine.
        description: of the machine, of those components that could be described.
        complete: whether these are all.
    """
    section = file.section("record", needed=False)
    signals = section.texts("signals") or ["*"]
    every = section.whole("every", least=1) or 1
    kind = section.choice("format", ("parquet", "csv")) or usual_format()
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


TABLES = ("title", "component", "connect", "bond", "run", "record")


def read_plan(file: TomlFile, components: Sequence[ComponentPlan], descriptions: Mapping[str, Description]) -> Plan:
    """The machine of a file.

    Args:
        file: in which mistakes may have been found already.
        components: of the file (`components`).
        descriptions: of their FMUs; those that are missing are not checked, and then the file must have mistakes.

    Raises:
        UsageError: mistakes in the file, all of them.
    """
    file.only_tables(TABLES)
    title = file.data.get("title", file.path.stem)
    if not isinstance(title, str):
        file.wrong(("title",), "must be a text in quotes")
    whole = structure_of(descriptions).description
    complete = len(descriptions) == len(components)
    names = [component.name for component in components]
    connected = connections(file, whole, descriptions, names)
    bonded = bonds(file, connected, complete and len(connected) == len(file.sections("connect")))
    sources = {connection.target: connection.source for connection in connected}
    components = [
        with_values(file, component, descriptions[component.name], sources)
        if component.name in descriptions
        else component
        for component in components
    ]
    policy, section = read_policy(file)
    machine = structure_of(descriptions, _one_each(connected)).description if complete else whole
    table, driven = input_table(section, machine, policy.stop_time if policy else None, sources)
    material = read_material(section)
    section.done()
    for component in components:
        for name in component.values:
            if f"{component.name}.{name}" in driven:
                key = ("component", component.name, "set", name)
                file.wrong(key, f"is in the table of inputs, too (run.input = '{table}'); give it in one place")
    recording = read_recording(file, machine, complete)
    if policy is not None:
        _check_policy(file, policy, descriptions)
    _check_processes(file, components, descriptions)
    file.check()
    assert policy is not None  # otherwise there were mistakes
    inputs = None if table is None else file.path.parent / table
    return Plan(str(title), tuple(components), tuple(connected), tuple(bonded), policy, recording, inputs, material)


def _one_each(connected: Sequence[Connection]) -> list[Connection]:
    """The first connection of each input."""
    return list({connection.target: connection for connection in reversed(connected)}.values())


def _check_policy(file: TomlFile, policy: Policy, descriptions: Mapping[str, Description]) -> None:
    stiff = [name for name, description in descriptions.items() if not description.saves_state]
    if policy.scheme is Scheme.ADAPTIVE and stiff:
        file.wrong(
            ("run", "algorithm"),
            f"= 'adaptive' needs components that can be put back (canGetAndSetFMUstate), but {', '.join(stiff)} "
            "cannot; take jacobi or gauss_seidel",
        )
    fixed = ", ".join(name for name, description in descriptions.items() if not description.varies_step)
    flag = "(canHandleVariableCommunicationStepSize)"
    if fixed and policy.scheme in (Scheme.ADAPTIVE, Scheme.EVENT_AWARE):
        file.wrong(
            ("run", "algorithm"),
            f"= '{policy.scheme}' takes steps of different sizes, which {fixed} cannot {flag}; "
            'take algorithm = "jacobi" or "gauss_seidel"',
        )
    elif fixed and not TimeGrid.of(policy.stop_time, policy.step).even:
        file.wrong(
            ("run", "stop_time"),
            f"is no multiple of the step, so that the last step is shorter, which {fixed} cannot take {flag}",
        )


def _check_processes(
    file: TomlFile, components: Sequence[ComponentPlan], descriptions: Mapping[str, Description]
) -> None:
    """FMUs of which a process can have one instance only."""
    first: dict[tuple[str, str], str] = {}
    for component in components:
        description = descriptions.get(component.name)
        if description is None or component.apart or not description.once_per_process:
            continue
        other = first.setdefault((description.identifier, description.guid), component.name)
        if other != component.name:
            file.wrong(
                ("component", component.name),
                f"is the same FMU as {other}, and a process can have one of it only "
                "(canBeInstantiatedOnlyOncePerProcess); write process = true below it",
            )
