"""A machine as one FMU: fmpy's container, which knows neither gains nor offsets, and one FMU inside that does."""

from __future__ import annotations

import json
import re
import uuid
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from fmpy import container_fmu

from mechanism_fmu.fmu.disk.archive import content_hash, read_entries, write_archive
from mechanism_fmu.fmu.native.link import universal
from mechanism_fmu.fmu.parts.model_description import to_bytes

from ...errors import UsageError
from ...fmu.description import Description, Variable
from ...run.master import recorded_variables
from ..connection import Connection, Link, part_of
from ..file.machine_plan import Plan
from ..structure import in_order, structure_of
from .container_description import Exposed, container_description
from .gains import CHANNELS, NAME, factor_reference, gains_entries, guid, in_reference, offset_reference, out_reference

_BINARIES = Path(container_fmu.__file__).with_name("binaries")
_PLATFORMS = {
    "linux64": ("x86_64-linux",),
    "win64": ("x86_64-windows",),
    "darwin64": ("x86_64-darwin", "aarch64-darwin"),
}
_TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}


@dataclass(frozen=True)
class Part:
    """A component's FMU.

    Attributes:
        path: of its file.
        description: of it.
    """

    path: Path
    description: Description


def require_name(path: Path) -> None:
    """Refuse a name that is none for an FMU.

    Raises:
        UsageError: it is none.
    """
    if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", path.stem):
        raise UsageError(f"'{path.name}' is no name for an FMU; take letters, digits and _, no digit first.")


def write_container(plan: Plan, parts: Mapping[str, Part], path: Path) -> Path:
    """Wrap a machine as one FMU (FMI 2.0), which steps its components by fmpy's container: Jacobi, inputs held.

    Raises:
        UsageError: a machine that cannot be wrapped, or the disk refuses.
    """
    require_name(path)
    stem = path.stem
    descriptions = {name: part.description for name, part in parts.items()}
    machine = structure_of(descriptions).description
    connected = structure_of(descriptions, plan.connections)
    links = connected.links
    for name in descriptions:
        if descriptions[name].has_clocks:
            raise UsageError(
                f"The FMU of {name} has clocks, so it needs event mode, which fmpy's container does not use; take one "
                "without clocks (of this project: built without --clocks)."
            )
    for name in dict.fromkeys(end for link in links for end in (link.source, link.target)):
        if machine.variables[name].elements > 1:
            raise UsageError(f"{name} is an element of an array, which fmpy's container cannot connect.")
        if not _readable(machine.variables[name], parts):
            kind = machine.variables[name].fmi_type
            known = ", ".join(_TYPES.values())
            raise UsageError(f"{name} is of type {kind}, which fmpy's container cannot connect; it knows {known} only.")
    for link in links:
        kinds = [machine.variables[name].type for name in (link.source, link.target)]
        if kinds[0] != kinds[1]:
            raise UsageError(
                f"{link.source} -> {link.target}: {kinds[0]} to {kinds[1]}, which fmpy's container cannot convert. "
                "Run the machine here, or connect signals of one kind."
            )
    scaled = [link for link in links if link.factor != 1.0 or link.offset != 0.0]
    if len(scaled) > CHANNELS:
        raise UsageError(
            f"{len(scaled)} connections have a gain, an offset or another unit; at most {CHANNELS} can be."
        )
    names = list(parts)
    try:
        entries = _binaries() | _nested(parts)
        if scaled:
            nested = gains_entries(len(scaled))
            entries |= {f"resources/{NAME}/{name}": contents for name, contents in nested.items()}
        exposed = _exposed(plan, machine, parts)
        lost = plan.start_values.keys() - {each.variable.name for each in exposed}
        if lost:
            raise UsageError(
                f"The container would not have the start values of {', '.join(sorted(lost))}: fmpy's container has no "
                "texts and arrays, and of FMI 3.0 only Float64, Int32 and Boolean. Leave them out of the file."
            )
        for channel, link in enumerate(scaled):
            exposed += _of_channel(channel, link, len(names), machine)
        token = f"{{{uuid.UUID(_fingerprint(entries, plan, exposed))}}}"
        description = container_description(stem, token, plan, exposed, connected.description)
        configuration = {
            "containerVersion": container_fmu.__version__,
            "instantiationToken": token,
            "fixedStepSize": plan.policy.step,
            "parallelDoStep": False,
            "components": _components(parts, bool(scaled)),
            "variables": [_variable_of_gain(variable) for variable in exposed],
            "connections": list(_connections(plan.connections, links, scaled, names, machine)),
        }
        entries["modelDescription.xml"] = to_bytes(description)
        entries["resources/container.json"] = json.dumps(configuration, indent=1).encode()
        write_archive(entries, path, compressed=True)
    except OSError as error:
        raise UsageError(f"'{path}' cannot be written: {error}.") from error
    return path


def _binaries() -> dict[str, bytes]:
    """Fmpy's container for each platform."""
    entries = {}
    for folder, platforms in _PLATFORMS.items():
        found = [next((_BINARIES / platform).glob("container_fmu.*")) for platform in platforms]
        contents = [file.read_bytes() for file in found]
        entries[f"binaries/{folder}/{found[0].name}"] = contents[0] if len(contents) == 1 else universal(contents)
    return entries


