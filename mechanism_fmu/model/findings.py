"""Findings: conditions on numbers, plain or symbolic, with texts of what is wrong and the way out."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import lru_cache
from string import Formatter

from .errors import MechanismError
from .functions import Number, is_plain, sqrt, where_positive

# Conditions on numbers that may be symbolic: positive where they hold, and not where a number is NaN.
#
# Limits of a parameter may be known (`Symbol.limits`): a condition that all values within them meet is the number 1.


def plain(x: Number) -> Number:
    """A plain number as a float, which numpy never warns about; any other as it is."""
    return float(x) if is_plain(x) else x


def unless(condition: Number) -> Number:
    """1 where `condition` is not positive, also where it is NaN; else 0."""
    return where_positive(condition, 0.0, 1.0)


def both(a: Number, b: Number) -> Number:
    """Where `a` and `b` hold."""
    if is_plain(b):
        a, b = b, a  # what is known records nothing
    return where_positive(a, b, 0.0)


def finite(*numbers: Number) -> Number:
    """Where all numbers are finite; parameters with known limits are."""
    known = [float(x) for x in numbers if is_plain(x)]
    holds: Number = 1.0 if all(map(math.isfinite, known)) else 0.0
    for x in numbers:
        if not is_plain(x) and _limits(x) is None:
            holds = holds + (x - x)
    return holds


def positive(x: Number) -> Number:
    """Where 0 < x, which may be infinite."""
    return 1.0 if _is_known(x, above=0.0) else plain(x)


def not_negative(x: Number) -> Number:
    """Where 0 <= x, which may be infinite."""
    return 1.0 if _is_known(x, low=0.0) else where_positive(-plain(x), 0.0, plain(x) + 1.0)


def finite_positive(x: Number) -> Number:
    """Where 0 < x < infinity."""
    return both(positive(x), finite(x))


def finite_not_negative(x: Number) -> Number:
    """Where 0 <= x < infinity."""
    return 1.0 if _is_known(x, low=0.0) else where_positive(-plain(x), 0.0, finite(x))


def not_zero(x: Number) -> Number:
    """Where x > 0 or x < 0."""
    return 1.0 if _is_known(x, above=0.0) else where_positive(plain(x), 1.0, -plain(x))


def is_zero(x: Number) -> Number:
    """Where x = 0."""
    return where_positive(plain(x), 0.0, not_negative(x))


def within(x: Number, low: float, high: float) -> Number:
    """Where low <= x <= high, for finite limits."""
    if _is_known(x, low=low, high=high):
        return 1.0
    return where_positive(low - plain(x), 0.0, where_positive(plain(x) - high, 0.0, finite(x)))


def true_or_false(x: Number) -> Number:
    """Where x is 0 or 1; nowhere else does rounding make the product 0."""
    if _is_known(x, low=0.0, high=1.0, whole=True):
        return 1.0
    return is_zero(plain(x) * (1.0 - plain(x)))


def length(vector: tuple[Number, Number]) -> Number:
    """Length of a vector."""
    x, y = map(plain, vector)
    return sqrt(x * x + y * y)


def size(x: Number) -> Number:
    """|x|; never a negative zero, which a message would show."""
    return where_positive(-plain(x), -plain(x), plain(x))


def _limits(x: Number) -> Number:
    return getattr(x, "limits", None)


def _is_known(
    x: Number, low: float = -math.inf, high: float = math.inf, above: float = -math.inf, whole: bool = False
) -> bool:
    """Whether x is a parameter whose limits keep it within `low`..`high`, above `above`, and whole."""
    limits = _limits(x)
    if limits is None:
        return False
    return bool(low <= limits.low and limits.high <= high and above < limits.low and whole <= limits.whole)


# What is wrong, or odd, with parameter values: as data, so that it can be asked, shown, and traced like the tables.

__all__ = ["Finding", "at_most", "either", "first", "refuse", "refuse_unless", "where"]

#: Most numbers in one text: code without Python always hands so many to printf.
MOST_NUMBERS = 8

_FORMAT = re.compile(r"(\.[0-9]+)?g")


@dataclass(frozen=True)
class Finding:
    """Something to be said of parameter values, where it applies.

    Attributes:
        applies: positive where it is to be said, a number of unit 1.
        text: a `str.format` template for the user; its fields, in the order of `numbers`, are `{:g}` or `{:.6g}` (or
            another count of digits), which Python and C write alike.
        numbers: what the text shows, in the units that it names, at most `MOST_NUMBERS`; they must be free of errors (a
            root of a negative number, a division by zero) also where the finding does not apply.

    Raises:
        MechanismError: text and numbers do not fit together, or the text has other fields.
    """

    applies: Number
    text: str
    numbers: tuple[Number, ...] = ()

    def __post_init__(self) -> None:
        fields = sum(form is not None for _, form in pieces(self.text))
        if fields != len(self.numbers):
            raise MechanismError(
                f"Finding {self.text!r} has {fields} fields for {len(self.numbers)} numbers; give as many of each."
            )
        if fields > MOST_NUMBERS:
            raise MechanismError(
                f"Finding {self.text!r} shows {fields} numbers; {MOST_NUMBERS} is the most: say less, or make it two."
            )

    @property
    def message(self) -> str:
        """The text with its numbers, which must be plain ones."""
        return self.text.format(*self.numbers)


@lru_cache(maxsize=4096)  # the same few hundred, each time that a mechanism is made
def pieces(text: str) -> tuple[tuple[str, str | None], ...]:
    """A finding's text in pieces: what is said as it is, and the format of the number behind it (None: no number).

    Raises:
        MechanismError: a field is none of those that C can write.
    """
    try:
        parsed = list(Formatter().parse(text))
    except ValueError as error:
        raise MechanismError(f"Finding {text!r} is no template of str.format: {error}.") from error
    for _, name, form, conversion in parsed:
        if name is not None and (name or conversion or not _FORMAT.fullmatch(form or "")):
            raise MechanismError(f"Finding {text!r} has a field that is neither {{:g}} nor like {{:.6g}}; use these.")
    return tuple((plain, form if name is not None else None) for plain, name, form, _ in parsed)


def messages(findings: Iterable[Finding]) -> list[str]:
    """The messages of those findings, of plain numbers, that apply."""
    return [finding.message for finding in findings if finding.applies > 0]


def literal(text: str) -> str:
    """A text to stand as it is in the text of a finding, e.g. a name."""
    return text.replace("{", "{{").replace("}", "}}")


def refuse_unless(condition: Number, text: str, *numbers: Number) -> Finding:
    """The finding that applies where `condition` is not positive, also where it is NaN.

    Args:
        condition: as of `Finding.applies`, but of what must hold.
        text: as of `Finding`.
        *numbers: as of `Finding`.
    """
    return Finding(unless(condition), text, tuple(map(plain, numbers)))


def where(condition: Number, *findings: Finding) -> tuple[Finding, ...]:
    """The findings, applying only where `condition` is positive too.

    Args:
        condition: positive where they may apply, else 0; a number of unit 1.
        findings: those that apply in addition only where they did.
    """
    applying = [where_positive(condition, f.applies, 0.0) for f in findings]
    return tuple(f if a is f.applies else replace(f, applies=a) for f, a in zip(findings, applying, strict=True))


def first(*findings: Finding) -> tuple[Finding, ...]:
    """The findings, each applying only where none before it does.

    Args:
        findings: in the order in which they are asked.
    """
    silent: Number = 1.0
    exclusive: list[Finding] = []
    for finding in findings:
        exclusive += where(silent, finding)
        silent = where_positive(finding.applies, 0.0, silent)
    return tuple(exclusive)


def refuse(finding: Finding) -> None:
    """Refuse parameter values where a finding applies, from within a helper of a model's function.

    Of plain numbers it is said at once; of the symbols of a trace, it becomes one of the trace's objections, so that a
    target without Python says the same.

    Args:
        finding: of the numbers that the helper was given.

    Raises:
        MechanismError: it applies to plain numbers.
    """
    if not is_plain(finding.applies):
        if hasattr(finding.applies, "refuse"):
            finding.applies.refuse(finding)
    elif finding.applies > 0:
        raise MechanismError(finding.message)


def at_most(a: Number, b: Number) -> Number:
    """A condition: 1 where a <= b, else 0.

    Args:
        a: numbers of one unit.
        b: numbers of one unit.

    Source: definition.
    """
    return where_positive(a - b, 0.0, 1.0)


def either(a: Number, b: Number) -> Number:
    """A condition: positive where `a` or `b` is.

    Args:
        a: conditions, numbers of unit 1.
        b: conditions, numbers of unit 1.

    Source: definition.
    """
    return where_positive(a, a, b)
