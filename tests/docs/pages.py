"""The pages of the joint library: their programs, and what these are said to print."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path
from typing import Any

JOINTS = Path(__file__).parents[2] / "docs" / "joints"
PAGES = sorted(JOINTS.glob("*.md"))

_EXAMPLE = re.compile(r"```python\n(.*?)```\n+```text\n(.*?)```", re.DOTALL)
_PROGRAM = re.compile(r"```python\n")
_COMMAND = re.compile(r"```sh\nmechanism-fmu (.*?)```\n\n<!-- printed -->\n```text\n(.*?)```\n<!-- end -->", re.DOTALL)


def examples(page: Path) -> list[tuple[str, str]]:
    """Each program of a page with its output."""
    text = page.read_text(encoding="utf-8")
    found: list[tuple[str, str]] = _EXAMPLE.findall(text)
    assert len(found) == len(_PROGRAM.findall(text)), f"{page.name}: a program is not followed by its output"
    return found


def commands(page: Path) -> list[tuple[str, str]]:
    """Arguments of each `mechanism-fmu` of a page that is marked as printed, with what it prints."""
    return _COMMAND.findall(page.read_text(encoding="utf-8"))


def what_prints(program: str, page: Path, names: dict[str, Any] | None = None) -> str:
    """What a program of a page prints; `names` are those that the programs before it have left, and it leaves."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(program, page.name, "exec"), {"__name__": page.stem} if names is None else names)
    return printed.getvalue()
