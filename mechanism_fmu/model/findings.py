"""What is wrong, or odd, with parameter values: as data, so that it can be asked, shown, and traced like the tables."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from string import Formatter

from .conditions import plain, unless
from .errors import MechanismError
from .functions import Number, where_positive

__all__ = ["Finding", "at_most", "either", "first", "refuse_unless", "where"]

#: Most numbers in one text: code without Python always hands so many to printf.
MOST_NUMBERS = 8

_FORMAT = re.compile(r"(\.[0-9]+)?g")


@dataclass(frozen=True)
class Finding:
    """Something to be said of parameter values, where it applies.

    Attributes:
        applies: positive where it is to be said.
        text: a `str.format` template for the user; its fields, in the order of `numbers`, are `{:g}` or `{:.6g}` (or
            another count of digits), which Python and C write alike.
        numbers: what the text shows, at most `MOST_NUMBERS`; they must be free of errors (a root of a negative number,
            a division by zero) also where the finding does not apply.

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


def pieces(text: str) -> list[tuple[str, str | None]]:
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
    return [(plain, form if name is not None else None) for plain, name, form, _ in parsed]


def messages(findings: Iterable[Finding]) -> list[str]:
    """The messages of those findings, of plain numbers, that apply."""
    return [finding.message for finding in findings if finding.applies > 0]


def literal(text: str) -> str:
    """A text to stand as it is in the text of a finding, e.g. a name."""
    return text.replace("{", "{{").replace("}", "}}")


def refuse_unless(condition: Number, text: str, *numbers: Number) -> Finding:
    """The finding that applies where `condition` is not positive, also where it is NaN."""
    return Finding(unless(condition), text, tuple(map(plain, numbers)))


def where(condition: Number, *findings: Finding) -> tuple[Finding, ...]:
    """The findings, applying only where `condition` is positive too."""
    return tuple(replace(f, applies=where_positive(condition, f.applies, 0.0)) for f in findings)


def first(*findings: Finding) -> tuple[Finding, ...]:
    """The findings, each applying only where none before it does."""
    silent: Number = 1.0
    exclusive: list[Finding] = []
    for finding in findings:
        exclusive += where(silent, finding)
        silent = where_positive(finding.applies, 0.0, silent)
    return tuple(exclusive)


def at_most(a: Number, b: Number) -> Number:
    """A condition: 1 where a <= b, else 0."""
    return where_positive(a - b, 0.0, 1.0)


def either(a: Number, b: Number) -> Number:
    """A condition: positive where `a` or `b` is."""
    return where_positive(a, a, b)
