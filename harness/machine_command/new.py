"""`machine new`: a machine's file to begin with."""

from __future__ import annotations

from pathlib import Path

from rich.markup import escape

from ..machine.file.new import write_new
from ..terminal import console


def new_file(name: str) -> int:
    """Write it, and say how to go on."""
    path = write_new(name, Path())
    console.print(f"Written: {escape(str(path))}", soft_wrap=True)
    console.print(f"mechanism-fmu machine run {path}", soft_wrap=True, markup=False)
    return 0
