"""Preparation of a machine's run: its file read, its components' FMUs found or built, and their instances."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from os.path import isfile
from pathlib import Path

import build_fmu

from ...errors import UsageError
from ...fmu import Fmu, open_fmu
from ...fmu.description import Description, hint_at
from ...fmu.description_file import read_description
from ...fmu.instances.message_log import MessageHandler
from ...fmu.instances.workspace import temporary_folder
from ...fmu.interface import Component
from ...fmu.remote import TIME_LIMIT, in_own_process
from ...machine.file.machine_plan import NO_CHANGES, Changes, ComponentPlan, Scheme, Source, changed
from ...machine.file.read_file import components, read_plan
from ...machine.observers.component_impacts import reports_impacts
from ...machine.running import Prepared
from ...machine.structure import structure_of
from ...run.inputs import read_inputs
from ...toml_file import TomlFile
from ..execution import LONG_TIME_LIMIT
from ..terminal import console

# From the file of a machine to its plan and its components' FMUs, built where need be.


def machine_file(name: str) -> Path:
    """The file of a machine: what is named, or a ready one.

    Raises:
        UsageError: there is none.
    """
    path = Path(name)
    ready = build_fmu.machines()
    if path.suffix == ".toml" or isfile(path):
        return path
    if name in ready:
        return ready[name]
    known = hint_at(name, ready) or f" Ready machines: {', '.join(ready) or 'none'}."
    raise UsageError(f"There is no machine '{name}'.{known} For your own, give its file, NAME.toml.")


@contextmanager
def prepared(
    name: str, table: Path | None = None, changes: Changes = NO_CHANGES, in_process: bool = False
) -> Iterator[Prepared]:
    """The machine of a file, or a ready one, with its FMUs extracted; they are removed afterwards.

    Args:
        name: of the file or of the ready machine.
        table: of inputs, instead of the file's own.
        changes: of the command, for this run.
        in_process: whether components of which the file does not say it have no process of their own.

    Raises:
        UsageError: there is none, or the file has mistakes, all of which are listed.
        typer.Exit: an FMU cannot be built; the reason has been said.
    """
    file = TomlFile.read(machine_file(name))
    parts = components(file, build_fmu.model_names())
    if in_process:
        parts = [replace(part, process=False) if part.process is None else part for part in parts]
    if file.mistakes:
        read_plan(file, parts, _known(file, parts))
    with ExitStack() as stack:
        fmus = {}
        built: dict[Source, Fmu] = {}
        for part in parts:
            if part.source not in built:
                built[part.source] = stack.enter_context(_fmu(part.source))
            fmus[part.name] = built[part.source]
        descriptions = {name: fmu.description for name, fmu in fmus.items()}
        plan = read_plan(file, parts, descriptions)
        plan = plan if table is None else replace(plan, inputs=table)
        whole = structure_of(descriptions, plan.connections).description
        fixed = [name for name, description in descriptions.items() if not description.varies_step]
        plan = changed(plan, changes, whole, fixed)
        inputs = (
            None if plan.inputs is None else read_inputs(plan.inputs, whole, 0.0, plan.policy.stop_time, plan.sources)
        )
        for variable in () if inputs is None else inputs.variables:
            if variable.name in plan.start_values:
                raise UsageError(f"'{variable.name}' is in {plan.inputs} and in {file.path}; give it in one place.")
        yield Prepared(plan, fmus, whole, inputs)


def _known(file: TomlFile, parts: Sequence[ComponentPlan]) -> dict[str, Description]:
    """Descriptions of those components that are FMU files: what takes no time to find out."""
    found = {}
    for part in parts:
        if part.source.path is not None and isfile(part.source.path):
            try:
                found[part.name] = read_description(part.source.path, part.source.integrator is not None)
            except UsageError as error:
                file.wrong(("component", part.name, "file"), str(error))
    return found


@contextmanager
def _fmu(source: Source) -> Iterator[Fmu]:
    if source.path is not None:
        with open_fmu(source.path, source.integrator) as fmu:
            yield fmu
        return
    with temporary_folder() as place:
        console.print(f"Building {source.model} ({source.flavour}) ...", markup=False)
        flavour = build_fmu.Flavour(source.flavour)
        path = build_fmu.built(source.model, place, flavour, source.fmi)
        build_fmu.advise(flavour)
        with open_fmu(path, source.integrator) as fmu:
            yield fmu


# Components of a machine as running instances.


@contextmanager
def instantiated(machine: Prepared, on_message: MessageHandler) -> Iterator[dict[str, Component]]:
    """An instance of each component's FMU, in a process of its own where the plan says so; all are freed afterwards.

    Where steps end at events, FMUs of FMI 3.0 that can end a step at one of their own may do so.

    Raises:
        FmuError: an FMU refuses.
    """
    with ExitStack() as stack:
        parts: dict[str, Component] = {}
        by_event = machine.plan.policy.scheme is Scheme.EVENT_AWARE
        for component in machine.plan.components:
            name, fmu = component.name, machine.fmus[component.name]
            # One that lists its impacts is taken to the first of them, which needs the list of the whole step.
            early = by_event and fmu.description.returns_early and not reports_impacts(fmu.description)
            if component.apart:
                usual = TIME_LIMIT if component.process else LONG_TIME_LIMIT
                limit = usual if component.time_limit is None else component.time_limit
                parts[name] = stack.enter_context(in_own_process(fmu, name, on_message, limit, early))
            else:
                parts[name] = stack.enter_context(fmu.instantiate(name, on_message, early))
        yield parts
