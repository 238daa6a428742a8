"""The lever escapement: an escape wheel of fifteen pointed teeth, a lever with two pallets, and a detached balance.

Frame: the wheel's axis at the origin, above it the lever's arbor, and above that the balance's staff; the wheel turns
counter-clockwise. At the angle 0 of lever and balance the fork points at the staff, and the impulse pin is in it.
Equations and sources: README.md beside this file.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    Body,
    CircularCopies,
    Damper,
    Disc,
    Finding,
    Mechanism,
    Model,
    Outline,
    OutlineContact,
    Parameter,
    Polyline,
    Revolute,
    Torque,
    TorsionSpring,
    pin_tooth,
    port_builders as ports,
    rigid_body,
)
from mechanism_fmu.model.findings import first
from mechanism_fmu.model.functions import Number, cos, sin
from mechanism_fmu.model.timekeeping import (
    anchor_drop,
    anchor_room,
    anchor_shape,
    beat,
    drive_input,
    drop_finding,
    lock_finding,
    nominal_period_parameter,
    polar,
    timekeeping_outputs,
    wheel_shape,
)

#: Teeth of the wheel; the radius to a pallet and the line of centres are so far apart [rad].
TEETH, SPAN = 15, math.radians(30)
#: Radius of the circle of the teeth's tips, length of the pallets, and how far a tooth stands free at the start [m].
RADIUS, LENGTH, FREE = 0.030, 0.004, 2e-4
ARM = RADIUS * math.tan(SPAN)
ARBOR = (0.0, RADIUS / math.cos(SPAN))
#: Of the fork: from the arbor to its horns; half the width of its notch, of both horns, and its depth [m].
FORK, NOTCH, HORNS, DEEP = 0.0393, 1.05e-3, 3.2e-3, 3e-3
#: Of the impulse pin: radius, and from the staff [m]; how far the staff is from the arbor.
PIN, CRANK, CENTRES = 1e-3, 0.008, 0.047
STAFF = (0.0, ARBOR[1] + CENTRES)
#: Banking pins: radius, and where on the lever they meet it, above the arbor and to either side [m].
BANKING, MEETS, STEM = 1e-3, 0.025, 2e-3

INPUTS = (
    drive_input("4 N.mm", "mainspring", usual=("2 N.mm", "16 N.mm")),
    ports.load_torque_input("balance", usual=(-1e-3, 1e-3)),
)
OUTPUTS = timekeeping_outputs("balance", "theta", energy=1e-2, power=1e-3)

PARAMETERS = (
    ports.inertia_parameter("wheel_inertia", 1e-6, "Moment of inertia of the escape wheel about its axis"),
    ports.inertia_parameter("lever_inertia", 2e-6, "Moment of inertia of the lever about its arbor"),
    ports.inertia_parameter("balance_inertia", 5e-5, "Moment of inertia of the balance about its staff"),
    Parameter("frequency", 2.501, "Frequency of balance and hairspring alone", "Hz", 0.1, 100.0, usual=(1.0, 5.0)),
    Parameter("quality", 200.0, "Quality factor of balance and hairspring alone", "1", 1.0, 1e5, usual=(50.0, 400.0)),
    ports.length_parameter("tip_radius", "0.2 mm", "Radius of the teeth's tips", 1e-6, usual=(5e-5, 4e-4)),
    ports.length_parameter("pallet_thickness", "5 mm", "Between both locking faces", 1e-6, usual=(4e-3, 5.6e-3)),
    ports.angle_parameter("lift_angle", "5.5 deg", "Of the lever while a tooth pushes a pallet", 1e-3, 0.15),
    ports.angle_parameter("lock_angle", "1.5 deg", "By which a tooth drops onto its locking face", 0.0, 0.1),
    ports.angle_parameter("draw_angle", "12 deg", "Of locking faces: a tooth draws the lever to its pin", 0.0, 0.4),
    ports.angle_parameter("banking_angle", "5 deg", "Of the lever on either banking pin", 0.02, 0.2),
    ports.angle_parameter("balance_angle_start", "120 deg", "Angle of the balance at the start", 0.7, 5.0),
    nominal_period_parameter(0.4),
    *ports.settings_parameters(),
)


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the wheel cannot turn, or is not held."""
    thick, tip = values.pallet_thickness, values.tip_radius
    drop, most = anchor_drop(TEETH, RADIUS, SPAN, thick, tip), anchor_room(TEETH, RADIUS, SPAN) - 0.5 * thick
    return first(drop_finding(drop, most, thick, tip), lock_finding(values.lock_angle, ARM, tip))


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The escapement for parameter values that raise no objection."""
    behind = (0.5 * values.pallet_thickness + values.tip_radius + FREE) / RADIUS
    wheel = rigid_body("wheel", mass="10 g", inertia=values.wheel_inertia, angle=0.5 * math.pi - SPAN - behind)
    # nearly on its banking pin, to which the tooth draws it
    lever = rigid_body("lever", ARBOR, mass="10 g", inertia=values.lever_inertia, angle=-0.95 * values.banking_angle)
    balance = rigid_body(
        "balance", STAFF, mass="50 g", inertia=values.balance_inertia, angle=values.balance_angle_start
    )
    swing = 2.0 * math.pi * values.frequency
    joints = (
        Revolute("axis", wheel.at(0, 0), GROUND),
        Revolute("arbor", lever.at(0, 0), GROUND.at(*ARBOR)),
        Revolute("staff", balance.at(0, 0), GROUND.at(*STAFF)),
    )
    forces = (
        Torque("drive", wheel),
        Torque("load", balance),
        TorsionSpring("hairspring", balance, stiffness=values.balance_inertia * swing * swing),
        Damper("air", balance, damping=values.balance_inertia * swing / values.quality),
    )
    contacts = (*_escaping(values, lever, wheel), *_fork(lever, balance), *_banking(values, lever))
    timed = (beat("balance", values.nominal_period),)
    return Mechanism((wheel, lever, balance), joints, forces, contacts, oscillations=timed)


def _escaping(values: SimpleNamespace, lever: Body, wheel: Body) -> tuple[OutlineContact, ...]:
    """Both pallets with the teeth: where a tooth rests on a locking face, it draws the lever further that way."""
    half = 0.5 * values.pallet_thickness
    inner, outer = ARM - half, ARM + half
    entry, exit_ = 2.0 * math.pi - SPAN, math.pi + SPAN  # where pallets are, seen from the arbor
    met, left = 0.5 * (values.lift_angle - values.lock_angle), 0.5 * (values.lift_angle + values.lock_angle)
    back = _aside(entry, 1.0, values.draw_angle)
    front = polar(inner, entry - left), polar(outer, entry + met)
    pallets = {"entry": (*front, _add(front[1], back), _add(front[0], back))}
    back = _aside(exit_, -1.0, values.draw_angle)
    front = polar(outer, exit_ + left), polar(inner, exit_ - met)
    pallets["exit"] = (*front, _add(front[1], back), _add(front[0], back))
    tooth, copies = pin_tooth(TEETH, RADIUS, values.tip_radius), CircularCopies(TEETH)
    return tuple(
        OutlineContact(name, lever, wheel, outline_i=Outline.polygon(corners), outline_j=tooth, copies=copies)
        for name, corners in pallets.items()
    )


def _aside(angle: Number, way: float, draw: Number) -> tuple[Number, Number]:
    """Along a locking face away from the pallet's end, at an angle about the arbor; it turns away from the circle."""
    along, across = way * LENGTH * cos(draw), -way * LENGTH * sin(draw)
    return across * cos(angle) - along * sin(angle), across * sin(angle) + along * cos(angle)


