"""Attachment of parts to bodies: ends as objects, everything behind them by keyword; and the old positional form.

A part keeps names of bodies and points from their centres of mass, as ever; here its arguments become these. Why it is
done in one place, and what becomes of the old form: docs/decisions/040-ends-as-objects.md.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import MISSING, Field, fields
from functools import cache
from inspect import Parameter, Signature
from typing import Any, ClassVar, Literal, NamedTuple, cast

from .body import GROUND, Body, End, Point
from .errors import MechanismError
from .findings import length
from .functions import Number, atan2, is_plain, where_positive
from .quantities import with_texts


class OldFormWarning(PendingDeprecationWarning):
    """A part is written with points or numbers by position, which goes after the next version."""


class Slot(NamedTuple):
    """One end of a part: which of its fields it fills.

    Attributes:
        body: the field with the name of the body, by which the end is called, too, unless `name` is given.
        point: the field with the point; None where the part is attached to the body as a whole.
        direction: the field with the direction of a line; None where the end is a point.
        kind: whether that is a vector along the line, the unit normal to its left, or its angle.
        name: of the argument.
        outline: the field with the outline that the body has there, in the frame in which it is drawn.
    """

    body: str
    point: str | None = None
    direction: str | None = None
    kind: Literal["vector", "normal", "angle"] = "vector"
    name: str = ""
    outline: str = ""

    @property
    def argument(self) -> str:
        """The name of the argument."""
        return self.name or self.body


class _OfEnds:
    """The signature of a part: its name and its ends, then all else by keyword."""

    def __get__(self, part: object, kind: type[Attached]) -> Signature:
        return Signature([*_parameters(kind)])


class Attached:
    """A part of a mechanism that is attached to bodies.

    Its first argument is its name, then come its ends, which are made by `at` or `line` of a body or of `GROUND`, or
    are the body alone where the part acts on it as a whole, or at the origin of its frame; all else by keyword. Numbers
    of which `units` says the unit may be texts, such as "5 mm".

    Attributes:
        slots: its ends.
        units: SI units of its numbers, by field.

    Raises:
        TypeError: an argument is missing, or there is no such one.
        MechanismError: an end or a number is of the wrong kind.
    """

    slots: ClassVar[tuple[Slot, ...]]
    units: ClassVar[Mapping[str, str]] = {}
    __signature__: ClassVar[Any] = _OfEnds()

    def __init__(self, *arguments: Any, **named: Any) -> None:
        kind = type(self)
        values = {**_by_name(kind, arguments, named), **named}
        label = f"{kind.__name__} {values.get('name', '')!r}"
        for slot in kind.slots:
            values.update(_filled(label, slot, values.pop(slot.argument, MISSING), values))
        for name, unit in kind.units.items():
            if isinstance(values.get(name), str | tuple | list):
                values[name] = with_texts(values[name], unit, f"{label}: {name}")
        for name, value in _complete(kind, values).items():
            object.__setattr__(self, name, value)


@cache
def _fields(kind: Any) -> tuple[Field[Any], ...]:
    return fields(kind)


def _by_name(kind: type[Attached], arguments: tuple[Any, ...], named: Mapping[str, Any]) -> dict[str, Any]:
    """Positional arguments by name: name and ends, or, in the old form, the fields in their order."""
    ends = ["name", *(slot.argument for slot in kind.slots)]
    order = [field.name for field in _fields(cast(Any, kind)) if not field.kw_only]
    is_new = any(isinstance(value, Body | End) for value in (*arguments, *named.values()))
    if is_new or (len(arguments) <= len(ends) and all(isinstance(value, str) for value in arguments)):
        if len(arguments) > len(ends):
            raise TypeError(
                f"{kind.__name__}.__init__() takes {', '.join(ends)} by position, but {len(arguments)} were given; "
                "give what is behind the ends by keyword"
            )
        order = ends
    elif order[: len(arguments)] != ends[: len(arguments)]:
        warnings.warn(_old_form(kind, arguments), OldFormWarning, stacklevel=3)
    if len(arguments) > len(order):
        raise TypeError(f"{kind.__name__}.__init__() takes {len(order)} arguments, but {len(arguments)} were given.")
    given = dict(zip(order, arguments, strict=False))
    for name in given:
        if name in named:
            raise TypeError(f"{kind.__name__}.__init__() got multiple values for argument {name!r}")
    return given


def _old_form(kind: type[Attached], arguments: tuple[Any, ...]) -> str:
    ends = ", ".join(
        f"{slot.argument}.line(...)" if slot.direction else f"{slot.argument}.at(x, y)" if slot.point else slot.argument
        for slot in kind.slots
    )
    return (
        f"{kind.__name__} {arguments[0]!r} is written in the old form, with points and numbers by position, which goes "
        f"after the next version; write {kind.__name__}(name, {ends}, ...=...)."
    )


def _filled(label: str, slot: Slot, end: Any, values: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a part that an end fills."""
    if end is MISSING:
        return {}
    if not isinstance(end, Body | End):
        if slot.point is not None and end == GROUND and isinstance(end, str) and slot.argument == slot.body:
            return {slot.argument: end} if slot.point in values else {slot.argument: end, slot.point: (0.0, 0.0)}
        return {slot.argument: end}
    whole = isinstance(end, Body)
    end = end.at(0.0, 0.0) if isinstance(end, Body) else end
    if slot.point is None:
        if not whole:
            raise MechanismError(
                f"{label} is attached to {end.body!r} as a whole, not to a point of it; give the body itself."
            )
        attached: dict[str, Any] = {slot.body: end.body}
        x, y = end.point  # how far the origin of the frame is from the centre of mass
        if slot.outline in values and not all(is_plain(n) and n == 0.0 for n in (x, y)):
            attached[slot.outline] = values[slot.outline].moved(x, y)
        return attached
    if values.get(slot.body, end.body) != end.body:
        raise MechanismError(f"{label} is attached to {values[slot.body]!r} and {end.body!r}; give ends of one body.")
    found = {slot.body: end.body}
    for name, value in ((slot.point, end.point), (slot.direction, end.direction)):
        if name is None and value is not None:
            raise MechanismError(f"{label}: at {end.body!r} it takes a point, not a line; write at(x, y).")
        if name is None or value is None:
            continue
        if name in values and not whole:
            raise MechanismError(f"{label}: {name} is given twice, by the end and by keyword; leave one of them out.")
        found[name] = _directed(slot.kind, value) if name == slot.direction else values.get(name, value)
    return found


