"""Whether the parts of a user's mechanism are of the right kind: a tuple, a text, a number, a point.

The records of the model room do not ask, because type checkers do; a user's file comes without one.
"""

from __future__ import annotations

import types
from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from ...model import Mechanism, MechanismError, Model
from ...model.functions import is_plain

#: Longest value that is shown in full.
_LONGEST = 60


def check_model(model: Model) -> None:
    """Check the fields of a model and its parameters.

    Raises:
        MechanismError: one is of the wrong kind.
    """
    _refuse(_whole(model))
    _refuse(problem for parameter in model.parameters for problem in _part(parameter))


def check_mechanism(mechanism: object) -> None:
    """Check what a model's function gives for plain numbers, with the fields of all parts.

    Raises:
        MechanismError: it is no mechanism, or one of its parts is of the wrong kind.
    """
    if not isinstance(mechanism, Mechanism):
        what = "nothing" if mechanism is None else f"a {type(mechanism).__name__}"
        raise MechanismError(f"the function of MODEL returns {what}; end it with: return Mechanism(bodies=..., ...)")
    _refuse(_whole(mechanism))
    values = (getattr(mechanism, field.name) for field in fields(mechanism))
    parts = (part for value in values if isinstance(value, tuple) for part in value if not isinstance(part, str))
    _refuse(problem for part in parts for problem in _part(part))


def _refuse(problems: Iterable[str]) -> None:
    """The first problem is enough: the others often follow from it."""
    for problem in problems:
        raise MechanismError(problem)


def _whole(record: Model | Mechanism) -> Iterator[str]:
    """What is wrong with the fields of a model or a mechanism: single values, and tuples of parts."""
    label = type(record).__name__
    for name, hint in get_type_hints(type(record)).items():
        value = getattr(record, name)
        if get_origin(hint) is not tuple:
            if not _fits(value, hint):
                yield f"{label}: {name} is {_shown(value)}, but it must be {_words(hint)}."
        elif not isinstance(value, tuple):
            what = type(value).__name__
            yield (
                f"{label}: {name} is a {what}, but it must be a tuple: write {name}=(..., ...) in round brackets, and "
                f"of a single entry {name}=(...,) with a comma."
            )
        else:
            kind = get_args(hint)[0]
            for entry in value:
                if not _fits(entry, kind):
                    yield f"{label}: {name} holds {_shown(entry)}, but each entry must be {_words(kind)}."


def _part(part: Any) -> Iterator[str]:
    """What is wrong with the fields of one part."""
    hints = get_type_hints(type(part))
    names = [field.name for field in fields(part)]
    for name in names:
        value = getattr(part, name)
        if not _fits(value, hints[name]):
            yield (
                f"{type(part).__name__} {getattr(part, 'name', '')!r}: {name} is {_shown(value)}, but it must be "
                f"{_words(hints[name])}. The order is: {', '.join(names)}."
            )


def _fits(value: Any, hint: Any) -> bool:
    """Whether a value is of the kind that an annotation asks for; it is of any kind that is not known here."""
    kind, arguments = get_origin(hint), get_args(hint)
    if hint in (Any, float):
        return is_plain(value)
    if kind in (Union, types.UnionType):
        return any(_fits(value, argument) for argument in arguments)
    if kind is Literal:
        return value in arguments
    if kind is Callable:
        return callable(value)
    if kind is tuple:
        if isinstance(value, str) or not hasattr(value, "__len__"):
            return False
        kinds = [arguments[0]] * len(value) if arguments[1:] == (Ellipsis,) else arguments
        return len(value) == len(kinds) and all(map(_fits, value, kinds))
    return not isinstance(hint, type) or isinstance(value, hint)


def _words(hint: Any) -> str:
    """What an annotation asks for."""
    kind, arguments = get_origin(hint), get_args(hint)
    if hint in (Any, float):
        return "a number"
    if hint in (str, type(None)):
        return "a text" if hint is str else "None"
    if kind in (Union, types.UnionType):
        return " or ".join(map(_words, arguments))
    if kind is Literal:
        return " or ".join(map(repr, arguments))
    if kind is Callable:
        return "a function"
    if kind is tuple and arguments[1:] == (Ellipsis,):
        return f"a tuple, in which each entry is {_words(arguments[0])}"
    if kind is tuple:
        return f"{len(arguments)} numbers in brackets, ({', '.join(['0.0'] * len(arguments))})"
    return f"a {getattr(hint, '__name__', hint)}"


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _LONGEST else f"{type(value).__name__} {getattr(value, 'name', '')!r}"