def _add(a: tuple[Number, Number], b: tuple[Number, Number]) -> tuple[Number, Number]:
    return a[0] + b[0], a[1] + b[1]


def _fork(lever: Body, balance: Body) -> tuple[OutlineContact]:
    """The impulse pin in the notch of the fork."""
    floor, foot = FORK - DEEP, FORK - 1.5 * DEEP
    half = (HORNS, FORK), (NOTCH, FORK), (NOTCH, floor)
    notch = Outline.polygon([(-HORNS, foot), (HORNS, foot), *half, *((-x, y) for x, y in half[::-1])])
    pin = Outline.circle(PIN, (0.0, -CRANK))
    return (OutlineContact("pin", balance, lever, outline_i=pin, outline_j=notch, points=2),)


def _banking(values: SimpleNamespace, lever: Body) -> tuple[OutlineContact, ...]:
    """Two pins that limit the way of the lever's stem."""
    stem = Outline.polygon([(-STEM, MEETS - STEM), (STEM, MEETS - STEM), (STEM, MEETS + STEM), (-STEM, MEETS + STEM)])
    c, s, out = cos(values.banking_angle), sin(values.banking_angle), STEM + BANKING
    at = {"right": out * c + MEETS * s, "left": -1.0 * (out * c + MEETS * s)}
    up = ARBOR[1] + MEETS * c - out * s
    return tuple(
        OutlineContact(name, GROUND, lever, outline_i=Outline.circle(BANKING, (x, up)), outline_j=stem)
        for name, x in at.items()
    )


MODEL = Model(
    name="LeverEscapement",
    description="Lever escapement: a wheel of fifteen teeth, a lever with two pallets, a detached balance",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    stop_time=4.0,
    step_size=5e-3,
    drawing=(
        Disc("rim", STAFF, 0.014),
        wheel_shape(TEETH, RADIUS),
        anchor_shape("lever", ARBOR, ARM, 0.5 * math.pi - SPAN),
        Polyline("fork", ARBOR, "lever_angle", ((-STEM, 0.0), (STEM, 0.0), (STEM, FORK - DEEP), (-STEM, FORK - DEEP))),
        Polyline("roller", STAFF, "balance_angle", ((0.0, 0.0), (0.0, -CRANK))),
        ...,
    ),
)
