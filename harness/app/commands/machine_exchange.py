"""`machine export`, `import` and `container`: machines for other tools, and from them."""

from __future__ import annotations

import os
import re
from pathlib import Path

from rich.markup import escape

import build_fmu
from mechanism_fmu.fmu.disk.archive import write_archive

from ...errors import UsageError
from ...fmu.description import Description
from ...fmu.description_file import read_description
from ...fmu.instances.message_log import discard_message
from ...fmu.instances.workspace import temporary_folder
from ...machine.file.machine_plan import Scheme, Source
from ...machine.formats.baking import GAINS, Baking, Numbers, baking
from ...machine.formats.container import Part, left_out, require_name, write_container
from ...machine.formats.gains import CHANNELS, gains_entries
from ...machine.formats.ssp_export import identifier, write_ssp
from ...machine.formats.ssp_import import import_ssp
from ...machine.machine import Machine
from ...machine.part import Extrapolation
from ...machine.running import Prepared
from ...machine.structure import structure_of
from ...run.results import prepare_folder, write_bytes
from ..terminal import console, show_note
from .machine_ready import instantiated, machine_file, prepared

# `machine export --baked`: copies of FMUs with numbers of their own, built as the machine's components are.


def baked_machine(machine: Prepared, place: Path) -> tuple[Baking, dict[str, tuple[Path, Description]]]:
    """A machine for tools that apply neither parameters nor transformations, and the FMUs of its components.

    Args:
        machine: as it is.
        place: folder for new FMUs.

    Raises:
        UsageError: there are more gains than a component of them has channels, or no linker for it.
        typer.Exit: an FMU cannot be built; the reason has been said.
    """
    sources = {component.name: component.source for component in machine.plan.components}
    makers = {name: _maker(source, machine.fmus[name].description) for name, source in sources.items()}
    own = {name: maker for name, maker in makers.items() if maker is not None}
    found = baking(machine.plan, machine.descriptions, own)
    files = {}
    for name, fmu in machine.fmus.items():
        path = _copy(name, own[name], found.numbers[name], place) if name in found.numbers else fmu.path
        files[name] = (path, read_description(path))
    if found.gains:
        if len(found.gains) > CHANNELS:
            raise UsageError(f"{len(found.gains)} inputs of other tools' FMUs need a gain; at most {CHANNELS} can be.")
        path = place / f"{GAINS}.fmu"
        given = tuple((link.factor, link.offset) for link in found.gains)
        write_archive(gains_entries(len(given), given), path)
        files[GAINS] = (path, read_description(path))
    return found, files


def _maker(source: Source, description: Description) -> Source | None:
    """What an FMU is built from here; None if it is not of this project, or of another version of it."""
    if source.path is None:
        return source
    flavour = "pythonfmu" if "pythonfmu" in description.generation_tool else "native"
    model = build_fmu.model_with_guid(description.model, description.guid, build_fmu.Flavour(flavour), description.fmi)
    return None if model is None else Source(None, model, flavour, description.fmi)


def _copy(name: str, source: Source, numbers: Numbers, place: Path) -> Path:
    console.print(f"Building {source.model} ({source.flavour}) with the numbers of {name} ...", markup=False)
    flavour = build_fmu.Flavour(source.flavour)
    return build_fmu.built(
        source.model, place / name, flavour, source.fmi, starts=numbers.starts, inputs=numbers.inputs
    )


#: What held inputs do to shafts.
_HELD = (
    "Where an angle leads a turning shaft, a held one lags by half a step, and the torque is off by stiffness x speed "
    'x step / 2: see the energy over bonds of a run with algorithm = "jacobi" and extrapolation = "constant", and '
    "choose the step by it (docs/how-to/machines.md)."
)


def export_file(name: str, output: Path | None, baked: bool = False) -> int:
    """Write a machine as SSP, and say what other tools will not do alike.

    Args:
        name: of the machine's file, or of a ready one.
        output: file to write; None: named after the machine's.
        baked: whether parameters, gains and offsets go into copies of the FMUs.
    """
    output = Path(f"{machine_file(name).stem}.ssp") if output is None else output
    with prepared(name) as machine:
        prepare_folder(output.parent)
        if baked:
            with temporary_folder() as place:
                found, files = baked_machine(machine, place)
                write_ssp(found.plan, files, output, by_name=True)
            notes = list(found.notes)
        else:
            files = {part: (fmu.path, fmu.description) for part, fmu in machine.fmus.items()}
            write_ssp(machine.plan, files, output)
            notes = _needs(machine)
        for note in [*notes, *_for_others(machine), *_first_inputs(machine)]:
            show_note(note)
    console.print(f"Written: {escape(str(output))}", soft_wrap=True)
    return 0


def import_file(path: Path, folder: Path | None) -> int:
    """Write the machine of an SSP file, check it, and say how to run it.

    All files come at once, when it has no mistakes, and replace none.
    """
    folder = Path(path.stem) if folder is None else folder
    with temporary_folder() as place:
        try:
            found = import_ssp(path, place)
            for note in found.notes:
                show_note(note)
            with prepared(str(found.file)):
                pass
        except UsageError as error:  # what is in the folder will be gone
            reason = str(error).replace(f"{place}{os.sep}", "")
            raise UsageError(reason if f"'{path}'" in reason else f"'{path}' was not imported: {reason}") from error
        _move(place, folder)
    console.print(f"Written to {escape(str(folder))}: {escape(found.file.name)} and its FMUs.", soft_wrap=True)
    console.print(f"mechanism-fmu machine run {folder / found.file.name}", soft_wrap=True, markup=False)
    return 0


