"""Where the contacts stand now: the present copy of a pattern, the present angle of a stop or lock."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose
from ...tables.parts import Contacts, Patterns
from ..compiler.subset import jit, keep_small


@jit
def place_contact(block: Array, at: Pose, contact: int) -> None:
    """Write `contacts.line` of one contact for the present index of its pattern, or its present clicks.

    A lock goes to the locked angle that is nearest to the bodies' pose (see `place_bodies`).
    """
    keep_small()
    table = Contacts(block)
    data = table.data[contact]
    line = table.line[contact]
    if table.kind[contact] == codes.POINT_LINE:
        pattern = table.pattern[contact]
        angle = 0.0
        if pattern != codes.NONE:
            angle = Patterns(block).copy[pattern] * Patterns(block).pitch[pattern]
        turn_line(data[2:], angle, line)
    elif table.alpha[contact] == codes.NONE:
        turns = float(table.clicks[contact])
        pitch = data[codes.STOP_PITCH]
        if table.kind[contact] == codes.ANGLE_LOCK:
            at = at
            relative = at.phi[table.body_i[contact]] - at.phi[table.body_j[contact]]
            turns = math.floor((relative - data[codes.STOP_ANGLE]) / pitch + 0.5)
        line[0] = data[codes.STOP_ANGLE] + turns * pitch


@jit
def place_pattern(block: Array, at: Pose, pattern: int) -> None:
    """Write the boundaries of a pattern's present copy, to the next and to the previous one, and its contacts."""
    keep_small()
    table = Patterns(block)
    index = table.copy[pattern]
    pitch = table.pitch[pattern]
    boundary = table.data[pattern, 2:]
    turn_line(boundary, index * pitch, table.line[pattern, :4])
    turn_line(boundary, (index - 1) * pitch, table.line[pattern, 4:])
    of = Contacts(block).pattern
    for c in range(of.shape[0]):
        if of[c] == pattern:
            place_contact(block, at, c)


@jit
def turn_line(source: Array, angle: float, target: Array) -> None:
    """A line (point, normal), turned by `angle` [rad] about the origin."""
    keep_small()
    c = math.cos(angle)
    s = math.sin(angle)
    for k in range(0, 4, 2):
        target[k] = c * source[k] - s * source[k + 1]
        target[k + 1] = s * source[k] + c * source[k + 1]
