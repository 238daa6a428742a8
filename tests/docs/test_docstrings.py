"""Each public callable names its parameters, with units or kinds, the errors that it raises itself, and its source."""

import ast
import importlib
import inspect
import re
import textwrap
from collections.abc import Iterator
from enum import Enum
from pathlib import Path
from typing import Any

import pytest
from test_public_interface import LISTED

from docs.elements.described import arguments, sections
from mechanism_fmu import elastodynamics, model, stress
from mechanism_fmu.model.contact_facts import ContactFacts
from mechanism_fmu.model.forces import Element
from mechanism_fmu.model.joints.base import JointFacts

ROOT = Path(__file__).parents[2]

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
    assert not found, "\n".join(f"{name}: {', '.join(missing)}" for name, missing in found.items())


# Where a law comes from: a paper's equation, a textbook, or a page of this project where it is derived.

#: Functions of these calculate by a law; but not those that only find something in a mechanism, and return this.
ANALYSES = tuple(f"mechanism_fmu.{name}" for name in ("elastodynamics", "stress", "kinematics", "slides"))
_FINDS = {"str", "tuple[str, ...]", "Point", "ElasticPorts", "Resized | None"}
#: Classes of these have a law, too.
_LAWS = (JointFacts, Element, ContactFacts)
#: Instead of a section, the first line may cite, as in "(ME451, revolute)".
_CITES = re.compile(r"\((ME451|Pennestrì et al\.)[^()]+\)")

_PAGE = re.compile(r"(docs/[\w./-]+\.md)(?:, section ([^;:]+?)(?=[;:.]|, by |$))?(?:, eqs? ([^;:]*))?")
_PAPER = re.compile(r"(Pennestrì, Valentini, Vita|Erdman, Sandor, Oakberg \(1972\)), (?:[^;:]*?)eqs? ([^;:]*)")
#: How many equations there are in what is at hand of the papers.
_EQUATIONS = {"P": 16, "E": 14}


def needs_a_source(thing: Any) -> bool:
    """Whether something calculates by a law that somebody has written down."""
    if inspect.isclass(thing):
        return issubclass(thing, _LAWS)
    home, returned = inspect.getmodule(thing), inspect.get_annotations(thing).get("return")
    return f"{home and home.__name__}.".startswith(tuple(f"{name}." for name in ANALYSES)) and returned not in _FINDS


def source(thing: Any) -> str:
    """What a docstring says of the source, in one line."""
    doc = inspect.cleandoc(thing.__doc__)
    cited = _CITES.search(doc.splitlines()[0])
    return " ".join([cited[0] if cited else "", *(line.strip() for line in sections(doc).get("Source", []))]).strip()


def sourced() -> Iterator[tuple[str, str]]:
    """Name and source of all that need one."""
    for module in (*ANALYSES, "mechanism_fmu.model"):
        for name, thing in callables(module):
            if "." not in name and needs_a_source(thing):
                yield f"{module}.{name}", source(thing)


def test_laws_name_their_source() -> None:
    found = dict(sourced())
    assert len(found) > 100
    assert not [name for name, said in found.items() if not said]


def test_sources_in_this_project_are_there() -> None:
    for name, said in sourced():
        for page, section, equations in _PAGE.findall(said):
            text = (ROOT / page).read_text(encoding="utf-8")
            assert not section or f"\n## {section}" in text, f"{name}: {page} has no section {section!r}"
            assert all(number in text for number in re.findall(r"\(K\d+\)", equations)), f"{name}: {page} {equations}"


def test_equations_of_the_papers_are_among_those_that_there_are() -> None:
    quoted = [
        (name, paper[0], int(number))
        for name, said in sourced()
        for paper, text in _PAPER.findall(said)
        for number in re.findall(r"\((\d+)\)", text)
    ]
    assert len(quoted) > 30
    assert not [one for one in quoted if not 1 <= one[2] <= _EQUATIONS[one[1]]]


def test_laws_are_told_from_the_rest() -> None:
    assert all(map(needs_a_source, (model.Revolute, model.Bushing, model.AngleStop, stress.bending_stress)))
    assert not any(map(needs_a_source, (model.Body, model.Output, model.bar, elastodynamics.crank_of, stress.Material)))
    assert source(model.Revolute) == "(ME451, revolute)"
    assert not source(model.Body)
