"""`machine export`, `import` and `container`: machines for other tools, and from them."""

from __future__ import annotations

import os
import re
from pathlib import Path

from rich.markup import escape

from ..errors import UsageError
from ..fmu.workspace import temporary_folder
from ..machine.container.write import Part, left_out, require_name, write_container
from ..machine.extrapolation import Extrapolation
from ..machine.file.plan import Scheme
from ..machine.prepared import Prepared
from ..machine.ssp.export import write_ssp
from ..machine.ssp.importing import import_ssp
from ..results import prepare_folder, write_bytes
from ..terminal import console, show_note
from .prepare import machine_file, prepared

#: What held inputs do to shafts.
_HELD = (
    "Where an angle leads a turning shaft, a held one lags by half a step, and the torque is off by stiffness x speed "
    'x step / 2: see the energy over bonds of a run with algorithm = "jacobi" and extrapolation = "constant", and '
    "choose the step by it (docs/machines.md)."
)


def export_file(name: str, output: Path | None) -> int:
    """Write a machine as SSP, and say what other tools will not do alike."""
    output = Path(f"{machine_file(name).stem}.ssp") if output is None else output
    with prepared(name) as machine:
        prepare_folder(output.parent)
        files = {part: (fmu.path, fmu.description) for part, fmu in machine.fmus.items()}
        write_ssp(machine.plan, files, output)
        for note in _for_others(machine):
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
            told = str(error).replace(f"{place}{os.sep}", "")
            raise UsageError(told if f"'{path}'" in told else f"'{path}' was not imported: {told}") from error
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
    if any(connection.gain != 1.0 or connection.offset != 0.0 for connection in plan.connections):
        notes.append(
            "fmpy's simulate_ssp leaves out gains and offsets of connections (docs/machines.md); libcosim has them."
        )
    return notes


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