def _move(place: Path, folder: Path) -> None:
    """Move all files of one folder into another one, the machine's last.

    Raises:
        UsageError: some are there already, or the disk refuses; then none was moved.
    """
    files = sorted(place.iterdir(), key=lambda file: file.suffix == ".toml")
    there = [file.name for file in files if (folder / file.name).exists()]
    if there:
        raise UsageError(
            f"'{folder}' has {', '.join(there)} already, and nothing is overwritten. Choose another folder with -o, or "
            "move them away."
        )
    prepare_folder(folder)
    written: list[Path] = []
    try:
        for file in files:
            written.append(write_bytes(folder / file.name, file.read_bytes()))
    except UsageError:
        for file in written:
            file.unlink()
        raise


def _for_others(machine: Prepared) -> list[str]:
    """What a tool that reads the SSP file does not know of a machine."""
    plan = machine.plan
    notes = []
    if plan.policy.scheme is not Scheme.JACOBI:
        notes.append(f"Other tools step as they do; algorithm = '{plan.policy.scheme}' is known to this one only.")
    if plan.policy.extrapolation is not Extrapolation.CONSTANT:
        notes.append(f"Most tools hold inputs during a step. {_HELD}")
    newer = [name for name, description in machine.descriptions.items() if description.fmi == 3]
    if newer:
        notes.append(
            f"Of FMI 3.0 are {', '.join(newer)}, which libcosim and fmpy's simulate_ssp do not run; take fmi = 2 for "
            "these two."
        )
    if plan.inputs is not None:
        notes.append(f"No tool reads the table of inputs that goes with it: {plan.inputs.name}.")
    return notes


def _needs(machine: Prepared) -> list[str]:
    """Which tools a plain file is for."""
    links = structure_of(machine.descriptions, machine.plan.connections).links
    has = {
        "parameters": bool(machine.plan.start_values),
        "gains, offsets or conversions of units": any((x.factor, x.offset) != (1.0, 0.0) for x in links),
    }
    what = " and ".join(name for name, there in has.items() if there)
    if not what:
        return []
    return [
        f"The file has {what}: it is for tools that apply them, as libcosim does, and ecos if its init is given "
        f'parameter_set="{identifier(machine.plan.title)}". fmpy and the container of fmu-manipulation-toolbox leave '
        "them out without a word: for these, --baked puts them into copies of the FMUs."
    ]


def _first_inputs(machine: Prepared) -> list[str]:
    """Where fmpy's first step is another one: it gives 0 to all inputs."""
    with instantiated(machine, discard_message) as parts:
        whole = Machine(parts, machine.plan.connections)
        whole.set(machine.plan.start_values)
        whole.initialize(0.0, machine.plan.policy.stop_time)
        sources = [link.source for link in whole.structure.links if link.type not in ("String", "Binary")]
        moved = [name for name, value in zip(sources, whole.get(sources), strict=True) if value]
    if not moved:
        return []
    return [
        "fmpy's simulate_ssp gives 0 to all inputs in its first step, but the machine does not start from rest: not 0 "
        f"at the start are {', '.join(dict.fromkeys(moved))}. Its curves will be others; docs/examples/ssp_in_fmpy.py "
        "runs the plain file there as it is meant."
    ]


def contain_file(name: str, output: Path | None) -> int:
    """Wrap a machine as one FMU, and say what it does otherwise than the machine."""
    output = _fmu_name(machine_file(name)) if output is None else output
    require_name(output)
    with prepared(name) as machine:
        prepare_folder(output.parent)
        parts = {part: Part(fmu.path, fmu.description) for part, fmu in machine.fmus.items()}
        write_container(machine.plan, parts, output)
        policy = machine.plan.policy
        if policy.scheme is not Scheme.JACOBI or policy.extrapolation is not Extrapolation.CONSTANT:
            show_note(
                f"The container steps all components at once, {policy.step:g} s at a time, with inputs held "
                f'(algorithm = "jacobi", extrapolation = "constant"). {_HELD}'
            )
        lost = left_out(machine.plan, parts)
        if lost:
            show_note(
                f"Not in the container, which has numbers of types Float64, Int32 and Boolean only: {', '.join(lost)}."
            )
        if machine.plan.inputs is not None:
            show_note(f"The table of inputs does not go with it: run it with --input {machine.plan.inputs.name}.")
    console.print(f"Written: {escape(str(output))}", soft_wrap=True)
    console.print(f"mechanism-fmu run {output}", soft_wrap=True, markup=False)
    return 0


def _fmu_name(machine: Path) -> Path:
    """A name for an FMU like that of a machine's file: letters, digits and _, no digit first."""
    plain = re.sub(r"\W", "_", machine.stem, flags=re.ASCII)
    return Path(f"_{plain}.fmu" if plain[:1].isdigit() else f"{plain}.fmu")
