"""A file to begin with."""

from __future__ import annotations

import keyword
import re
from pathlib import Path

from .find import WrongUseError

_TEMPLATE = Path(__file__).with_name("template.txt")


def write_new(name: str, folder: Path) -> Path:
    """Write a mechanism that builds and runs, for the user to change, as `<name>.py`.

    Args:
        name: of the file and of the FMU.
        folder: where to.

    Raises:
        WrongUseError: the name cannot name an FMU, or there is such a file.
        OSError: the file cannot be written.
    """
    name = name.removesuffix(".py")
    if not re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) or keyword.iskeyword(name):
        better = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_") or "mechanism"
        better = f"my_{better}" if better[0].isdigit() or keyword.iskeyword(better) else better
        raise WrongUseError(
            f"{name!r} cannot name an FMU; use the letters a to z, digits and '_', and no Python keyword, "
            f"for example: mechanism-fmu new {better}"
        )
    path = folder / f"{name}.py"
    try:
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(_TEMPLATE.read_text(encoding="utf-8").replace("NAME", name))
    except FileExistsError:
        raise WrongUseError(f"{path} is there already; give another name, or remove it first.") from None
    return path
