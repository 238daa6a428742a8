"""Analyses that an FMU declares: `resources/analysis.json`, when it has one."""

from __future__ import annotations

import sys
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .resources import FlawError, parsed

#: A number in SI units, or the name of a parameter or calculated parameter.
Quantity = float | str
#: One, or a column of a table of them.
Size = Quantity | tuple[Quantity, ...]

#: Path within the FMU.
FILE = "resources/analysis.json"

#: What is said where nothing leaves a stress, and how it is to be had.
NO_BEAM = (
    "the FMU declares no beam that impacts strike. In its model, add Model(analysis=(ImpactStress(...),)) and build it "
    "again: docs/how-to/stress-in-a-part.md."
)

#: Columns of a table, which are a beam's sizes.
COLUMNS = ("places", "areas", "second_moments", "outer_fibres")
#: Sizes of each kind of beam, as of `mechanism_fmu.stress`; a thickness may come besides.
SIZES = {
    "WedgeTooth": ("length", "apex_angle"),
    "TrapezoidTooth": ("length", "root_height", "tip_height"),
    "RectangularTooth": ("length", "height"),
    "TableBeam": COLUMNS,
}
_THICKNESS = "thickness"


@dataclass(frozen=True)
class Struck:
    """The beam that impacts strike.

    Attributes:
        kind: of beam, one of `SIZES`.
        sizes: of the beam, by what they are.
        name, plural: what the beam is called.
        body, striker: that carries the beam, and that strikes it.
        jump: field of the records of impacts with v_I [m/s].
        slenderness: calculated parameter with length over root height; "" when there is none.
        strokes: output that counts strokes; "" when none does.
    """

    kind: str
    sizes: Mapping[str, Size]
    name: str
    plural: str
    body: str
    striker: str
    jump: str
    slenderness: str = ""
    strokes: str = ""

    @property
    def variables(self) -> tuple[str, ...]:
        """The variables that hold its sizes."""
        columns = (size if isinstance(size, tuple) else (size,) for size in self.sizes.values())
        return tuple(dict.fromkeys(one for column in columns for one in column if isinstance(one, str)))

    @property
    def held(self) -> str:
        """What is said of an impact without a jump, instead of a stress."""
        return f"{self.body} held"


@dataclass(frozen=True)
class Link:
    """An elastic bar of the compliance: its name, its numbers and its outputs, by what they are."""

    name: str
    numbers: Mapping[str, Quantity]
    outputs: Mapping[str, str]


@dataclass(frozen=True)
class Chain:
    """An arm and a strut in series that push a wheel.

    Attributes:
        contact: number of the contact of the strut's tip with a face.
        arm, strut: from the drive on.
        wheel: that is pushed.
        tooth: what a part of its rim is called.
        struck: field of the records of impacts with the number of the root that is struck.
        restitution: of the contact [1].
        source: where the reader finds the formulas; "" when nowhere.
    """

    contact: int
    arm: Link
    strut: Link
    wheel: Link
    tooth: str
    struck: str
    restitution: Quantity
    source: str = ""

    @property
    def variables(self) -> tuple[str, ...]:
        """The variables that hold its numbers."""
        numbers = [*(n for link in self.links for n in link.numbers.values()), self.restitution]
        return tuple(number for number in numbers if isinstance(number, str))

    @property
    def outputs(self) -> tuple[str, ...]:
        """The outputs that it needs."""
        return tuple(name for link in self.links for name in link.outputs.values())

    @property
    def links(self) -> tuple[Link, Link, Link]:
        """Arm, strut and wheel."""
        return self.arm, self.strut, self.wheel


@dataclass(frozen=True)
class Declared:
    """What an FMU declares.

    Attributes:
        struck: what impacts strike; None when it declares nothing of the kind.
        chain: what gives way; None likewise.
        objection: why what it declares cannot be used, for the user; "" when nothing is wrong.
    """

    struck: Struck | None = None
    chain: Chain | None = None
    objection: str = ""


NOTHING = Declared()


def value_of(quantity: Quantity, values: Mapping[str, Any]) -> float:
    """The number, or that of the variable."""
    return float(values[quantity]) if isinstance(quantity, str) else quantity


def size_of(size: Size, values: Mapping[str, Any]) -> float | tuple[float, ...]:
    """The number or the column of numbers."""
    return tuple(value_of(one, values) for one in size) if isinstance(size, tuple) else value_of(size, values)


