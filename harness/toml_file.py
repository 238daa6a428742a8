"""TOML files whose mistakes are all listed at once, each with its line; and the values of variables in them."""

from __future__ import annotations

import math
import re
import sys
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .errors import UsageError
from .fmu.description import Description, Value, Variable, hint_at
from .fmu.values import parse_value

# TOML files whose mistakes are listed all at once, each with its line.

#: Where something stands in a file: names of tables, then of the key.
Key = tuple[str, ...]

_TABLE = re.compile(r"\s*(\[\[?)\s*([^\[\]]+?)\s*\]\]?\s*(#.*)?")
_ASSIGNMENT = re.compile(r"""\s*((?:[\w.\s-]|"[^"]*"|'[^']*')+?)\s*=""")
_NAME = re.compile(r"""\s*(?:"([^"]*)"|'([^']*)'|([\w-]+))\s*(?:\.|$)""")

#: Tables and lists within one another; what is read here has four at most.
_DEEPEST = 20
_NESTING = f"at most {_DEEPEST} may, and no file of this project needs more than four"
#: Letters of a line in which a name is looked for: a pattern takes a time that grows with their square.
_LONGEST_LINE = 1000
#: Letters of a value that a message shows.
_LONGEST = 60
#: A word of a mistake that nobody reads to its end; sentences quote names and values, some of them more than once.
_LONG_WORD = re.compile(r"(\S{300})\S{30,}")


@dataclass
class TomlFile:
    """A file that is being read, with the mistakes found in it so far.

    Attributes:
        path: of the file.
        data: what is in it.
        mistakes: what is wrong, in the order in which it was found: key and sentence.
    """

    path: Path
    data: Mapping[str, Any]
    mistakes: list[tuple[Key, str]] = field(default_factory=list)
    _lines: Mapping[Key, int] = field(default_factory=dict)

    @classmethod
    def read(cls, path: Path) -> TomlFile:
        """Read the file `path`.

        Raises:
            UsageError: it cannot be read, or is no TOML.
        """
        try:
            text = path.read_text(encoding="utf-8-sig")
        except FileNotFoundError:
            raise UsageError(f"There is no file '{path}'.") from None
        except (OSError, UnicodeDecodeError) as error:
            raise UsageError(f"'{path}' cannot be read: {error}.") from error
        try:
            data = tomllib.loads(text)
        except ValueError as error:  # also for a whole number of more than 4300 digits
            raise UsageError(f'{path}: this is no TOML: {error}. Texts stand in quotes, as in unit = "deg".') from None
        except RecursionError:
            raise UsageError(f"{path}: lists or tables stand within one another too deep; {_NESTING}.") from None
        if _depth(data) > _DEEPEST:
            raise UsageError(f"{path}: {_depth(data)} lists or tables stand within one another; {_NESTING}.")
        return cls(path, data, _lines=_lines_of(text))

    def wrong(self, key: Key, text: str) -> None:
        """Note a mistake; the same one only once."""
        text = _LONG_WORD.sub(r"\1 ...", text if text.endswith((".", "?")) else f"{text}.")
        if (key, text) not in self.mistakes:
            self.mistakes.append((key, text))

    def section(self, *key: str, needed: bool = True, why: str = "") -> Section:
        """The table at `key`, empty when there is none; that is a mistake if it is needed, `why` says what for."""
        table: Any = self.data
        for name in key:
            table = table.get(name) if isinstance(table, Mapping) else None
        given = table is not None
        if needed and not given:
            self.wrong(key, f"the table [{'.'.join(key)}] is missing; {why}")
        if given and not isinstance(table, Mapping):
            self.wrong(key, f"must be a table [{'.'.join(key)}], not {_shown(table)}")
        return Section(self, key, table if isinstance(table, Mapping) else {}, given)

    def sections(self, name: str) -> list[Section]:
        """The tables of an array of tables, [[name]], with keys like "name[1]"; empty when there is none."""
        tables = self.data.get(name, [])
        if not isinstance(tables, list) or not all(isinstance(table, Mapping) for table in tables):
            self.wrong((name,), f"must be tables, each below a line [[{name}]]")
            return []
        return [Section(self, _entry((name,), number), table) for number, table in enumerate(tables, start=1)]

    def only_tables(self, known: Sequence[str]) -> None:
        """Object to everything at the top of the file that is not among the `known` names."""
        for name in self.data:
            if name not in known:
                self.wrong((name,), f"is not known.{_hint(name, known)}")

    def place(self, key: Key) -> str:
        """Where the user finds `key`: file, line if it is in the file, and name."""
        for length in range(len(key), 0, -1):
            if key[:length] in self._lines:
                return f"{self.path}:{self._lines[key[:length]]}: {'.'.join(key)}"
        return f"{self.path}: {'.'.join(key)}"

    def check(self) -> None:
        """List all mistakes.

        Raises:
            UsageError: there are some.
        """
        if not self.mistakes:
            return
        ordered = sorted(self.mistakes, key=lambda mistake: self._line(mistake[0]))
        listed = [f"{self.place(key)}: {text}" for key, text in ordered]
        number = "a mistake" if len(listed) == 1 else f"{len(listed)} mistakes"
        raise UsageError("\n".join([f"{self.path.name} has {number}; nothing was run.", *listed]))

    def _line(self, key: Key) -> int:
        found = (self._lines[key[:length]] for length in range(len(key), 0, -1) if key[:length] in self._lines)
        return next(found, 0)


