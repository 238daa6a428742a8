"""The user's model file: which one is meant, and a template to begin with."""

from __future__ import annotations

import keyword
import re
from difflib import get_close_matches
from enum import StrEnum
from os.path import exists, isdir
from pathlib import Path

from ...model import MechanismError

# Which file is meant.

#: What the name of a file that travels in an FMU may be made of.
_NAME = re.compile(r"[A-Za-z0-9_ -]+")


class WrongUseError(MechanismError):
    """What was given on the command line is no file of a mechanism; nothing has been read."""


def looks_like_a_file(text: str) -> bool:
    """Whether a text is a path rather than the name of a ready-made model."""
    return text.endswith(".py") or "/" in text or "\\" in text or exists(text)


def find(text: str) -> Path:
    """The file that a path names.

    Raises:
        WrongUseError: there is none, or one that can be no mechanism's.
    """
    path = Path(text)
    if isdir(path):
        files = ", ".join(_python_files(path)) or "none"
        raise WrongUseError(f"{path} is a folder; give the file in it that sets MODEL (Python files there: {files}).")
    if not exists(path):
        raise WrongUseError(f"There is no file {path}{_instead(path)}")
    if path.suffix != ".py":
        raise WrongUseError(f"{path} is not a Python file; give the file ending in .py that sets MODEL.")
    if not _NAME.fullmatch(path.stem):
        better = re.sub(r"\W+", "_", path.stem, flags=re.ASCII).strip("_") or "my_mechanism"
        raise WrongUseError(
            f"{path}: the file travels in the FMU, so its name must be of the letters a to z, digits, '_', '-' and "
            f"spaces before .py; rename it, for example to {better}.py."
        )
    return path


def _instead(path: Path) -> str:
    """What there is instead of a file that does not exist."""
    if not isdir(path.parent):
        return f", nor a folder {path.parent}; check the path."
    there = _python_files(path.parent)
    near = get_close_matches(path.name, [*there, *(Path(name).stem for name in there)], 1)
    if near:
        return f"; did you mean {path.with_name(near[0]).with_suffix('.py')}?"
    known = f"Python files there: {', '.join(there)}" if there else "there are no Python files in that folder"
    return f"; {known}. A new one is written by: mechanism-fmu new my_mechanism"


def _python_files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.glob("*.py"))[:10]


# A file to begin with.

_FOLDER = Path(__file__).parent


class Like(StrEnum):
    """What a new file can be like."""

    LEVER = "lever"
    FOUR_BAR = "four_bar"
    CAM = "cam"
    RATCHET = "ratchet"
    BLANK = "blank"

    @property
    def text(self) -> str:
        """The file, with NAME where its name stands."""
        path = _FOLDER / ("template.txt" if self is Like.LEVER else f"like/{self}.txt")
        return path.read_text(encoding="utf-8")


def write_new(name: str, folder: Path, like: Like = Like.LEVER) -> Path:
    """Write a mechanism that builds and runs, for the user to change, as `<name>.py`.

    Args:
        name: of the file and of the FMU.
        folder: where to.
        like: what it begins as.

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
            file.write(like.text.replace("NAME", name))
    except FileExistsError:
        raise WrongUseError(f"{path} is there already; give another name, or remove it first.") from None
    return path
