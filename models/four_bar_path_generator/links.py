"""The bodies of the path generator, made of elastic members and disks."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace

from mechanism_fmu.model import Body, Disk, LumpedBody, Member, Section, lumped_body
from mechanism_fmu.model.four_bar import start
from mechanism_fmu.model.functions import Number, cos, sin
from mechanism_fmu.model.part_bodies import MovingPoint


@dataclass(frozen=True)
class Link:
    """A body at the start of the motion, and its members and disks in its own frame."""

    body: Body
    parts: LumpedBody


def links(values: SimpleNamespace) -> tuple[Link, Link, Link]:
    """Crank, coupler (its members: arm, bar) and rocker; half of each member's mass is at each of its ends."""
    at, theta, speed = start(values), values.crank_angle_start, values.crank_speed_start
    origin, hinge = MovingPoint(0.0, 0.0), MovingPoint(values.ground_length, 0.0)
    pin = origin.along(values.crank_length, theta, speed)
    path = values.arm_length * cos(values.arm_angle), values.arm_length * sin(values.arm_angle)
    crank_pin, rocker_pin = (0.0, 0.0), (values.coupler_length, 0.0)
    disks = (
        Disk("path_disk", "coupler", path, values.path_disk_mass, values.path_disk_inertia),
        Disk("crank_pin_disk", "coupler", crank_pin, values.crank_pin_disk_mass, values.crank_pin_disk_inertia),
        Disk("rocker_pin_disk", "coupler", rocker_pin, values.rocker_pin_disk_mass),
    )
    coupler = _member(values, "arm", "coupler", path), _member(values, "coupler_bar", "coupler", rocker_pin)
    crank = _member(values, "crank_bar", "crank", (values.crank_length, 0.0))
    rocker = _member(values, "rocker_bar", "rocker", (values.rocker_length, 0.0))
    return (
        _link("crank", lumped_body((crank,)), origin, theta, speed),
        _link("coupler", lumped_body(coupler, disks), pin, at.coupler_angle, at.coupler_speed),
        _link("rocker", lumped_body((rocker,)), hinge, at.rocker_angle, at.rocker_speed),
    )


def _member(values: SimpleNamespace, name: str, body: str, end: tuple[Number, Number]) -> Member:
    link = name.removesuffix("_bar")
    section = Section.rectangle(getattr(values, f"{link}_width"), getattr(values, f"{link}_depth"))
    return Member(name, body, (0.0, 0.0), end, section, values.elastic_modulus, values.density)


def _link(name: str, parts: LumpedBody, begin: MovingPoint, angle: Number, speed: Number) -> Link:
    x, y = parts.centre
    c, s = cos(angle), sin(angle)
    across, up = c * x - s * y, s * x + c * y
    place = begin.x + across, begin.y + up, angle
    rate = begin.x_rate - up * speed, begin.y_rate + across * speed, speed
    return Link(Body(name, parts.mass, parts.inertia, place, rate), parts)
