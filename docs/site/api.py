"""The reference of the library: a page for each module of the public interface, its text the docstrings'."""

from __future__ import annotations

import importlib
import inspect
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

_ROW = re.compile(r"^\| `([\w.]+)` \| (.*) \| .*\|$", re.MULTILINE)
_NAME = re.compile(r"`(\w+)`")


def write(interface: Path, folder: Path) -> None:
    """Write the pages of the modules that the public interface lists.

    Args:
        interface: the page that lists modules and names.
        folder: for the pages.
    """
    names: dict[str, list[str]] = {}
    for module, listed in _ROW.findall(interface.read_text(encoding="utf-8")):
        names.setdefault(module, []).extend(_NAME.findall(listed))
    folder.mkdir(parents=True)
    seen: set[int] = set()
    for module, listed in names.items():
        lines = [f"# {module}", "", "```{eval-rst}", f".. py:currentmodule:: {module}", ""]
        for name in listed:
            lines += _directive(module, name, seen)
        (folder / f"{module}.md").write_text("\n".join([*lines, "```", ""]), encoding="utf-8")
    tree = "\n".join(names)
    text = (
        "# Python API\n\nEvery name on which a program may rely, by module, from its docstring. Which names go "
        f"together: [public interface](../public-interface.md).\n\n```{{toctree}}\n:maxdepth: 1\n\n{tree}\n```\n"
    )
    (folder / "index.md").write_text(text, encoding="utf-8")


def _directive(module: str, name: str, seen: set[int]) -> list[str]:
    """The directive that fits what a name is; what another module has, too, is in the index once."""
    thing = getattr(importlib.import_module(module), name)
    again = ["   :no-index:"] if id(thing) in seen else []
    seen.add(id(thing))
    if inspect.isclass(thing):
        return [f".. autoclass:: {module}.{name}", "   :members:", *again, ""]
    if inspect.isfunction(thing):
        return [f".. autofunction:: {module}.{name}", *again, ""]
    return [f".. py:data:: {name}", "", f"   {_explained(module, name)}", ""]


def _explained(module: str, name: str) -> str:
    """What the comment above a constant says, where it is defined."""
    package = Path(str(importlib.import_module(module).__file__))
    above = re.compile(rf"^#: (.*\n(?:#.*\n)*){name}\b.* = ", re.MULTILINE)
    for file in (package, *package.parent.rglob("*.py"), package.parent.parent / "codes.py"):
        if file.is_file() and (found := above.search(file.read_text(encoding="utf-8"))):
            return " ".join(found[1].replace("#:", "").replace("#", "").split())
    return ""


def _plain(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Docstrings are plain text: what reStructuredText would take for marks is escaped outside of backticks."""
    parts = re.split(r"(`[^`]*`)", "\n".join(lines))  # every second one is between backticks
    for number, part in enumerate(parts):
        if number % 2 == 0:
            parts[number] = re.sub(r"\A(?=\w)", r"\\ ", _escaped(part)) if number else _escaped(part)
    lines[:] = "".join(parts).split("\n")


def _escaped(text: str) -> str:
    return re.sub(r"(\w)_(?=\W|$)", r"\1\_", re.sub(r"([*|])", r"\\\1", text))


def _skipped(app: Any, what: str, name: str, obj: Any, skip: bool, options: Any) -> bool | None:
    """Fields of named tuples, which the docstring of their class explains."""
    return True if type(obj).__name__ == "_tuplegetter" else None


def setup(app: Sphinx) -> dict[str, Any]:
    """Tell Sphinx."""
    app.connect("autodoc-process-docstring", _plain, priority=100)
    app.connect("autodoc-skip-member", _skipped)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
