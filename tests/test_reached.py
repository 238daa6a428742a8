"""What the library offers beside model, engine and FMU is reached by a command, a model or an example.

A name is reached when a definition that is reached names it, by the imports of its file; all of `harness`, `models`,
`build_fmu`, `docs/examples` and the rest of the library is. Tests, benchmarks and lists of what is public do not count.
"""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
CHECKED = tuple(
    f"mechanism_fmu.{name}" for name in ("kinematics", "elastodynamics", "stress", "batch", "statechart", "slides")
)
FILES = [
    path for folder in ("mechanism_fmu", "harness", "models", "docs/examples") for path in (ROOT / folder).rglob("*.py")
] + [ROOT / "build_fmu.py"]

#: What is kept though nothing reaches it, and why.
KEPT: dict[str, str] = {}

Name = tuple[str, str]


def module_of(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


TREES = {module_of(path): ast.parse(path.read_text(encoding="utf-8")) for path in FILES}
PACKAGES = {module_of(path) for path in FILES if path.name == "__init__.py"}


def defined(tree: ast.Module) -> Iterator[tuple[str | None, ast.AST]]:
    """Statements of a module with the names they define; None: it is run when the module is imported."""
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name, node
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            for one in (one for target in targets for one in ast.walk(target) if isinstance(one, ast.Name)):
                yield one.id, node
        elif not isinstance(node, (ast.Import, ast.ImportFrom)):
            yield None, node


@cache
def imported(module: str) -> dict[str, Name]:
    """By their names in a module: what it imports from others, wherever in it."""
    found = {}
    for node in ast.walk(TREES[module]):
        if isinstance(node, ast.ImportFrom):
            parts = module.split(".")
            up = parts[: len(parts) - node.level + (module in PACKAGES)] if node.level else []
            source = ".".join([*up, *([node.module] if node.module else [])])
            found |= {alias.asname or alias.name: (source, alias.name) for alias in node.names}
    return found


def origin(name: Name) -> Name:
    """Where a name is defined that packages pass on."""
    module, one = name
    while module in TREES and one not in DEFINED[module] and one in imported(module):
        module, one = imported(module)[one]
    return module, one


def used(module: str, node: ast.AST) -> Iterator[Name]:
    """What a statement of a module names."""
    for one in ast.walk(node):
        if isinstance(one, ast.Name):
            yield origin((module, one.id))
        elif isinstance(one, ast.Attribute) and isinstance(one.value, ast.Name):
            package, name = imported(module).get(one.value.id, ("", ""))
            yield origin((f"{package}.{name}", one.attr))


DEFINED = {module: {name for name, _ in defined(tree) if name is not None} for module, tree in TREES.items()}


def reached() -> set[Name]:
    nodes: dict[Name, list[ast.AST]] = {}
    waiting: list[tuple[str, ast.AST]] = []
    for module, tree in TREES.items():
        for name, node in defined(tree):
            if name is None or not f"{module}.".startswith(tuple(f"{one}." for one in CHECKED)):
                waiting.append((module, node))
            else:
                nodes.setdefault((module, name), []).append(node)
    found: set[Name] = set()
    while waiting:
        for name in set(used(*waiting.pop())) & nodes.keys() - found:
            found.add(name)
            waiting += [(name[0], node) for node in nodes[name]]
    return found


REACHED = reached()


@pytest.mark.parametrize("package", CHECKED)
def test_every_name_is_reached(package: str) -> None:
    modules = [module for module in TREES if f"{module}.".startswith(f"{package}.")]
    names = [(module, name) for module in modules for name in DEFINED[module]]
    assert len(names) > 10
    idle = {f"{module}.{name}" for module, name in names if (module, name) not in REACHED}
    assert sorted(idle - KEPT.keys()) == []


def test_what_is_kept_all_the_same_is_there_and_not_reached() -> None:
    for full in KEPT:
        module, _, name = full.rpartition(".")
        assert name in DEFINED[module]
        assert (module, name) not in REACHED
