"""Small wrong changes of Python sources, one at a time: comparisons, constants, signs, and/or, returned values."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

#: What stands for what, by class of operator.
_OPERATORS: dict[type[ast.AST], type[ast.AST]] = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.And: ast.Or,
    ast.Or: ast.And,
}


@dataclass(frozen=True)
class Mutant:
    """One change.

    Attributes:
        path: of the file, relative to the project.
        line: of the change, from 1.
        begin, end: of what is replaced, in bytes of the file.
        before, after: texts.
    """

    path: str
    line: int
    begin: int
    end: int
    before: str
    after: str

    def apply(self, source: bytes) -> bytes:
        """The file with the change."""
        return source[: self.begin] + self.after.encode() + source[self.end :]

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {' '.join(self.before.split())}  ->  {' '.join(self.after.split())}"


def mutants(path: Path, root: Path) -> list[Mutant]:
    """All changes of a file that are still Python."""
    source = path.read_bytes()
    starts = [0]
    for line in source.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    found = []
    for node, after in _changes(ast.parse(source)):
        begin = starts[node.lineno - 1] + node.col_offset
        end = starts[node.end_lineno - 1] + node.end_col_offset  # type: ignore[operator]
        before = source[begin:end].decode()
        found.append(Mutant(path.relative_to(root).as_posix(), node.lineno, begin, end, before, after))
    return found


def _changes(tree: ast.Module) -> Iterator[tuple[ast.expr, str]]:
    """An expression, and the text that takes its place."""
    for node in _expressions(tree):
        if isinstance(node, ast.Compare):
            for k, operator in enumerate(node.ops):
                operators = [*node.ops[:k], _OPERATORS[type(operator)](), *node.ops[k + 1 :]]
                yield node, _text(ast.Compare(node.left, operators, node.comparators))  # type: ignore[arg-type]
        elif isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS:
            yield node, _text(ast.BinOp(node.left, _OPERATORS[type(node.op)](), node.right))  # type: ignore[arg-type]
        elif isinstance(node, ast.BoolOp):
            yield node, _text(ast.BoolOp(_OPERATORS[type(node.op)](), node.values))  # type: ignore[arg-type]
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not):
            yield node, _text(node.operand)
        elif isinstance(node, ast.Constant) and type(node.value) in (bool, int, float):
            value = node.value
            other = (
                not value if isinstance(value, bool) else value + 1 if isinstance(value, int) else value * 1.25 + 1e-3
            )
            yield node, _text(ast.Constant(other))
    for statement in ast.walk(tree):
        value = statement.value if isinstance(statement, ast.Return) else None
        if value is not None and not (isinstance(value, ast.Constant) and value.value is None):
            yield value, "None"


def _text(node: ast.expr) -> str:
    return f"({ast.unparse(node)})"


def _expressions(node: ast.AST) -> Iterator[ast.expr]:
    """What runs: no annotations, decorators, or insides of f-strings, whose places Python 3.11 gets wrong."""
    for name, field in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list") or isinstance(node, ast.JoinedStr):
            continue
        for child in field if isinstance(field, list) else [field]:
            if isinstance(child, ast.expr):
                yield child
            if isinstance(child, ast.AST):
                yield from _expressions(child)
