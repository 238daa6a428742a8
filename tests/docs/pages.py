"""The pages of the joint library: their programs, and what these are said to print."""

from __future__ import annotations

import re
from pathlib import Path

JOINTS = Path(__file__).parents[2] / "docs" / "joints"
PAGES = sorted(JOINTS.glob("*.md"))

_EXAMPLE = re.compile(r"```python\n(.*?)```\n+```text\n(.*?)```", re.DOTALL)
_PROGRAM = re.compile(r"```python\n")


def examples(page: Path) -> list[tuple[str, str]]:
    """Each program of a page with its output."""
    text = page.read_text(encoding="utf-8")
    found: list[tuple[str, str]] = _EXAMPLE.findall(text)
    assert len(found) == len(_PROGRAM.findall(text)), f"{page.name}: a program is not followed by its output"
    return found