def _folder(name: str) -> str:
    """Folder of a component; an underscore more keeps it apart from our own."""
    return f"{name}_" if name == NAME else name


def _nested(parts: Mapping[str, Part]) -> dict[str, bytes]:
    entries = {}
    for name, part in parts.items():
        for entry, contents in read_entries(part.path).items():
            if not entry.endswith("/"):
                entries[f"resources/{_folder(name)}/{entry}"] = contents
    return entries


def _components(parts: Mapping[str, Part], scaled: bool) -> list[dict[str, str]]:
    components = [
        {
            "fmiMajorVersion": f"{part.description.fmi}",
            "name": name,
            "instantiationToken": part.description.guid,
            "modelIdentifier": part.description.identifier,
            "path": _folder(name),
        }
        for name, part in parts.items()
    ]
    ours = {"fmiMajorVersion": "2", "name": f"{NAME} of connections", "instantiationToken": guid()}
    return [*components, *([{**ours, "modelIdentifier": NAME, "path": NAME}] if scaled else [])]


def _readable(variable: Variable, parts: Mapping[str, Part]) -> bool:
    """Return whether fmpy's container has functions for its type; it takes an Int64 of FMI 3.0 for an Int32."""
    fmi = parts[part_of(variable.name)].description.fmi
    known = variable.type in _TYPES if fmi == 2 else variable.fmi_type in _TYPES.values()
    return variable.elements == 1 and known


def left_out(plan: Plan, parts: Mapping[str, Part]) -> list[str]:
    """Numbers of the machine that the container does not have, because fmpy's does not know their types."""
    machine = structure_of({name: part.description for name, part in parts.items()}).description
    return [variable.name for variable in _wanted(plan, machine) if not _readable(variable, parts)]


def _wanted(plan: Plan, machine: Description) -> list[Variable]:
    """Parameters, free inputs and outputs: all that are numbers, without buffers."""
    usual = {variable.name for variable in recorded_variables(machine)}
    return [
        variable
        for variable in machine.variables.values()
        if variable.type in _TYPES and variable.name not in plan.sources
        if variable.causality == "parameter" or variable.name in usual
    ]


def _exposed(plan: Plan, machine: Description, parts: Mapping[str, Part]) -> list[Exposed]:
    """Variables of the machine that importers see, with start values."""
    names = list(parts)
    values = plan.start_values
    exposed = []
    for variable in _wanted(plan, machine):
        if _readable(variable, parts):
            start = variable.start if variable.settable else None
            if variable.name in values:
                value = values[variable.name]
                start = ("true" if value else "false") if variable.type == "Boolean" else repr(value)
            component = names.index(part_of(variable.name))
            exposed.append(Exposed(replace(variable, start=start), component, variable.reference))
    return exposed


def _of_channel(channel: int, link: Link, component: int, machine: Description) -> list[Exposed]:
    """Factor and offset of a connection, as parameters of the container."""
    unit = machine.variables[link.target].unit
    what = f"the connection from {link.source} to {link.target}"
    factor = Variable(
        f"{link.target}.factor",
        0,
        "Real",
        "parameter",
        f"Factor of {what}, conversion of units included",
        start=repr(link.factor),
    )
    offset = Variable(
        f"{link.target}.offset", 0, "Real", "parameter", f"Offset of {what}", unit=unit, start=repr(link.offset)
    )
    return [
        Exposed(factor, component, factor_reference(channel)),
        Exposed(offset, component, offset_reference(channel)),
    ]


def _variable_of_gain(exposed: Exposed) -> dict[str, Any]:
    start = exposed.variable.start
    return {
        "variableType": _TYPES[exposed.variable.type],
        "mappings": [[exposed.component, exposed.reference]],
        **({} if start is None else {"start": [start]}),
    }


def _connections(
    connections: tuple[Connection, ...],
    links: Sequence[Link],
    scaled: list[Link],
    names: list[str],
    machine: Description,
) -> list[dict[str, Any]]:
    """Connections in such an order that outputs that follow an input at once are read after it was set."""
    found = []
    for link in in_order(links, machine):
        source, target = machine.variables[link.source], machine.variables[link.target]
        first, last = (names.index(part_of(v.name)) for v in (source, target))
        if link in scaled:
            channel = scaled.index(link)
            found.append(_connection(first, source.reference, len(names), in_reference(channel)))
            found.append(_connection(len(names), out_reference(channel), last, target.reference))
        else:
            found.append(_connection(first, source.reference, last, target.reference, _TYPES[target.type]))
    return found


def _connection(source: int, output: int, target: int, entry: int, kind: str = "Float64") -> dict[str, Any]:
    return {
        "variableType": kind,
        "srcComponent": source,
        "srcValueReferences": [output],
        "dstComponent": target,
        "dstValueReferences": [entry],
        "size": 1,
    }


def _fingerprint(entries: Mapping[str, bytes], plan: Plan, exposed: list[Exposed]) -> str:
    """Hash of everything that the FMU is made from: 32 hexadecimal digits."""
    exchanged = repr((plan.title, plan.connections, plan.policy, [(e.variable, e.reference) for e in exposed]))
    return content_hash({**entries, "plan": exchanged.encode()})[:32]
