"""Programs on pages and in docs/examples import what is public, and nothing else of this project."""

import ast
import re
from pathlib import Path

import pytest
from test_public_interface import LISTED

DOCS = Path(__file__).parents[2] / "docs"
OURS = ("mechanism_fmu", "harness", "models", "build_fmu")
#: What is for users of a clone only, and who shows it: data of the project's own studies.
SHOWN = {("explanation/stress.md", "harness.papers.study.accuracy.plane_teeth")}
FILES = [
    path
    for path in sorted([*DOCS.rglob("*.md"), *(DOCS / "examples").rglob("*.py")])
    if "decisions" not in path.parts and path.name not in ("public-interface.md", "extending.md")
]


def imported(program: str) -> set[str]:
    """Names of this project that a program imports."""
    found = set()
    for node in ast.walk(ast.parse(program)):
        if isinstance(node, ast.ImportFrom) and str(node.module).split(".")[0] in OURS:
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def public(name: str) -> bool:
    """Whether a name is listed, or is a module with names that are."""
    module, _, last = name.rpartition(".")
    return last in LISTED.get(module, ()) or name in LISTED or name == "mechanism_fmu.model.port_builders"


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(DOCS).as_posix())
def test_a_program_imports_what_is_public(path: Path) -> None:
    text, place = path.read_text(encoding="utf-8"), path.relative_to(DOCS).as_posix()
    programs = re.findall(r"```python\n(.*?)```", text, re.DOTALL) if path.suffix == ".md" else [text]
    for program in programs:
        try:
            names = imported(program)
        except SyntaxError:  # lines out of a program
            names = set()
        assert not [name for name in names if not public(name) and (place, name) not in SHOWN]
