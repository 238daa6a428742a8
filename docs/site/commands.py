"""The reference of the commands: what `--help` says, command by command.

python -m docs.site.commands      rewrites docs/reference/commands.md, in the root of a clone
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "reference" / "commands.md"

_INTRODUCTION = """\
# Commands

This page is what `--help` says. `mechanism-fmu --install-completion` completes commands and options in the shell;
`python -m mechanism_fmu` is the same command.

Values take units (`deg`, `rpm`, `N.mm`, `mm`, ...); a bare number is in the SI unit, and an angle in radians. All files
hold SI units and radians.
"""
_PLAIN = {"TYPER_USE_RICH": "0", "TERMINAL_WIDTH": "100", "COLUMNS": "100", "NO_COLOR": "1"}


def page() -> str:
    """The page, by another process: typer is told how to lay out its help before it is imported."""
    command = [sys.executable, "-c", "from docs.site.commands import printed; print(printed(), end='')"]
    environment = os.environ | _PLAIN | {"PYTHONPATH": os.pathsep.join(sys.path)}
    return subprocess.run(command, check=True, capture_output=True, text=True, env=environment, cwd=ROOT).stdout


def printed() -> str:
    """The page as typer lays it out in this process."""
    import typer
    from typer.testing import CliRunner

    from harness.app.cli import main

    parts = [_INTRODUCTION]
    for words in _commands(typer.main.get_command(main), ()):
        done = CliRunner().invoke(main, [*words, "--help"], prog_name="mechanism-fmu")
        assert done.exit_code == 0, done.output
        parts.append(f"## {' '.join(words)}\n\n```text\n{done.output.strip()}\n```\n")
    return "\n".join(parts)


def _commands(group: Any, words: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    """All commands, those of a group one by one."""
    for name, command in sorted(group.commands.items()):
        if not command.hidden:
            inner = hasattr(command, "commands")
            yield from _commands(command, (*words, name)) if inner else [(*words, name)]


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
