"""Units for people: of millimetres and metres those in which a number is easily read."""

from __future__ import annotations

import math

#: By the SI unit of a variable: other units, and how many of them are one of it.
LADDERS: dict[str, tuple[tuple[str, float], ...]] = {
    "m": (("mm", 1e3), ("um", 1e6)),
    "m/s": (("mm/s", 1e3),),
    "kg": (("g", 1e3), ("mg", 1e6)),
    "kg.m2": (("kg.mm2", 1e6), ("g.mm2", 1e9)),
    "N": (("kN", 1e-3), ("mN", 1e3)),
    "N.m": (("kN.m", 1e-3), ("N.mm", 1e3)),
    "N.s": (("mN.s", 1e3),),
    "N.m/rad": (("N.mm/rad", 1e3),),
    "N.m.s/rad": (("N.mm.s/rad", 1e3),),
    "N/m": (("N/mm", 1e-3),),
    "J": (("kJ", 1e-3), ("mJ", 1e3), ("uJ", 1e6)),
    "W": (("kW", 1e-3), ("mW", 1e3)),
    "Pa": (("kPa", 1e-3), ("MPa", 1e-6)),
    "s": (("ms", 1e3), ("us", 1e6)),
}


def shown_unit(unit: str, magnitude: float) -> tuple[str, float]:
    """The unit in which a number is nearest to ten, in orders of magnitude, and how many of it are one SI unit.

    Args:
        unit: the SI unit of a variable.
        magnitude: of its values, in that unit; of 0 or what is not finite, the SI unit stays.
    """
    units = ((unit, 1.0), *LADDERS.get(unit, ()))
    if not 0.0 < abs(magnitude) < math.inf:
        return units[0]
    return min(units, key=lambda one: abs(math.log10(abs(magnitude) * one[1]) - 1.0))
