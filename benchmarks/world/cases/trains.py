"""Planetary and reverted gear trains: redundant meshes, a ratio of ten thousand; speeds and angles in closed form.

With speeds w over that of the sun, radii r and the ring at rest, Willis' equation and the rolling of the planets give

    w_carrier = r_sun/(2 r_arm),    w_planet = -r_sun/(2 r_planet),

and the torque T on the sun accelerates an inertia J, the sum of all in these ratios squared, by T/J. Three planets
that are alike share evenly: with sun's and planets' inertias J_s and J_p, tooth forces are

    F_sun = (T - J_s T/J)/(3 r_sun),    F_ring = F_sun + J_p w_planet (T/J)/r_planet.
"""

from __future__ import annotations

import math
from typing import Any

from mechanism_fmu.model import (
    GROUND,
    Body,
    Gears,
    InternalGears,
    Mechanism,
    Output,
    Revolute,
    Settings,
    Torque,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, steps_of

SUN, PLANET, RING, ARM = 0.03, 0.02, 0.07, 0.05
SUN_INERTIA, PLANET_INERTIA, CARRIER_INERTIA, PLANET_MASS, PLANETS = 2e-4, 5e-5, 3e-3, 0.3, 3
TORQUE, STOP = 0.02, 2.0
#: At the sun and at the ring, of each planet.
_MESHES = [f"{side}{k}" for side in ("outside", "inside") for k in range(PLANETS)]
#: Radii of the reverted train: the sun that is held, the planet's two wheels, the wheel that is driven.
HELD, FIRST, SECOND, DRIVEN = (ARM * part for part in (99 / 199, 100 / 199, 101 / 201, 100 / 201))


def planetary(tolerance: float) -> Mechanism:
    """Three planets on a carrier between a driven sun and a ring that is held: four of six meshes repeat the others."""
    sun, carrier = Body("sun", 1.0, SUN_INERTIA), Body("carrier", 1.0, CARRIER_INERTIA)
    joints: list[Any] = [
        Revolute("sun_pin", sun.at(0, 0), GROUND.at(0, 0)),
        Revolute("carrier_pin", carrier.at(0, 0), GROUND.at(0, 0)),
    ]
    planets = []
    for k in range(PLANETS):
        angle = math.tau * k / PLANETS
        x, y = ARM * math.cos(angle), ARM * math.sin(angle)
        planet = rigid_body(f"planet{k}", (x, y), mass=PLANET_MASS, inertia=PLANET_INERTIA)
        planets.append(planet)
        joints.append(Revolute(f"pin{k}", planet.at(0, 0), carrier.at(x, y)))
        mesh = {"radius_j": PLANET, "angle_i": angle}
        joints.append(Gears(f"outside{k}", sun, planet, radius_i=SUN, angle_j=angle + math.pi, **mesh))
        joints.append(InternalGears(f"inside{k}", GROUND, planet, radius_i=RING, angle_j=angle, **mesh))
    return _driven((sun, carrier, *planets), joints, "sun", ("carrier", "planet0"), tolerance)


def reverted(tolerance: float) -> Mechanism:
    """An arm carries two wheels on one shaft round a held sun; the second of them drives a wheel beside the sun."""
    arm, out = Body("arm", 1.0, CARRIER_INERTIA), Body("out", 1.0, SUN_INERTIA)
    planet = rigid_body("planet", (ARM, 0), mass=PLANET_MASS, inertia=PLANET_INERTIA)
    joints = [
        Revolute("arm_pin", arm.at(0, 0), GROUND.at(0, 0)),
        Revolute("out_pin", out.at(0, 0), GROUND.at(0, 0)),
        Revolute("pin", planet.at(0, 0), arm.at(ARM, 0)),
        Gears("held", GROUND, planet, radius_i=HELD, radius_j=FIRST, angle_i=0.0, angle_j=math.pi),
        Gears("driven", out, planet, radius_i=DRIVEN, radius_j=SECOND, angle_i=0.0, angle_j=math.pi),
    ]
    return _driven((arm, out, planet), joints, "arm", ("out", "planet"), tolerance)


def _driven(bodies: Any, joints: Any, driver: str, others: Any, tolerance: float) -> Mechanism:
    outputs = [Output("driver", f"{driver}.speed", "rad/s")]
    outputs += [Output(name, f"{name}.angle", "rad") for name in others]
    outputs += [Output(joint.name, f"{joint.name}.force", "N") for joint in joints if joint.name in _MESHES]
    torque = Torque("motor", driver, torque=TORQUE)
    return Mechanism(bodies, tuple(joints), (torque,), outputs=tuple(outputs), settings=Settings(tolerance))


def run(tolerance: float) -> Run:
    """Speed of what is driven, angles of two wheels and tooth forces of the planets, after two seconds."""
    values: list[float] = []
    steps = 0
    for made in (planetary(tolerance), reverted(tolerance)):
        simulation = Simulation(made)
        simulation.advance(STOP)
        read = simulation.read()
        values += [value for name, value in read.items() if name not in _MESHES]
        if "outside0" in read:
            values += [-read[name] for name in _MESHES]
        steps += steps_of(simulation)
    return Run(tuple(values), steps)


def _known() -> tuple[Known, ...]:
    """Rates over that of the driver, and the inertia that it feels."""
    carrier, planet = SUN / (2 * ARM), -SUN / (2 * PLANET)
    moved = CARRIER_INERTIA + PLANETS * PLANET_MASS * ARM**2
    inertia = SUN_INERTIA + moved * carrier**2 + PLANETS * PLANET_INERTIA * planet**2
    out, wheels = 1 - HELD * SECOND / (FIRST * DRIVEN), 1 + HELD / FIRST
    felt = CARRIER_INERTIA + PLANET_MASS * ARM**2 + PLANET_INERTIA * wheels**2 + SUN_INERTIA * out**2
    found = []
    for train, driver, sum_, names, ratios in (
        ("planetary", "sun", inertia, ("carrier", "planet"), (carrier, planet)),
        ("reverted", "arm", felt, ("driven wheel", "planet"), (out, wheels)),
    ):
        found.append(Known(f"{train}: speed of the {driver}", "rad/s", TORQUE / sum_ * STOP, "closed form"))
        turned = TORQUE / sum_ * STOP**2 / 2
        pairs = zip(names, ratios, strict=True)
        found += [Known(f"{train}: angle of the {name}", "rad", turned * ratio, "closed form") for name, ratio in pairs]
        if train == "planetary":
            at_sun = (TORQUE - SUN_INERTIA * TORQUE / sum_) / (PLANETS * SUN)
            at_ring = at_sun + PLANET_INERTIA * planet * TORQUE / sum_ / PLANET
            for where, force in (("sun", at_sun), ("ring", at_ring)):
                found += [
                    Known(f"planetary: tooth force of planet {k} at the {where}", "N", force, "closed form")
                    for k in range(1, PLANETS + 1)
                ]
    return tuple(found)


CASE = Case(
    name="trains",
    title="Planetary and reverted gear trains",
    statement=(
        "A sun of 30 mm, three planets of 20 mm, a held ring of 70 mm; and an arm whose planet has two "
        "wheels, 99/100 of "
        "which against 101/100 of the other leave a ten-thousandth of the arm's speed. 0.02 N m from rest; 2 s."
    ),
    source="textbook gear trains; data of this project",
    known=_known(),
    run=run,
    model=planetary,
    within=1e-10,
    remark=(
        "The slow wheel turns by 1.0e-3 rad while the arm turns by 10, so that its deviation is that of the arm, "
        "ten thousand times as large. Meshes of the planets repeat each other, and are no obstacle: of all the tooth "
        "forces that would do, the engine finds those that the planets share evenly."
    ),
)
