"""A notebook without a notebook's machinery: read, run, written as a page.

python -m docs.site.notebook      runs the tutorial and keeps in it what its cells print, in the root of a clone

Of what a notebook may have in a cell, it knows Python, `!command` and `%%writefile NAME`. A command's output is not
kept, as it holds times.
"""

from __future__ import annotations

import ast
import contextlib
import io
import json
import os
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

TUTORIAL = Path(__file__).resolve().parents[1] / "tutorials" / "mechanism-to-machine.ipynb"

#: What stands for `mechanism-fmu`, whatever is installed.
_COMMAND = [sys.executable, "-P", "-m", "mechanism_fmu"]


def read(path: Path) -> dict[str, Any]:
    """A notebook's file."""
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return found


def source(cell: dict[str, Any]) -> str:
    """What stands in a cell."""
    return "".join(cell["source"])


def printed(cell: dict[str, Any]) -> str:
    """What a cell has kept of what it printed."""
    return "".join(line for output in cell.get("outputs", []) for line in output.get("text", []))


def run(notebook: dict[str, Any], folder: Path) -> Iterator[tuple[dict[str, Any], str, Any]]:
    """Run the code cells in a folder, one after the other.

    Returns:
        Each cell, what its Python printed, and the value of its last expression.

    Raises:
        CalledProcessError: a command has failed.
    """
    names: dict[str, Any] = {"__name__": "__main__"}
    with contextlib.chdir(folder), _importable(folder):
        for cell in notebook["cells"]:
            if cell["cell_type"] == "code":
                yield cell, *_run(source(cell), names)


@contextlib.contextmanager
def _importable(folder: Path) -> Iterator[None]:
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))


def _run(text: str, names: dict[str, Any]) -> tuple[str, Any]:
    if text.startswith("%%writefile "):
        head, _, rest = text.partition("\n")
        Path(head.split()[1]).write_text(rest + "\n", encoding="utf-8")
        return "", None
    if text.startswith("!"):
        for line in text.splitlines():
            words = shlex.split(line[1:])
            environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
            subprocess.run([*_COMMAND, *words[1:]], check=True, capture_output=True, env=environment)
        return "", None
    tree = ast.parse(text)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    seen, value = io.StringIO(), None
    with contextlib.redirect_stdout(seen):
        exec(compile(tree, "cell", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    return seen.getvalue(), value


def markdown(path: Path) -> str:
    """A notebook as a page."""
    parts = []
    for cell in read(path)["cells"]:
        text = source(cell)
        if cell["cell_type"] == "markdown":
            parts.append(text)
            continue
        language = "toml" if ".toml\n" in text[:40] else "sh" if text.startswith("!") else "python"
        shown = text.replace("!mechanism-fmu", "mechanism-fmu") if language == "sh" else text
        if shown.startswith("%%writefile "):
            head, _, shown = shown.partition("\n")
            parts.append(f"`{head.split()[1]}`:")
        parts.append(f"```{language}\n{shown}\n```")
        if printed(cell):
            parts.append(f"```text\n{printed(cell)}```")
    where = f"This page is the notebook `docs/tutorials/{path.name}`."
    return "\n\n".join([parts[0], where, *parts[1:]]) + "\n"


def main() -> None:
    """Run the tutorial and keep what it prints."""
    notebook = read(TUTORIAL)
    with tempfile.TemporaryDirectory() as folder:
        for cell, text, _ in run(notebook, Path(folder)):
            kept = {"name": "stdout", "output_type": "stream", "text": text.splitlines(keepends=True)}
            cell["outputs"] = [kept] if text else []
    TUTORIAL.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
