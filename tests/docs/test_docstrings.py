"""Each public callable names its parameters, with units or kinds, the errors that it raises itself, and its source."""

import ast
import functools
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
from mechanism_fmu.simulation import Simulation, simulate

ROOT = Path(__file__).parents[2]

#: Annotations of parameters that are numbers, whose unit must be said.
_NUMERIC = re.compile(r"\b(float|Number|Point|Array|ndarray)\b")
#: A unit in brackets; or a word for what has none, or whose unit is another's.
_KIND = re.compile(r"\[[^\]]+\]|\b(units?|as of|shape|whether|number of|points?|count|share|ratio)\b")
#: What has the same arguments as something else in its module need not repeat them.
_AS_OF = re.compile(r"[Aa]rguments(?: and errors)? as of `([\w.]+)`")
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
        for method, function in methods(found) if inspect.isclass(found) else ():
            yield f"{name}.{method}", function


def methods(thing: type) -> Iterator[tuple[str, Any]]:
    """The public methods of a class and of its bases in this project."""
    for base in reversed(thing.__mro__):
        for name, function in vars(base).items() if base.__module__.split(".")[0] in _OURS else ():
            plain = getattr(function, "__func__", function)
            is_default = name in inspect.get_annotations(base)  # of a field whose value is a function
            if not name.startswith("_") and not is_default and inspect.isfunction(plain):
                yield name, plain


def unnamed(thing: Any) -> list[str]:
    """Parameters that the docstring does not name, or numbers without a unit."""
    if _is_made_otherwise(thing):
        return []
    try:
        parameters = inspect.signature(thing).parameters
    except (TypeError, ValueError):
        return []
    said = arguments(thing)
    if other := _AS_OF.search(" ".join((thing.__doc__ or "").split())):
        said = arguments(functools.reduce(getattr, other[1].split("."), inspect.getmodule(thing))) | said
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

#: What returns nothing but these does not calculate: it declares ports and objections, finds or builds what a
#: description already says, or writes that down.
_DECLARED = {"Parameter", "Input", "Output", "Finding"}
_FOUND = {"End", "ElasticPorts", "Resized", "Mechanism", "Settings", "SimpleNamespace", "str", "bool", "object"}
_WRITTEN = {"MechanismTables", "Logic", "Path"}
_NOT_CALCULATED = {*_DECLARED, *_FOUND, *_WRITTEN, "tuple", "list", "Iterator", "None"}
#: Classes of these have a law, whatever their methods return.
_LAWS = (JointFacts, Element, ContactFacts)
#: Instead of a section, the first line may cite, as in "(ME451, revolute)".
_CITES = re.compile(r"\((ME451|Pennestrì et al\.)[^()]+\)")

_PAGE = re.compile(r"(docs/[\w./-]+\.md)(?:, section ([^;:]+?)(?=[;:.]|, by |$))?(?:, eqs? ([^;:]*))?")
_PAPER = re.compile(r"(Pennestrì, Valentini, Vita|Erdman, Sandor, Oakberg \(1972\)), (?:[^;:]*?)eqs? ([^;:]*)")
#: How many equations there are in what is at hand of the papers.
_EQUATIONS = {"P": 16, "E": 14}


def needs_a_source(thing: Any) -> bool:
    """Whether something calculates, by what it returns; a class, when it is a law or one of its methods does."""
    if not inspect.isclass(thing):
        return bool(set(re.findall(r"\w+", str(inspect.get_annotations(thing).get("return")))) - _NOT_CALCULATED)
    if _is_made_otherwise(thing):
        return False
    return issubclass(thing, _LAWS) or any(needs_a_source(function) for _, function in methods(thing))


def source(thing: Any) -> str:
    """What a docstring says of the source, in one line."""
    doc = inspect.cleandoc(thing.__doc__)
    cited = _CITES.search(doc.splitlines()[0])
    return " ".join([cited[0] if cited else "", *(line.strip() for line in sections(doc).get("Source", []))]).strip()


def sourced() -> Iterator[tuple[str, str]]:
    """Name and source of all that need one."""
    for module in LISTED:
        for name, thing in callables(module) if module.startswith("mechanism_fmu") else ():
            if "." not in name and needs_a_source(thing):
                yield f"{module}.{name}", source(thing)


def test_laws_name_their_source() -> None:
    found = dict(sourced())
    assert len(found) > 180
    assert not [name for name, said in found.items() if not said]


def test_sources_in_this_project_are_there() -> None:
    for name, said in sourced():
        for page, section, equations in _PAGE.findall(said):
            text = (ROOT / page).read_text(encoding="utf-8")
            assert not section or f"\n## {section}" in text, f"{name}: {page} has no section {section!r}"
            assert all(number in text for number in re.findall(r"\(K\d+\)", equations)), f"{name}: {page} {equations}"


def test_a_source_that_is_another_name_leads_to_one_with_a_source() -> None:
    found = {name.rpartition(".")[2] for name, _ in sourced()}
    other = {name: seen[1] for name, said in sourced() if (seen := re.match(r"`(\w+)`", said))}
    assert len(other) > 5
    assert not {name: one for name, one in other.items() if one not in found}


def test_equations_of_the_papers_are_among_those_that_there_are() -> None:
    quoted = [
        (name, paper[0], int(number))
        for name, said in sourced()
        for paper, text in _PAPER.findall(said)
        for number in re.findall(r"\((\d+)\)", text)
    ]
    assert len(quoted) > 30
    assert not [one for one in quoted if not 1 <= one[2] <= _EQUATIONS[one[1]]]


def test_what_calculates_is_told_from_the_rest() -> None:
    laws = (model.Revolute, model.Bushing, model.AngleStop, model.Marker)
    functions = (stress.bending_stress, model.bar, model.cycloidal, model.circle, model.dyad, model.rpm, simulate)
    by_their_methods = (model.Section, model.Term, Simulation)
    assert all(map(needs_a_source, (*laws, *functions, *by_their_methods)))
    held = (model.Body, model.Piece, model.Move, model.Output, model.Member, stress.Material, stress.ModeScaling)
    found = (elastodynamics.crank_of, model.torque_input, model.default_outputs, model.compile_mechanism)
    assert not any(map(needs_a_source, (*held, *found)))
    assert source(model.Revolute) == "(ME451, revolute)"
    assert source(model.rpm) == "definition: 1 rpm = 2 pi rad in 60 s."
    assert not source(model.Body)
