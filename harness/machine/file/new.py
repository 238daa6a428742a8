"""A machine's file to begin with."""

from __future__ import annotations

import re
from pathlib import Path

from ...errors import UsageError

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
