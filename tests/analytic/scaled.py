"""A mechanism in other units: all its numbers by their dimensions, so that it moves the same way, slower and larger."""

from __future__ import annotations

import re
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

import numpy as np

from mechanism_fmu.engine.outlines.features import FAR
from mechanism_fmu.model import Body, Mechanism, Member
from mechanism_fmu.model.curves import Curve
from mechanism_fmu.model.outlines import Outline
from mechanism_fmu.units import FMI

#: Gaps of the second and further places where two outlines can touch.
_OF_A_PLACE = re.compile(r"_\d+_gap$")
#: Units of numbers that parts declare none of, by the name of the field; of several, where a field has several.
_FIELDS = {
    **dict.fromkeys(("point", "point_i", "point_j", "reaction_point", "line_point", "boundary_point"), "m"),
    **dict.fromkeys(("centre_i", "centre_j", "origin_i", "step", "depth"), "m"),
    "area": "m2",
    "second_moment": "m4",
}
_BODY = {
    "mass": "kg",
    "inertia": "kg.m2",
    "start": ("m", "m", "rad"),
    "start_rate": ("m/s", "m/s", "rad/s"),
    **dict.fromkeys(("tooth_length", "centre", "outline", "radius"), "m"),
}


@dataclass(frozen=True)
class Scales:
    """By how much masses, lengths and times are larger; currents are as they are."""

    mass: float = 1.0
    length: float = 1.0
    time: float = 1.0

    def factor(self, unit: str) -> float:
        """By how much a number of a unit is larger."""
        kg, m, s, *_ = FMI.read(unit).exponents
        return self.mass**kg * self.length**m * self.time**s

    def number(self, value: Any, unit: Any) -> Any:
        """A number, or numbers within tuples, in the other scales; None stays."""
        if value is None:
            return None
        if isinstance(value, tuple):
            units = unit if isinstance(unit, tuple) else (unit,) * len(value)
            return tuple(self.number(v, u) for v, u in zip(value, units, strict=True))
        return value * self.factor(unit)

    def curve(self, curve: Curve, over: str, unit: str) -> Curve:
        """A curve of a unit over a variable."""
        x, y = self.factor(over), self.factor(unit)
        pieces = tuple(
            replace(
                piece,
                start=piece.start * x,
                terms=tuple(
                    replace(
                        term,
                        polynomial=tuple(c * y / x**k for k, c in enumerate(term.polynomial)),
                        amplitude=term.amplitude * y,
                        frequency=term.frequency / x,
                    )
                    for term in piece.terms
                ),
            )
            for piece in curve.pieces
        )
        return replace(curve, pieces=pieces, start=curve.start * x, span=curve.span * x)

    def part(self, part: Any) -> Any:
        """A part with all its numbers."""
        units = {**_FIELDS, **getattr(part, "units", {}), **(_BODY if isinstance(part, Body) else {})}
        if isinstance(part, Member):
            units |= {"start": "m", "end": "m"}
        if "friction_radius" in units:
            units["friction_static"] = "m"
        changes: dict[str, Any] = {}
        for field in fields(part):
            value = getattr(part, field.name)
            if isinstance(value, Curve):
                profile = field.name.startswith("profile")
                turns = hasattr(part, "acts") and part.acts == "torque"
                over, unit = ("rad", "m") if profile else ("s", getattr(part, "unit", "m"))
                if field.name == "law":
                    over, unit = ("rad", "N.m") if turns else ("m", "N")
                changes[field.name] = self.curve(value, over, unit)
            elif isinstance(value, Outline):
                corners = tuple((x * self.length, y * self.length, bulge) for x, y, bulge in value.vertices)
                changes[field.name] = replace(value, vertices=corners)
            elif field.name == "law" and callable(value):
                changes[field.name] = self._law(value, part.acts == "torque")
            elif field.name == "below":
                changes[field.name] = self.number(value, "rad" if part.of.endswith(".angle") else "m")
            elif field.name in units and not isinstance(value, str):
                changes[field.name] = self.number(value, units[field.name])
            elif is_dataclass(value):
                changes[field.name] = self.part(value)
        return replace(part, **changes)

    def _law(self, law: Any, turns: bool) -> Any:
        x, f = (1.0, self.factor("N.m")) if turns else (self.length, self.factor("N"))
        return lambda length, rate: f * law(length / x, rate * (self.time / x))

    def mechanism(self, given: Mechanism) -> Mechanism:
        """A mechanism in the other scales; what is calculated of its outputs is left out."""
        elements = {element.name: element for element in given.elements}
        settings = replace(
            given.settings,
            baumgarte_alpha=given.settings.baumgarte_alpha / self.time,
            baumgarte_beta=given.settings.baumgarte_beta / self.time,
        )
        gravity = given.gravity
        if gravity is not None:
            gravity = self.number(gravity, "m/s2")
        inputs = []
        for port in given.inputs:
            name, _, entry = port.target.rpartition(".")
            entry = "force" if entry in ("x", "y") else entry
            target = self.factor(getattr(elements[name], "units", {})[entry])
            own = self.factor(port.unit)
            limits = {what: getattr(port, what) for what in ("minimum", "maximum")}
            inputs.append(
                replace(
                    port,
                    start=port.start * own,
                    factor=port.factor * (target / own),
                    offset=port.offset * target,
                    usual=None,
                    **{what: None if value is None else value * own for what, value in limits.items()},
                )
            )
        parts = {
            group: tuple(self.part(part) for part in getattr(given, group))
            for group in ("bodies", "joints", "forces", "contacts", "patterns", "functions", "markers", "oscillations")
        }
        elastic = {group: tuple(map(self.part, getattr(given, group))) for group in ("members", "lumped_masses")}
        return replace(
            given, **parts, **elastic, inputs=tuple(inputs), calculated=(), settings=settings, gravity=gravity
        )


