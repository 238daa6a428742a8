"""Bodies whose mass is not that of their members and disks: then what bends a linkage is not what moves it."""

from __future__ import annotations

import numpy as np

from mechanism_fmu.model import Mechanism

#: Mass and inertia may differ by this part, centres by it of the radius of gyration: rounded numbers pass, but not the
#: inertia of a bar whose mass is spread along it, a third of that of its lumps.
_WITHIN = 0.01


def unlike_bodies(mechanism: Mechanism) -> tuple[str, ...]:
    """A sentence for each body whose mass, centre or inertia is not that of its members and disks, to 1 %.

    Deflections, stresses and vibration come from these lumps, half of each member's mass at either end; reactions and
    input torque, too. An FMU moves by the body's own numbers, and its inertia forces are those of the lumps.
    """
    found = []
    for body in mechanism.bodies:
        members = [member for member in mechanism.members if member.body == body.name]
        if not members:
            continue
        disks = [disk for disk in mechanism.disks if disk.body == body.name]
        lumps = [(disk.mass, disk.point) for disk in disks]
        for member in members:
            half = member.density * member.section.area * np.hypot(*np.subtract(member.end, member.start)) / 2
            lumps += [(half, member.start), (half, member.end)]
        masses, points = np.array([mass for mass, _ in lumps]), np.array([point for _, point in lumps], dtype=float)
        mass, moment = masses.sum(), masses @ points
        inertia = masses @ (points**2).sum(axis=1) + sum(disk.inertia for disk in disks)
        gyration = np.sqrt(body.inertia / body.mass)
        away = np.hypot(*moment) > _WITHIN * body.mass * gyration
        off = abs(mass - body.mass) > _WITHIN * body.mass or abs(inertia - body.inertia) > _WITHIN * body.inertia
        if off or away:
            beside = f", with their centre {1e3 * np.hypot(*moment) / mass:.4g} mm beside the body's" if away else ""
            found.append(
                f"Body {body.name!r} has {body.mass:.4g} kg and {body.inertia:.4g} kg.m2, its members and disks have "
                f"{mass:.4g} kg and, about the body's centre of mass, {inertia:.4g} kg.m2{beside}: only these bend "
                f"the linkage. Take mass, inertia and points from lumped_body, or add a Disk for what they lack."
            )
    return tuple(found)
