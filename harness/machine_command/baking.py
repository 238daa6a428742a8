"""`machine export --baked`: copies of FMUs with numbers of their own, built as the machine's components are."""

from __future__ import annotations

from pathlib import Path

import build_fmu
from mechanism_fmu.fmu.archive import write_archive

from ..description import Description, read_description
from ..errors import UsageError
from ..machine.baking import GAINS, Baking, Numbers, baking
from ..machine.container.gains import CHANNELS, gains_entries
from ..machine.file.plan import Source
from ..machine.prepared import Prepared
from ..terminal import console


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
