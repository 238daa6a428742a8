"""Error messages for a user's model file: where the mistake is, in plain words, and the way out."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from difflib import get_close_matches
from inspect import signature
from pathlib import Path
from types import SimpleNamespace

from ... import model as public
from ...model import MechanismError
from ..instance.self_check import StartError
from ..parts.contents import OWN

#: Functions that make ports from the name of a part.
_BUILDER = re.compile(r"_(input|output|parameter)s?$")
#: Functions that make bodies.
_SOLIDS = ("bar", "plate", "disc", "rigid_body")


@contextmanager
def explained(path: Path) -> Iterator[None]:
    """Turn whatever a user's file raises into one message.

    Raises:
        MechanismError: the mistake, with file and, where it is known, line.
    """
    try:
        yield
    except MechanismError as error:
        text = str(error)
        if text.startswith(str(path)):
            raise
        raise MechanismError(f"{_place(error) or _part(text, path) or path}: {text}") from error
    except SyntaxError as error:
        shown = f" ({error.text.strip()})" if error.text else ""
        place = f"{error.filename or path}, line {error.lineno}"
        raise MechanismError(f"{place}{shown}: this is no Python: {error.msg}.") from error
    except (Exception, SystemExit) as error:
        raise MechanismError(f"{_place(error) or path}: {_in_words(error, path)}") from error


@contextmanager
def explained_in_fmu(path: Path) -> Iterator[None]:
    """Say of what only comes up in the FMU, where a user's file runs again and starts, that it is about this file.

    Raises:
        MechanismError: the mistake, with the file; errors that are not the file's pass.
    """
    try:
        yield
    except StartError as error:
        raise MechanismError(f"{path}: {error}") from error
    except MechanismError:
        raise
    except Exception as error:
        place = _last_place(error, lambda module: ".models." in module)
        if not place:
            raise
        raise MechanismError(
            f"{path.parent / Path(place).name}: in the FMU, where the file runs again from another folder, it raises "
            f"{type(error).__name__}: {error}. An FMU by pythonfmu takes along nothing but Python files; write numbers "
            "into one, or build with --flavour native."
        ) from error


def _place(error: BaseException) -> str:
    """File and line of the user's in which an error came up; "" when it was elsewhere."""
    return _last_place(error, lambda module: module.startswith(OWN))


def _last_place(error: BaseException, is_own: Callable[[str], bool]) -> str:
    place, trace = "", error.__traceback__
    while trace is not None:
        if is_own(str(trace.tb_frame.f_globals.get("__name__", ""))):
            place = f"{trace.tb_frame.f_code.co_filename}, line {trace.tb_lineno}"
        trace = trace.tb_next
    return place


def _part(text: str, path: Path) -> str:
    """File and line where the part stands that a message begins with, e.g. "Body 'arm': ..."; "" if not in there."""
    named = re.match(r"(?:(?P<kind>[A-Z]\w*) '(?P<part>[^']+)'|(?P<variable>\w+)(?: =|:))", text)
    if named is None:
        return ""
    tree = ast.parse(path.read_text(encoding="utf-8-sig"))
    name = named["part"] or named["variable"]
    every = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    # A builder of ports is given "motor", and makes "motor_torque".
    built = [call for call in every if _BUILDER.search(ast.unparse(call.func)) and _begins(name, call)]
    calls = [call for call in every if name in _names_given(call)] or built
    kinds = (named["kind"], *(_SOLIDS if named["kind"] == "Body" else ()))
    of_kind = [call for call in calls if ast.unparse(call.func) in kinds]
    # Of two parts with one name, the second is the one too many.
    lines = [call.lineno for call in of_kind or calls]
    return f"{path}, line {max(lines)}" if lines else ""


def _begins(name: str, call: ast.Call) -> bool:
    return any(isinstance(given, str) and name.startswith(f"{given}_") for given in _names_given(call))


def _names_given(call: ast.Call) -> Iterator[object]:
    """What may be the name of the part that a call makes: its first argument or its keyword `name`."""
    for value in (*call.args[:1], *(word.value for word in call.keywords if word.arg == "name")):
        if isinstance(value, ast.Constant):
            yield value.value


def _in_words(error: BaseException, path: Path) -> str:
    match error:
        case ModuleNotFoundError():
            return _no_module(error.name or "", path)
        case ImportError(name=str(module)) if module.startswith("mechanism_fmu"):
            name = re.search(r"cannot import name '(\w+)'", str(error))
            return f"{module} has no {name[1]!r}{_near(name[1], public.__all__)}" if name else str(error)
        case NameError(name=str(name)) if name in public.__all__:
            return f"{name} is not imported; write: from mechanism_fmu.model import {name}."
        case NameError(name=str(name)):
            return f"the name {name!r} is not defined{_near(name, public.__all__)}"
        case AttributeError(obj=SimpleNamespace() as values, name=str(name)):
            known = ", ".join(vars(values)) or "none"
            return f"there is no parameter {name!r}{_near(name, vars(values))} There are: {known}."
        case TypeError():
            return _wrong_call(str(error))
        case SystemExit():
            return "the file ends Python (exit); remove that."
        case _:
            return f"{type(error).__name__}: {error}"


def _no_module(name: str, path: Path) -> str:
    top = name.partition(".")[0]
    if (path.parent / f"{top}.py").is_file():
        return f"there is no module {name!r}, but a file {top}.py beside it: write 'from .{top} import ...'."
    if top.startswith(OWN):
        return f"there is no file {name.partition('.')[2].replace('.', '/')}.py beside it."
    if top == "mechanism_fmu":
        return f"there is no module {name!r}; write 'from {public.__name__} import ...', where all parts are."
    return (
        f"there is no package {top!r} in this Python. Do without it if you can: an FMU by pythonfmu can ask for "
        "nothing but what mechanism_fmu needs itself (numpy). For the native flavour, install it."
    )


def _wrong_call(text: str) -> str:
    """A call with arguments that a part or a builder does not have, with those that it has."""
    called = re.match(r"(\w+)(?:\.__init__)?\(\) (.*)", text)
    part = getattr(public, called[1], None) if called else None
    if called is None or not callable(part):
        return f"TypeError: {text}"
    names = list(signature(part).parameters)
    unknown = re.search(r"unexpected keyword argument '(\w+)'", text)
    near = _near(unknown[1], names) if unknown else "."
    return f"{called[1]} {called[2]}{near} It takes {', '.join(names)}."


def _near(name: str, known: Iterable[str]) -> str:
    """The end of a sentence: a question for the nearest of the known names, if any is near."""
    near = get_close_matches(name, list(known), 1)
    return f"; did you mean {near[0]!r}?" if near else "."
