"""What can be analysed of a run, in terms of the FMU's own variables, for whoever knows a mechanism only by its FMU.

A `Quantity` is a number in SI units, or the name of the parameter or calculated parameter that holds it.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass, fields, is_dataclass

from .drawing import Quantity
from .errors import MechanismError

#: Name of a parameter or calculated parameter, "" for none; of an output; of a field of the records of impacts.
HeldName = str
OutputName = str
RecordField = str


@dataclass(frozen=True)
class WedgeTooth:
    """The beam `mechanism_fmu.stress.WedgeTooth`, fixed at its root, with a sharp tip.

    Attributes:
        length: from root to tip [m].
        apex_angle: of the tip [rad].
        thickness: across the plane of the motion [m]; None is that of `mechanism_fmu.stress`, and the stress that an
            impact leaves does not depend on it.
    """

    length: Quantity
    apex_angle: Quantity
    thickness: Quantity | None = None


@dataclass(frozen=True)
class TrapezoidTooth:
    """The beam `mechanism_fmu.stress.TrapezoidTooth`, fixed at its root.

    Attributes:
        length: from root to tip [m].
        root_height, tip_height: in the plane of the motion [m].
        thickness: as of `WedgeTooth`.
    """

    length: Quantity
    root_height: Quantity
    tip_height: Quantity
    thickness: Quantity | None = None


@dataclass(frozen=True)
class RectangularTooth:
    """The beam `mechanism_fmu.stress.RectangularTooth`, fixed at its root: a uniform bar.

    Attributes:
        length: from root to tip [m].
        height: in the plane of the motion [m].
        thickness: as of `WedgeTooth`.
    """

    length: Quantity
    height: Quantity
    thickness: Quantity | None = None


@dataclass(frozen=True)
class TableBeam:
    """The beam `mechanism_fmu.stress.TableBeam`, fixed at its root, with any cross section.

    Between the places the section follows monotone cubics. It should change gradually: modes are polynomials along the
    whole beam, which near a step are off by half of the stress there.

    Attributes:
        places: distances from the root, ascending from 0 to the tip [m].
        areas: of the cross section at the places [m2].
        second_moments: of the cross section there, for bending in the plane of the motion [m4].
        outer_fibres: distances of the outer fibre from the neutral axis there [m].
        thickness: as of `WedgeTooth`.

    Raises:
        MechanismError: the columns differ in length, or have fewer than two rows.
    """

    places: tuple[Quantity, ...]
    areas: tuple[Quantity, ...]
    second_moments: tuple[Quantity, ...]
    outer_fibres: tuple[Quantity, ...]
    thickness: Quantity | None = None

    def __post_init__(self) -> None:
        """Refuse what is no table."""
        rows = [len(column) for column in (self.places, self.areas, self.second_moments, self.outer_fibres)]
        if min(rows) < 2 or len(set(rows)) > 1:
            raise MechanismError(
                f"TableBeam: {', '.join(map(str, rows))} places, areas, second moments and outer fibres; give as many "
                "of each, at root and tip at least."
            )

    @property
    def length(self) -> Quantity:
        """From root to tip [m]."""
        return self.places[-1]


#: Whatever can be struck.
StruckBeam = WedgeTooth | TrapezoidTooth | RectangularTooth | TableBeam


@dataclass(frozen=True)
class ImpactStress:
    """Bending stress and damage that impacts leave in a beam, which stands with its root on a body.

    The beam belongs to the body with a `tooth_length`, whose records of impacts then have v_I, that length times the
    jump of the body's speed. The jump makes the beam vibrate, whichever contact causes it, so impacts of all contacts
    count. Source: Pennestrì, Valentini, Vita, eqs (10) to (16).

    Attributes:
        contact: by which the beam is struck, between its body and what strikes it.
        beam: what vibrates; its length is the body's `tooth_length`.
        name, plural: what the beam is called, for the reader.
        jump: the field of the records that holds v_I [m/s]: the output `impacts[1].<jump>`, and so on.
        slenderness: name of the calculated parameter that holds the beam's length over the height of its root, to be
            shown beside each stress; "" when there is none.
        strokes: output that counts the strokes for which a machine's damage is given; "": a run as a whole.
    """

    contact: str
    beam: StruckBeam
    name: str = "beam"
    plural: str = "beams"
    jump: RecordField = "velocity"
    slenderness: HeldName = ""
    strokes: OutputName = ""


@dataclass(frozen=True)
class Arm:
    """A bar of rectangular cross section that the drive holds at its hinge, a cantilever.

    Attributes:
        name: what it is called, and how the names of its results begin.
        length, width, depth: [m]; the depth lies in the plane of the motion.
        stiffness: across it at its pin, 3 E I / length^3 [N/m].
        angle: output with its direction from hinge to pin [rad].
    """

    name: str
    length: Quantity
    width: Quantity
    depth: Quantity
    stiffness: Quantity
    angle: OutputName


@dataclass(frozen=True)
class Strut:
    """A bar of rectangular cross section on the arm's pin, whose tip pushes.

    Attributes:
        name, length, width, depth: as of `Arm`.
        stiffness: along it, E A / length [N/m].
        angle: output with its direction from pin to tip [rad].
        deflection, stress: outputs with the deflection of its tip across it [m], and its largest bending stress [Pa].
    """

    name: str
    length: Quantity
    width: Quantity
    depth: Quantity
    stiffness: Quantity
    angle: OutputName
    deflection: OutputName
    stress: OutputName


@dataclass(frozen=True)
class SawtoothWheel:
    """A wheel on a hinge, pushed at the roots of the equal teeth of `sawtooth.sawtooth`.

    Attributes:
        name, tooth: what the wheel and one of its teeth are called.
        radius: of the roots [m].
        pitch, slope_angle, apex_angle: of its teeth [rad].
        angle: output with the polar angle of root 0 [rad].
        index: output with the number of the root at which the tip stands; they are counted clockwise.
        struck: field of the records of impacts with the number of the root that was struck.
        slope_force, face_force: outputs with the normal forces of the tip on slope and face [N].
    """

    name: str
    tooth: str
    radius: Quantity
    pitch: Quantity
    slope_angle: Quantity
    apex_angle: Quantity
    angle: OutputName
    index: OutputName
    struck: RecordField
    slope_force: OutputName
    face_force: OutputName


@dataclass(frozen=True)
class SeriesCompliance:
    """How far an arm and a strut in series give way while the strut's tip pushes or strikes a wheel.

    Source: README.md of `models/ratchet`; the formulas are in `mechanism_fmu.stress.links`.

    Attributes:
        contact: of the tip with the face of a tooth.
        arm, strut, wheel: the chain, from the drive on.
        restitution: of the contact [1].
        source: where the reader finds how it is calculated; "" when nowhere.
    """

    contact: str
    arm: Arm
    strut: Strut
    wheel: SawtoothWheel
    restitution: Quantity
    source: str = ""


#: What a `Model` can ask for; each kind once.
Analysis = ImpactStress | SeriesCompliance

#: What a field of these types may name, by the words for it.
_NAMED = {
    "HeldName": "parameter or calculated parameter",
    "OutputName": "output",
    "RecordField": "field of the records of impacts",
}


def check_analysis(
    analyses: Collection[Analysis], held: Collection[str], outputs: Collection[str], records: Collection[str]
) -> None:
    """Check that analyses stand on their own.

    Args:
        analyses: of a model.
        held: names of its parameters and calculated parameters.
        outputs: names of its outputs.
        records: names of the fields of its records of impacts.

    Raises:
        MechanismError: a name that does not exist, a number that is not finite, or a kind of analysis that is asked
            for twice.
    """
    kinds = [type(analysis).__name__ for analysis in analyses]
    for kind in kinds:
        if kinds.count(kind) > 1:
            raise MechanismError(f"Analysis: {kind} is asked for {kinds.count(kind)} times; an FMU has one of a kind.")
    known = {"HeldName": held, "OutputName": outputs, "RecordField": records}
    for analysis in analyses:
        for label, what, value in _named(type(analysis).__name__, analysis):
            if not isinstance(value, str):
                if value is not None and not math.isfinite(value):
                    raise MechanismError(f"{label} = {value} is not a finite number; give one, or a variable's name.")
            elif value not in known[what]:
                there = ", ".join(sorted(known[what])) or "none"
                raise MechanismError(
                    f"{label}: the model has no {_NAMED[what]} {value!r}; name one of those it has ({there}), or add "
                    "it."
                )


def _named(label: str, record: object) -> Iterator[tuple[str, str, float | str | None]]:
    """What an analysis names or gives as a number, but for words: where it stands, what it names, and the value."""
    for field in fields(record):  # type: ignore[arg-type]
        value, place = getattr(record, field.name), f"{label}, {field.name}"
        if value == "" == field.default:
            continue
        if is_dataclass(value):
            yield from _named(f"{label}, {type(value).__name__}", value)
        elif str(field.type).startswith("Quantity"):
            yield place, "HeldName", value
        elif isinstance(value, tuple):
            yield from ((f"{place}[{k}]", "HeldName", one) for k, one in enumerate(value))
        elif field.type in _NAMED:
            yield place, str(field.type), value