def is_number(value: Any) -> bool:
    """Whether a value of a file is a number that fits a double; true is none."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return isinstance(value, float) or abs(value) <= sys.float_info.max


@dataclass
class Section:
    """One table of a file; what has not been taken from it in the end is not known.

    Attributes:
        file: it stands in.
        key: of the table.
        table: what is in it.
        given: whether the file has it at all.
    """

    file: TomlFile
    key: Key
    table: Mapping[str, Any]
    given: bool = True
    _known: list[str] = field(default_factory=list)

    def wrong(self, name: str, text: str) -> None:
        """Note a mistake at a key of this table."""
        self.file.wrong((*self.key, name), text)

    def take(self, name: str, *, needed: str = "") -> Any:
        """What stands at a key, None when nothing does; `needed` says what to write there if it must not miss."""
        self._known.append(name)
        if name not in self.table and needed and self.given:
            self.wrong(name, f"is missing; {needed}")
        return self.table.get(name)

    def text(self, name: str, *, needed: str = "") -> str | None:
        """A text."""
        value = self.take(name, needed=needed)
        if value is None or isinstance(value, str):
            return value
        self._refused(name, value, "a text in quotes")
        return None

    def whole(self, name: str, *, least: int, most: int | None = None, needed: str = "") -> int | None:
        """A whole number from `least` to `most`."""
        value = self.take(name, needed=needed)
        if value is None:
            return None
        if not isinstance(value, int) or isinstance(value, bool) or value < least:
            self._refused(name, value, f"a whole number, {least} or more")
            return None
        if most is not None and value > most:
            self._refused(name, value, f"{most:,} or less")
            return None
        return value

    def number(self, name: str, default: float) -> float | None:
        """A number that is finite; None when it is none."""
        value = self.take(name)
        if value is None:
            return default
        if not is_number(value) or not math.isfinite(value):
            self._refused(name, value, "a number")
            return None
        return float(value)

    def flag(self, name: str) -> bool:
        """Whether something is so; it is not when nothing is said."""
        return self.flag_if_said(name) is True

    def flag_if_said(self, name: str) -> bool | None:
        """Whether something is so; None when nothing is said."""
        value = self.take(name)
        if value is None or isinstance(value, bool):
            return value
        self._refused(name, value, "true or false")
        return None

    def choice(self, name: str, among: Sequence[str], *, needed: str = "") -> str | None:
        """One of several texts."""
        value = self.take(name, needed=needed)
        if isinstance(value, str) and value in among:
            return value
        if value is not None:
            self._refused(name, value, f"one of {', '.join(among)}", hint_at(str(value), among))
        return None

    def texts(self, name: str) -> list[str]:
        """A list of texts, each there once."""
        value = self.take(name)
        if value is None:
            return []
        if not isinstance(value, list) or not all(isinstance(entry, str) for entry in value):
            self._refused(name, value, 'a list of texts, as in ["a", "b"]')
            return []
        for entry in value:
            if value.count(entry) > 1:
                self.wrong(name, f"'{entry}' is there twice; once is enough")
        return list(dict.fromkeys(value))

    def done(self) -> None:
        """Object to every key that nobody has taken."""
        for name in self.table:
            if name not in self._known:
                self.wrong(name, f"is not known.{_hint(name, self._known)}")

    def _refused(self, name: str, value: object, wanted: str, hint: str = "") -> None:
        self.wrong(name, f"is {_shown(value)}, but must be {wanted}.{hint}")


def _hint(name: str, known: Sequence[str]) -> str:
    return hint_at(name, known) or f" There are: {', '.join(known)}."


def _shown(value: object) -> str:
    """A value as TOML has it, as far as a message needs it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    text = f"'{value}'" if isinstance(value, str) else f"{value}"
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."