def read_declared(path: Path, variables: Mapping[str, object]) -> Declared:
    """What the FMU file `path`, with these variables, declares; what cannot be used is an objection and no error."""
    try:
        with zipfile.ZipFile(path) as archive:
            text = archive.read(FILE).decode("utf-8")
    except KeyError:
        return NOTHING
    except (OSError, RuntimeError, EOFError, zipfile.BadZipFile, zlib.error, UnicodeDecodeError) as error:
        return _objection(f"it cannot be read ({error})")
    try:
        return _declared(parsed(text, "analyses")["analyses"], variables)
    except (ValueError, RecursionError) as error:
        return _objection(str(error))


def _objection(problem: str) -> Declared:
    return Declared(
        objection=f"What the FMU declares to be analysed ({FILE}) cannot be used: {problem}. Build the FMU again."
    )


def _declared(entries: list[Any], variables: Mapping[str, object]) -> Declared:
    if not all(isinstance(entry, dict) for entry in entries):
        raise FlawError("it holds no list of analyses")
    found: dict[str, Any] = {}
    for entry in entries:
        kind = entry.get("kind")
        reader = _Reader(str(kind), variables)
        if kind == "ImpactStress":
            found["struck"] = _struck(reader, entry)
        elif kind == "SeriesCompliance":
            found["chain"] = _chain(reader, entry)
        else:
            raise FlawError(f"an analysis is of the unknown kind {kind!r}")
    return Declared(**found)


@dataclass(frozen=True)
class _Reader:
    """Reads entries of one analysis.

    Attributes:
        label: of the analysis.
        variables: of the FMU.
    """

    label: str
    variables: Mapping[str, object] = field(repr=False)

    def text(self, entry: Any, key: str, default: str | None = None) -> str:
        value = entry.get(key, default) if isinstance(entry, dict) else None
        if not isinstance(value, str) or (not value and default is None):
            raise FlawError(f"{key} of {self.label} is {value!r}, and no text")
        return value

    def column(self, entry: Any, key: str) -> tuple[Quantity, ...]:
        value = entry.get(key)
        if not isinstance(value, list):
            raise FlawError(f"{key} of {self.label} is {value!r}, and no list")
        return tuple(self.quantity({key: one}, key) for one in value)

    def quantity(self, entry: Any, key: str) -> Quantity:
        value = entry.get(key) if isinstance(entry, dict) else None
        if isinstance(value, str):
            return self.variable(entry, key)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= sys.float_info.max:
            raise FlawError(f"{key} of {self.label} is {value!r}, neither a number nor the name of a variable")
        return float(value)

    def variable(self, entry: Any, key: str) -> str:
        name = self.text(entry, key)
        if name not in self.variables:
            raise FlawError(f"{key} of {self.label} is the variable '{name}', which the FMU has not")
        return name

    def link(self, entry: Any, numbers: tuple[str, ...], outputs: tuple[str, ...]) -> Link:
        return Link(
            self.text(entry, "name"),
            {key: self.quantity(entry, key) for key in numbers},
            {key: self.variable(entry, key) for key in outputs},
        )


def _struck(read: _Reader, entry: Mapping[str, Any]) -> Struck:
    beam = entry.get("beam")
    kind = read.text(beam, "kind")
    if kind not in SIZES or not isinstance(beam, dict):
        raise FlawError(f"its beam is of the unknown kind {kind!r}")
    sizes = SIZES[kind] + ((_THICKNESS,) if _THICKNESS in beam else ())
    return Struck(
        kind,
        {size: (read.column if size in COLUMNS else read.quantity)(beam, size) for size in sizes},
        name=read.text(entry, "name"),
        plural=read.text(entry, "plural"),
        body=read.text(entry, "body"),
        striker=read.text(entry, "striker"),
        jump=read.text(entry, "jump"),
        slenderness=read.variable(entry, "slenderness") if "slenderness" in entry else "",
        strokes=read.variable(entry, "strokes") if "strokes" in entry else "",
    )


def _chain(read: _Reader, entry: Mapping[str, Any]) -> Chain:
    contact = entry.get("contact")
    if not isinstance(contact, int) or isinstance(contact, bool):
        raise FlawError(f"contact of {read.label} is {contact!r}, and no number of a contact")
    bar, wheel = ("length", "width", "depth", "stiffness"), entry.get("wheel")
    return Chain(
        contact,
        read.link(entry.get("arm"), bar, ("angle",)),
        read.link(entry.get("strut"), bar, ("angle", "deflection", "stress")),
        read.link(
            wheel,
            ("radius", "pitch", "slope_angle", "apex_angle"),
            ("angle", "index", "slope_force", "face_force"),
        ),
        read.text(wheel, "tooth"),
        read.text(wheel, "struck"),
        read.quantity(entry, "restitution"),
        read.text(entry, "source", ""),
    )
