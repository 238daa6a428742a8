"""The examples of docs/examples and its gallery: which there are, and copies of them to begin with."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path

from ...errors import UsageError
from ...run.results import write_bytes
from ..terminal import console

#: From the root of the tree; in a wheel, which has all of that below `mechanism_fmu`, from there.
FOLDER = Path(__file__).parents[3] / "docs" / "examples"

#: Where the files are that set a MODEL, below that.
GALLERY = "gallery"

#: What runs a file of designs or of a machine, by a table that no other kind of file has.
_COMMANDS = {"sweep": "sweep", "optimise": "optimise", "component": "machine run"}


def files() -> list[Path]:
    """All examples, by name; those of the gallery, each a mechanism, behind the others.

    Raises:
        UsageError: they are not installed.
    """
    if not FOLDER.is_dir():  # an editable install in the mode "strict" links packages only
        raise UsageError(f"There is no folder {FOLDER}; the examples are in docs/examples of the project's sources.")
    return [*_files_in(FOLDER), *_files_in(FOLDER / GALLERY)]


def _files_in(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if path.is_file())


def name(path: Path) -> str:
    """An example's path below the folder of examples."""
    return path.relative_to(FOLDER).as_posix()


def description(path: Path) -> str:
    """What an example is, in a line: its title, the first line of its docstring, or its heading."""
    text = path.read_text(encoding="utf-8")
    match path.suffix:
        case ".toml":
            return str(tomllib.loads(text)["title"])
        case ".py":
            return (ast.get_docstring(ast.parse(text)) or "").partition("\n")[0]
        case _:
            return f"input signals: {text.partition(chr(10))[0]}"


def command(path: Path) -> str:
    """What runs an example, as one types it; "" for what another example reads."""
    if path.parent.name == GALLERY:
        return f"mechanism-fmu build {path}"
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        usage = re.search(rf"python \S*{re.escape(path.name)}((?: \S+)*)", text)
        return f"python {path}{usage[1] if usage else ''}"
    if path.suffix != ".toml":
        return ""
    tables = tomllib.loads(text)
    return next(f"mechanism-fmu {name} {path}" for table, name in _COMMANDS.items() if table in tables)


def copy_examples(folder: Path) -> list[Path]:
    """Copy all examples into a folder, which is made if need be.

    Raises:
        UsageError: a file of such a name is there already, and nothing has been copied; or the disk refuses.
    """
    there = [name(path) for path in files() if (folder / name(path)).exists()]
    if there:
        raise UsageError(
            f"{folder} has {', '.join(there)} already; nothing was copied. Give another folder, or remove "
            f"{'it' if len(there) == 1 else 'them'} first."
        )
    try:
        (folder / GALLERY).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"{folder} cannot be made ({error}); give another folder.") from error
    return [write_bytes(folder / name(path), path.read_bytes()) for path in files()]


def show_examples(folder: Path | None) -> int:
    """List the examples, or copy them and say how to run them.

    Args:
        folder: where to copy them; None: list them.

    Returns:
        Exit code.
    """
    shown = files() if folder is None else copy_examples(folder)
    for path in shown:
        listed = path.relative_to(FOLDER if folder is None else folder).as_posix()
        console.print(f"{listed:28}  {description(path)}", soft_wrap=True, markup=False)
    if folder is None:
        console.print("\nCopy them: mechanism-fmu examples --copy", soft_wrap=True, markup=False)
    else:
        commands = "\n".join(filter(None, map(command, shown)))
        console.print(f"\nCopied to {folder}. Run them:\n\n{commands}", soft_wrap=True, markup=False)
    return 0