def _depth(data: object) -> int:
    """How many tables and lists stand within one another, the file itself not counted."""
    deepest, found = 0, [(data, 0)]
    while found:
        one, depth = found.pop()
        deepest = max(deepest, depth)
        entries = one.values() if isinstance(one, Mapping) else one if isinstance(one, list) else ()
        found += [(entry, depth + 1) for entry in entries if isinstance(entry, Mapping | list)]
    return deepest


def _lines_of(text: str) -> dict[Key, int]:
    """The line of each table and key. What stands in an inline table or a text of several lines is not looked for."""
    lines: dict[Key, int] = {}
    counts: dict[Key, int] = {}
    table: Key = ()
    for number, whole in enumerate(text.splitlines(), start=1):
        line = whole[:_LONGEST_LINE]
        heading, assignment = _TABLE.fullmatch(line), _ASSIGNMENT.match(line)
        if heading is not None:
            table = _names(heading[2])
            if heading[1] == "[[":
                counts[table] = counts.get(table, 0) + 1
                table = _entry(table, counts[table])
            lines.setdefault(table, number)
        elif assignment is not None:
            lines.setdefault((*table, *_names(assignment[1])), number)
    return lines


def _entry(name: Key, number: int) -> Key:
    """The key of one table of an array of tables."""
    return (*name[:-1], f"{name[-1]}[{number}]")


def _names(dotted: str) -> Key:
    return tuple("".join(match.groups(default="")) for match in _NAME.finditer(dotted))


# Values of variables as a TOML file has them: numbers, or texts with units.

#: Times of a file are parsed like variables.
_REFERENCE = -1


def parsed(section: Section, key: str, text: str, variable: Variable, description: Description) -> Value | None:
    """The value that `text` gives to `variable`; None when it cannot, which is noted at the key."""
    try:
        return parse_value(text, variable, description)
    except UsageError as error:
        section.wrong(key, str(error))
        return None


def as_text(value: object) -> str:
    """A value of TOML as it would be written behind --set."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else repr(value)


def time_at(section: Section, name: str, default: float | None, description: Description) -> float | None:
    """The time at a key [s]; None when it cannot be used, which is noted."""
    given = section.take(name)
    if given is None:
        if default is None:
            section.file.wrong((*section.key, name), f"is missing; {description.model} has no default for it")
        return default
    variable = Variable(name, _REFERENCE, "Real", "parameter", unit="s", minimum=0.0)
    alone = Description(description.model, "", "", {name: variable}, description.units)
    value = parsed(section, name, as_text(given), variable, alone)
    return None if value is None else float(value)
