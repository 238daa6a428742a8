"""Each public callable names its parameters, with units or kinds, and the errors that it raises itself."""

import ast
import importlib
import inspect
import re
import textwrap
from collections.abc import Iterator
from enum import Enum
from typing import Any

import pytest
from test_public_interface import LISTED

from docs.elements.described import arguments, sections

#: What still lacks something, by module; a number may shrink, and what is not here lacks nothing.
LACKING: dict[str, int] = {
    "build_fmu": 1,
}

#: Annotations of parameters that are numbers, whose unit must be said.
_NUMERIC = re.compile(r"\b(float|Number|Point|Array|ndarray)\b")
#: A unit in brackets; or a word for what has none, or whose unit is another's.
_KIND = re.compile(r"\[[^\]]+\]|\b(units?|as of|shape|whether|number of|points?|count|share|ratio)\b")
_OURS = ("build_fmu", "harness", "mechanism_fmu", "models")
_INTERNAL = (NotImplementedError, StopIteration)


def callables(module: str) -> Iterator[tuple[str, Any]]:
    """What a module of the page lists that can be called, but for errors, with the public methods of its classes."""
    package = importlib.import_module(module)
    for name in LISTED[module]:
        found = getattr(package, name)
        if not (inspect.isclass(found) or inspect.isfunction(found)) or found is Any:
            continue
        if inspect.isclass(found) and issubclass(found, BaseException):
            continue
        yield name, found
        for base in reversed(found.__mro__) if inspect.isclass(found) else ():
            for method, function in vars(base).items() if base.__module__.split(".")[0] in _OURS else ():
                plain = getattr(function, "__func__", function)
                if not method.startswith("_") and inspect.isfunction(plain):
                    yield f"{name}.{method}", plain


def unnamed(thing: Any) -> list[str]:
    """Parameters that the docstring does not name, or numbers without a unit."""
    if _is_made_otherwise(thing):
        return []
    try:
        parameters = inspect.signature(thing).parameters
    except (TypeError, ValueError):
        return []
    said = arguments(thing)
    lacks = []
    for name, parameter in parameters.items():
        if name in ("self", "cls") or name.startswith("_"):
            continue
        if name not in said:
            lacks.append(f"{name}: not named")
        elif _NUMERIC.search(str(_annotation(thing, parameter))) and not _KIND.search(said[name]):
            lacks.append(f"{name}: no unit, shape or kind")
    return lacks


def _is_made_otherwise(thing: Any) -> bool:
    """Whether nobody makes one: of an enumeration or a protocol."""
    return inspect.isclass(thing) and (issubclass(thing, Enum) or getattr(thing, "_is_protocol", False))


def _annotation(thing: Any, parameter: inspect.Parameter) -> Any:
    if parameter.annotation is not parameter.empty:
        return parameter.annotation
    return inspect.get_annotations(thing).get(parameter.name, "") if inspect.isclass(thing) else ""


def raised(thing: Any) -> set[str]:
    """The errors that the body of a function, or of a class when it is made, raises itself."""
    bodies = [] if inspect.isclass(thing) else [thing]
    if inspect.isclass(thing) and not _is_made_otherwise(thing):
        bodies = [vars(thing)[name] for name in ("__init__", "__post_init__", "__new__") if name in vars(thing)]
    found: set[str] = set()
    for body in bodies:
        try:
            tree = ast.parse(textwrap.dedent(inspect.getsource(body)))
        except (OSError, TypeError):
            continue  # made by a decorator
        for node in ast.walk(tree):
            if isinstance(node, ast.Raise) and node.exc is not None:
                error = node.exc.func if isinstance(node.exc, ast.Call) else node.exc
                if isinstance(error, ast.Name) and re.match(r"[A-Z]", error.id):
                    found.add(error.id)
    return found - {error.__name__ for error in _INTERNAL}


def lacks(thing: Any) -> list[str]:
    """All that is missing in a docstring."""
    said = " ".join(sections(thing.__doc__).get("Raises", []))
    if inspect.isclass(thing):
        said += " ".join(sections(thing.__init__.__doc__).get("Raises", []))
    silent = [f"Raises: {error}" for error in sorted(raised(thing)) if error not in said]
    return unnamed(thing) + silent


@pytest.mark.parametrize("module", LISTED)
def test_docstrings_name_parameters_units_and_errors(module: str) -> None:
    found = {name: missing for name, thing in callables(module) if (missing := lacks(thing))}
    print("\n".join(f"{name}: {', '.join(missing)}" for name, missing in found.items()))
    assert len(found) == LACKING.get(module, 0), "say what is printed above, or put the lower number into LACKING"


def test_what_lacks_something_is_listed_for_modules_that_there_are() -> None:
    assert not LACKING.keys() - LISTED.keys()
    assert all(LACKING.values())
