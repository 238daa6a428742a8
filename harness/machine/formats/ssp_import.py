"""Import of an SSP file (.ssp): a folder with a machine's file and its FMUs."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from ...errors import UsageError
from ...fmu.description import Description, Value
from ...fmu.description_file import read_description
from ...fmu.values import parse_value, settable_variable
from ...run.results import write_bytes, write_text
from ..connection import Connection, kind_of, linked
from ..file.machine_plan import ComponentPlan, Plan, Policy, Recording, Source
from ..file.write_file import machine_toml
from ..structure import structure_of
from . import ssp_xml
from .ssp_structure import SspComponent, SspConnection, Structure, read_structure

#: Of a system that does not say: so many steps.
_STEPS = 1000
_STOP_TIME = 1.0


@dataclass(frozen=True)
class Imported:
    """What came of an import.

    Attributes:
        file: of the machine.
        plan: it.
        notes: what could not be taken over, and what was assumed.
    """

    file: Path
    plan: Plan
    notes: tuple[str, ...]


def import_ssp(path: Path, folder: Path) -> Imported:
    """Write the machine of an .ssp file into a folder.

    Raises:
        UsageError: it cannot be, or the disk refuses.
    """
    try:
        return _imported(read_structure(path), path, folder)
    except (ValueError, KeyError) as error:
        raise UsageError(f"'{path}' is no SSP 1.0 file, or a damaged one: {error}.") from error


def _imported(structure: Structure, path: Path, folder: Path) -> Imported:
    notes = list(structure.left_out)
    files: dict[str, Path] = {}
    for source in dict.fromkeys(component.source for component in structure.components.values()):
        name = PurePosixPath(source).name
        name = f"{len(files) + 1}_{name}" if folder / name in files.values() else name
        files[source] = write_bytes(folder / name, structure.entries[source])
    names = _names(structure, notes)
    descriptions = {names[c.name]: read_description(files[c.source]) for c in structure.components.values()}
    connected = {connection.target: connection.source for connection in structure.connections}
    components = tuple(
        ComponentPlan(
            names[c.name],
            Source(files[c.source]),
            c.process,
            c.time_limit,
            _values(c, descriptions[names[c.name]], connected, notes),
        )
        for c in structure.components.values()
    )
    machine = structure_of(descriptions).description
    connections = tuple(_connection(c, names, machine) for c in structure.connections)
    plan = _plan(structure, components, connections, descriptions, folder, notes)
    file = folder / f"{path.stem}.toml"
    text = machine_toml(plan, descriptions, folder, [f"Imported from {path.name}.", *notes])
    return Imported(write_text(file, lambda out: out.write(text)), plan, tuple(notes))


def _names(structure: Structure, notes: list[str]) -> dict[str, str]:
    """Names of components in a machine's file, which takes letters, digits and _."""
    names: dict[str, str] = {}
    for name in structure.components:
        plain = re.sub(r"\W", "_", name, flags=re.ASCII)
        plain = f"_{plain}" if plain[:1].isdigit() or not plain else plain
        while plain in names.values():
            plain += "_"
        if plain != name:
            notes.append(f"The component '{name}' is called {plain} here.")
        names[name] = plain
    return names


def _values(
    component: SspComponent, description: Description, connected: Mapping[str, str], notes: list[str]
) -> dict[str, Value]:
    """Start values; those of inputs that are `connected`, by what they follow, mean nothing here."""
    values: dict[str, Value] = {}
    for name, parameter in component.parameters.items():
        source = connected.get(f"{component.name}.{name}")
        if source is not None:
            notes.append(f"{component.name}: the start value of '{name}' was left out, for it follows {source}.")
            continue
        unit = f" {parameter.unit}" if parameter.unit and parameter.unit != "1" else ""
        try:
            variable = settable_variable(name, description)
            values[name] = parse_value(f"{parameter.text}{unit}", variable, description)
        except UsageError as error:
            notes.append(f"{component.name}: {error}")
    return values


def _connection(connection: SspConnection, names: Mapping[str, str], machine: Description) -> Connection:
    """A connection, with its gain and offset apart from the conversion of units.

    Raises:
        UsageError: it cannot be.
    """
    (first, _, output), (second, _, entry) = connection.source.partition("."), connection.target.partition(".")
    source, target = f"{names[first]}.{output}", f"{names[second]}.{entry}"
    rate, convert = connection.rate, connection.convert or _kinds_differ(source, target, machine)
    plain = Connection(source, target, rate=rate, convert=convert)
    unit = linked(plain, machine)
    if connection.gain is not None and connection.own_offset is not None:
        ours = Connection(source, target, connection.gain, connection.own_offset, rate, convert)
        link = linked(ours, machine)
        if (link.factor, link.offset) == (connection.factor, connection.offset):
            return ours
    if connection.converts:
        return Connection(source, target, connection.factor, connection.offset, rate, convert)
    gain = connection.factor / unit.factor
    return Connection(source, target, gain, connection.offset - gain * unit.offset, rate, convert)


def _kinds_differ(source: str, target: str, machine: Description) -> bool:
    """Whether a file of another tool connects a Boolean, say, with an Integer; `linked` says whether that can be."""
    ends = [machine.variables.get(name) for name in (source, target)]
    return None not in ends and len({kind_of(end) for end in ends if end is not None}) == 2


def _plan(
    structure: Structure,
    components: tuple[ComponentPlan, ...],
    connections: tuple[Connection, ...],
    descriptions: Mapping[str, Description],
    folder: Path,
    notes: list[str],
) -> Plan:
    stop_time = structure.stop_time
    if stop_time is None:
        stop_time = max((d.stop_time for d in descriptions.values() if d.stop_time), default=_STOP_TIME)
        notes.append(f"The system does not say how long it runs: stop_time = {stop_time:g} s was taken.")
    ours = ssp_xml.machine_element(structure.root)
    if ours is not None:
        inputs = ours.get("inputs")
        table = None
        if inputs is not None and inputs in structure.entries:
            table = write_bytes(folder / PurePosixPath(inputs).name, structure.entries[inputs])
        policy, recording = ssp_xml.read_policy(ours, stop_time), ssp_xml.read_recording(ours)
        bonds = ssp_xml.read_bonds(ours, connections)
        material = ours.get("material", "steel")
        return Plan(structure.title, components, connections, bonds, policy, recording, table, material)
    step = structure.step
    if step is None:
        step = min((d.step for d in descriptions.values() if d.step), default=stop_time / _STEPS)
        notes.append(f"The system does not say how it steps: step = {step:g} s was taken.")
    return Plan(structure.title, components, connections, (), Policy(stop_time, step), Recording())