def compare(given: Mechanism, scales: Scales, until: float, step: float, simulate: Any) -> tuple[float, str]:
    """How far a mechanism moves otherwise in other scales, as a share of the largest of each unit; and where.

    Events count too: their number, guards and order must agree, else the answer is infinite.

    Args:
        given: the mechanism.
        scales: the other scales.
        until: end of the motion [s].
        step: communication step [s].
        simulate: of (mechanism, until, step).
    """
    given = replace(given, calculated=())
    one = simulate(given, until, step)
    other = simulate(scales.mechanism(given), until * scales.time, step * scales.time)
    seen, then = [event.guard for event in one.events], [event.guard for event in other.events]
    if seen != then:
        return np.inf, f"events {seen[:20]} and {then[:20]}"
    worst, where = 0.0, ""
    times = np.array([e.time for e in one.events]) * scales.time - np.array([e.time for e in other.events])
    if len(times) and np.abs(times).max() > 0:
        worst, where = float(np.abs(times).max() / (until * scales.time)), "time of an event"
    largest: dict[str, float] = {}
    for name in one.names[1:]:
        size = np.abs(np.where(one[name] == FAR, 0.0, one[name])).max(initial=0.0)
        largest[one.units[name]] = max(largest.get(one.units[name], 0.0), float(size))
    for name in one.names[1:]:
        a, b = one[name] * scales.factor(one.units[name]), other[name]
        if _OF_A_PLACE.search(name):
            continue  # where several places of outlines are free, the last digit decides which stands for what is next
        none = (one[name] == -1.0) | (other[name] == -1.0) | (one[name] == FAR)  # no impact yet, nothing to touch
        a = np.where(none, b, a)
        most = largest[one.units[name]] * scales.factor(one.units[name])
        apart = np.abs(a - b)
        apart[apart < np.finfo(float).tiny] = 0.0  # powers of two round what is less than the least normal number
        off = float(apart.max() / max(most, np.finfo(float).tiny))
        if off > worst:
            worst, where = off, name
    return worst, where
