"""What a package offers to users."""

import ast
from pathlib import Path
from types import ModuleType


def listed_by(package: ModuleType) -> list[str] | None:
    """Names in `__all__`, or what a package defines or passes on as `from .x import X as X`; None of a plain module."""
    if "__all__" in vars(package) or not hasattr(package, "__path__"):
        return vars(package).get("__all__")
    tree = ast.parse(Path(str(package.__file__)).read_text(encoding="utf-8"))
    passed = [alias.asname for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names]
    here = [name for name, value in vars(package).items() if getattr(value, "__module__", None) == package.__name__]
    plain = [node.target for node in tree.body if isinstance(node, ast.AnnAssign)]
    plain += [target for node in tree.body if isinstance(node, ast.Assign) for target in node.targets]
    constants = [target.id for target in plain if isinstance(target, ast.Name)]
    names = [*filter(None, passed), *(name for name in (*here, *constants) if not name.startswith("_"))]
    return names + [name for name in constants if name == "__version__"] or None
