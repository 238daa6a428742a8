"""Command: build the FMU of a model."""

from __future__ import annotations

import time
import zipfile
from pathlib import Path
from typing import Annotated
from xml.etree import ElementTree

import typer
from rich.console import Console

import models
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.model import MechanismError

_USAGE_ERROR = 2


def build(
    model: Annotated[
        str | None, typer.Argument(help="Name of a model, e.g. 'ratchet'; see --list.", show_default=False)
    ] = None,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Folder for the FMU; it is made if need be.", file_okay=False)
    ] = Path("build"),
    show_list: Annotated[bool, typer.Option("--list", help="List the models and stop.")] = False,
) -> None:
    """Build the FMU of a model: one file that any FMI 2.0 co-simulation tool can load.

    Example: `python build_fmu.py ratchet -o build/` writes build/Ratchet.fmu. The FMU needs Python with numpy and numba
    where it runs. Building compiles the engine, which takes a while at the first time; the same sources always give
    the same bytes.
    """
    if show_list:
        for name in models.available():
            typer.echo(f"{name:12}  {models.load(name).MODEL.description}")
        return
    messages = Console(stderr=True, highlight=False, soft_wrap=True)
    if model not in models.available():
        asked = f"There is no model {model!r}" if model else "Say which model to build"
        messages.print(f"{asked}; there are: {', '.join(models.available())}.", style="red", markup=False)
        raise typer.Exit(_USAGE_ERROR)
    began = time.perf_counter()
    try:
        with messages.status(f"Building the FMU of {model}; a first build compiles the engine ..."):
            path = build_fmu(models.load(model), output)
    except (MechanismError, OSError) as error:
        messages.print(str(error), style="red", markup=False)
        raise typer.Exit(1) from None
    seconds = time.perf_counter() - began
    typer.echo(f"{path}  {path.stat().st_size / 1e3:.0f} kB  GUID {_guid(path)}  {seconds:.1f} s")


def _guid(path: Path) -> str:
    with zipfile.ZipFile(path) as fmu:
        return ElementTree.fromstring(fmu.read("modelDescription.xml")).attrib["guid"]


if __name__ == "__main__":
    typer.run(build)