def _directed(kind: str, direction: Point) -> Any:
    x, y = direction
    if kind == "angle":
        return atan2(y, x)
    if kind == "vector":
        return direction
    long = length(direction)
    size: Number = where_positive(long, long, 1.0)  # of no direction, the part itself says that its normal has none
    return ((0.0 - y) / size, x / size)  # not -y: of a level line, that is -0


def _complete(kind: type[Attached], values: Mapping[str, Any]) -> dict[str, Any]:
    """All fields in their order, with the defaults of those that are not given."""
    every = {field.name: field for field in _fields(cast(Any, kind))}
    if values.keys() == every.keys():
        return {name: values[name] for name in every}
    unknown = [name for name in values if name not in every]
    if unknown:
        raise TypeError(f"{kind.__name__}.__init__() got an unexpected keyword argument {unknown[0]!r}")
    missing = [name for name, field in every.items() if name not in values and field.default is MISSING]
    for slot in kind.slots:
        if slot.body in values and (slot.point in missing or slot.direction in missing):
            shape, how = ("line", "line((x, y), (dx, dy))") if slot.direction in missing else ("point", "at(x, y)")
            given = values[slot.body]
            of = repr(given) if isinstance(given, str) else f"a body there, but {given!r} was given"
            label = f"{kind.__name__} {values.get('name', '')!r}"
            raise MechanismError(
                f"{label} takes a {shape} of {of}; write {slot.argument}.{how}, with the body or GROUND."
            )
    if missing:
        names = ", ".join(map(repr, missing))
        plural = "s" if len(missing) > 1 else ""
        raise TypeError(f"{kind.__name__}.__init__() missing {len(missing)} required argument{plural}: {names}")
    return {name: values.get(name, field.default) for name, field in every.items()}


def _parameters(kind: type[Attached]) -> list[Parameter]:
    filled = {name for slot in kind.slots for name in slot[:3]} - {"name"}
    every = {field.name: field for field in _fields(cast(Any, kind))}

    def default(name: str) -> Any:
        found = every[name].default if name in every else MISSING
        return Parameter.empty if found is MISSING else found

    ends = [Parameter("name", Parameter.POSITIONAL_OR_KEYWORD)]
    ends += [
        Parameter(slot.argument, Parameter.POSITIONAL_OR_KEYWORD, default=default(slot.body)) for slot in kind.slots
    ]
    others = [name for name in every if name not in filled and name != "name"]
    return [*ends, *(Parameter(name, Parameter.KEYWORD_ONLY, default=default(name)) for name in others)]
