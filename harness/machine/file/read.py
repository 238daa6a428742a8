"""A machine's file, checked as a whole against the descriptions of its components."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...clock import TimeGrid
from ...description import Description
from ...toml_file import TomlFile
from ..connection import Connection
from ..structure import structure_of
from . import running
from .components import with_values
from .connections import bonds, connections
from .plan import ComponentPlan, Plan, Policy, Scheme

TABLES = ("title", "component", "connect", "bond", "run", "record")


def read_plan(file: TomlFile, components: Sequence[ComponentPlan], descriptions: Mapping[str, Description]) -> Plan:
    """The machine of a file.

    Args:
        file: in which mistakes may have been found already.
        components: of the file (`components.components`).
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
    policy, section = running.policy(file)
    machine = structure_of(descriptions, _one_each(connected)).description if complete else whole
    table, driven = running.input_table(section, machine, policy.stop_time if policy else None, sources)
    material = running.material(section)
    section.done()
    for component in components:
        for name in component.values:
            if f"{component.name}.{name}" in driven:
                key = ("component", component.name, "set", name)
                file.wrong(key, f"is in the table of inputs, too (run.input = '{table}'); give it in one place")
    recording = running.recording(file, machine, complete)
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
