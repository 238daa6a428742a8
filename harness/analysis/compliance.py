"""Elastic compliance of a chain of links, from what its FMU reports: deflections, stresses, lost motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from mechanism_fmu.stress.links import Bar, Loaded, Pose, SeriesLinks, Teeth

from ..errors import FmuError
from ..fmu.declared import Chain, Link, value_of
from ..fmu.description import Value

#: The columns of a table of impacts that it needs, besides that with the number of the root.
IMPACTS = ("time", "closing_speed", "impulse", "contact")


@dataclass(frozen=True)
class Compliance:
    """What gives way under one load; signs are left out.

    Attributes:
        case: what loads it.
        time: of it [s].
        force: of the strut on the face [N].
        strut_deflection: of its tip, across it [m].
        strut_stress: by bending [Pa].
        strut_shortening: along it [m].
        arm_deflection: of its pin, across it [m].
        arm_stress: by bending [Pa].
        lost_motion: by what angle the wheel stays behind that of rigid links [rad].
        lost_part: of a pitch [1].
        resolution: pitch and lost motion [rad]: what the drive must move the wheel by to gain a tooth.
    """

    case: str
    time: float
    force: float
    strut_deflection: float
    strut_stress: float
    strut_shortening: float
    arm_deflection: float
    arm_stress: float
    lost_motion: float
    lost_part: float
    resolution: float


_UNITS = {
    "time": "s",
    "force": "N",
    "strut_deflection": "m",
    "strut_stress": "Pa",
    "strut_shortening": "m",
    "arm_deflection": "m",
    "arm_stress": "Pa",
    "lost_motion": "rad",
    "lost_part": "1",
    "resolution": "rad",
}


def compliance_of(
    chain: Chain, parameters: Mapping[str, Value], results: pd.DataFrame, impacts: pd.DataFrame
) -> tuple[Compliance, ...]:
    """What gives way most while the strut holds the wheel, and most in an impact on a face; () where there is neither.

    Args:
        chain: that the FMU declares.
        parameters: of the FMU.
        results: recorded variables, in their SI units; without the outputs of the chain nothing can be said.
        impacts: of the run.
    """
    if not set(chain.outputs) <= set(results):
        return ()
    links = _links(chain, parameters)
    found = []
    finite = np.isfinite(results[list(chain.outputs)].to_numpy(dtype=np.float64)).all(axis=1)
    face = chain.wheel.outputs["face_force"]
    held = results[finite & (results[face].to_numpy() > 0.0)]
    if not held.empty:
        found.append(_signless("contact force", _held(chain, links, held), links))
    if {*IMPACTS, chain.struck} <= set(impacts):
        blows = impacts[
            (impacts["contact"] == chain.contact) & (impacts["impulse"] > 0.0) & (impacts["closing_speed"] > 0.0)
        ]
        if not blows.empty:
            restitution = value_of(chain.restitution, parameters)
            found.append(_signless("impact", _struck(chain, links, results, blows, restitution), links))
    return tuple(found)


def compliance_units(chain: Chain) -> dict[str, str]:
    """Units of the numbers of a `Compliance`, by their names in files and tables."""
    return {_name(chain, field): unit for field, unit in _UNITS.items()}


def compliance_values(chain: Chain, one: Compliance) -> dict[str, Any]:
    """A `Compliance` by the names of its numbers in files and tables, ready for JSON."""
    return {_name(chain, field): value for field, value in asdict(one).items()}


def _name(chain: Chain, field: str) -> str:
    """What a field is called: `strut_stress` is `pawl_stress`, if the strut is a pawl."""
    link, _, what = field.partition("_")
    names = {"arm": chain.arm.name, "strut": chain.strut.name}
    return f"{names[link]}_{what}" if link in names else field


def _links(chain: Chain, parameters: Mapping[str, Value]) -> SeriesLinks:
    arm, strut, wheel = (_numbers(link, parameters) for link in chain.links)
    for link in chain.links[:2]:
        for name, value in _numbers(link, parameters).items():
            if name in ("length", "width", "depth", "stiffness") and not value > 0.0:
                raise FmuError(
                    f"The {link.name}'s {name} is {value:g}, but a link that gives way needs a positive one."
                )
    return SeriesLinks(
        Bar.cantilever(**arm),
        Bar(strut["length"], strut["width"], strut["depth"], 1 / strut["stiffness"]),
        Teeth(**wheel),
    )


def _numbers(link: Link, parameters: Mapping[str, Value]) -> dict[str, float]:
    return {name: value_of(number, parameters) for name, number in link.numbers.items()}


def _held(chain: Chain, links: SeriesLinks, results: pd.DataFrame) -> Loaded:
    """Of communication points at which the face pushes, that with the most lost motion."""
    arm, strut, angle = (_column(results, link.outputs["angle"]) for link in chain.links)
    index, slope, face = (results[chain.wheel.outputs[name]] for name in ("index", "slope_force", "face_force"))
    pose = Pose(_column(results, "time"), arm, strut, angle - index.to_numpy() * links.teeth.pitch)
    bent = (_column(results, chain.strut.outputs[name]) for name in ("deflection", "stress"))
    return links.held(pose, face.to_numpy(), slope.to_numpy(), *bent)


def _struck(
    chain: Chain, links: SeriesLinks, results: pd.DataFrame, impacts: pd.DataFrame, restitution: float
) -> Loaded:
    """Of the impacts on a face, that with the largest force."""
    time = impacts["time"].to_numpy()
    arm, strut, angle = (np.interp(time, results["time"], results[link.outputs["angle"]]) for link in chain.links)
    pose = Pose(time, arm, strut, angle - impacts[chain.struck].to_numpy() * links.teeth.pitch)
    return links.struck(pose, impacts["closing_speed"].to_numpy(), impacts["impulse"].to_numpy(), restitution)


def _column(table: pd.DataFrame, name: str) -> npt.NDArray[np.float64]:
    return table[name].to_numpy(dtype=np.float64)


def _signless(case: str, load: Loaded, links: SeriesLinks) -> Compliance:
    pitch, lost = links.teeth.pitch, abs(load.motion)
    return Compliance(
        case,
        load.time,
        load.force,
        abs(load.strut_deflection),
        abs(load.strut_stress),
        abs(load.strut_stretch),
        abs(load.arm_deflection),
        abs(load.arm_stress),
        lost,
        lost / pitch,
        pitch + lost,
    )
