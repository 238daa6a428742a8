"""A machine's file from its plan, and one to begin with."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from ...errors import UsageError
from ...fmu.description import Description, Value, Variable
from ..connection import Connection
from .machine_plan import ComponentPlan, Plan


def machine_toml(plan: Plan, descriptions: Mapping[str, Description], folder: Path, notes: Sequence[str] = ()) -> str:
    """The file that says what the plan does; numbers read back as the same.

    Args:
        plan: the machine.
        descriptions: of its components' FMUs, for units.
        folder: where the file will be; FMUs in it are named from there.
        notes: comments at the top.
    """
    blocks = ["\n".join(f"# {line}" for line in notes)] if notes else []
    blocks += [_pair("title", plan.title), _run(plan, folder)]
    for component in plan.components:
        blocks += _component(component, descriptions[component.name], folder)
    blocks += [_connection(connection, descriptions) for connection in plan.connections]
    for bond in plan.bonds:
        ends: dict[str, object] = {"name": bond.name, "flow": bond.flow.target, "effort": bond.effort.target}
        blocks.append(_table("[[bond]]", {**ends, "reaction": True} if bond.reaction else ends))
    recording = plan.recording
    record = {"signals": list(recording.signals), "every": recording.every, "format": recording.format}
    blocks.append(_table("[record]", record))
    return "\n\n".join(blocks) + "\n"


def _run(plan: Plan, folder: Path) -> str:
    policy = plan.policy
    run: dict[str, object] = {
        "stop_time": policy.stop_time,
        "step": policy.step,
        "algorithm": policy.scheme.value,
        "extrapolation": policy.extrapolation.value,
    }
    if policy.tolerance is not None:
        run["tolerance"] = policy.tolerance
    if plan.inputs is not None:
        run["input"] = _relative(plan.inputs, folder)
    return _table("[run]", {**run, "material": plan.material})


def _component(component: ComponentPlan, description: Description, folder: Path) -> list[str]:
    source = component.source
    table: dict[str, object] = {}
    if source.path is not None:
        table["file"] = _relative(source.path, folder)
    else:
        table |= {"model": source.model, "flavour": source.flavour, "fmi": source.fmi}
    if source.integrator is not None:
        table |= {"integrator": source.integrator.method, "tolerance": source.integrator.relative_tolerance}
    if component.process is not None:
        table["process"] = component.process
    if component.time_limit is not None:
        table["time_limit"] = component.time_limit
    blocks = [_table(f"[component.{component.name}]", table)]
    if component.values:
        values = {name: _with_unit(value, description.variables[name]) for name, value in component.values.items()}
        blocks.append(_table(f"[component.{component.name}.set]", values))
    return blocks


def _connection(connection: Connection, descriptions: Mapping[str, Description]) -> str:
    table: dict[str, object] = {"from": connection.source, "to": connection.target}
    if connection.gain != 1.0:
        table["gain"] = connection.gain
    if connection.offset != 0.0:
        part, _, name = connection.target.partition(".")
        table["offset"] = _with_unit(connection.offset, descriptions[part].variables[name])
    if connection.rate:
        table["rate"] = connection.rate
    if connection.convert:
        table["convert"] = True
    return _table("[[connect]]", table)


def _with_unit(value: Value, variable: Variable) -> Value:
    if variable.type != "Real":
        return value
    return f"{float(value)!r} {variable.unit}" if variable.unit else float(value)


def _relative(path: Path, folder: Path) -> str:
    return path.relative_to(folder).as_posix() if path.is_relative_to(folder) else str(path)


def _table(heading: str, values: Mapping[str, object]) -> str:
    return "\n".join([heading, *(_pair(name, value) for name, value in values.items())])


def _pair(name: str, value: object) -> str:
    plain = name.replace("_", "").replace("-", "")
    key = name if plain.isascii() and plain.isalnum() else json.dumps(name)
    return f"{key} = {_toml(value)}"


def _toml(value: object) -> str:
    """A value; a text as JSON has it, which TOML reads alike."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


# A machine's file to begin with.

_TEMPLATE = Path(__file__).with_name("template.txt")


def write_new(name: str, folder: Path) -> Path:
    """Write a machine that runs, for the user to change, as `<name>.toml`.

    Args:
        name: of the file, and the machine's title; an identifier, because exported files are named so.
        folder: where to.

    Raises:
        UsageError: no such name, there is such a file, or the disk refuses.
    """
    name = name.removesuffix(".toml")
    if not re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII):
        better = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_") or "machine"
        better = f"my_{better}" if better[0].isdigit() else better
        raise UsageError(
            f"'{name}' cannot name a machine; use the letters a to z, digits and '_', for example: "
            f"mechanism-fmu machine new {better}"
        )
    path = folder / f"{name}.toml"
    try:
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(_TEMPLATE.read_text(encoding="utf-8").replace("NAME", name))
    except FileExistsError:
        raise UsageError(f"'{path}' is there already; give another name, or remove it first.") from None
    except OSError as error:
        raise UsageError(f"'{path}' cannot be written: {error}.") from error
    return path
