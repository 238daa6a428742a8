"""How far pawl and crank of a ratchet give way, from what its FMU reports: deflections, stresses, lost motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import pandas as pd

from .description import Value
from .links import Links, Loaded

#: The parameters by which an FMU describes such a ratchet.
PARAMETERS = (
    *("crank_length", "crank_width", "crank_depth", "crank_stiffness"),
    *("pawl_length", "pawl_width", "pawl_depth", "pawl_stiffness"),
    *("wheel_inner_radius", "tooth_pitch", "tooth_slope_angle", "tooth_apex_angle", "restitution"),
)
#: The outputs that it needs.
OUTPUTS = (
    *("crank_angle", "pawl_angle", "wheel_angle", "contact_force", "slope_force", "tooth_index"),
    *("pawl_tip_deflection", "pawl_bending_stress"),
)
#: The columns of a table of impacts that it needs; contact 1 is the face.
IMPACTS = ("time", "closing_speed", "impulse", "tooth", "contact")
_FACE = 1


@dataclass(frozen=True)
class Compliance:
    """What gives way under one load; signs are left out.

    Attributes:
        case: what loads it.
        time: of it [s].
        force: of the pawl on the tooth's face [N].
        pawl_deflection: of its tip, across it [m].
        pawl_stress: by bending [Pa].
        pawl_shortening: along it [m].
        crank_deflection: of its pin, across it [m].
        crank_stress: by bending [Pa].
        lost_motion: by what angle the wheel stays behind that of rigid links [rad].
        lost_part: of a tooth's pitch [1].
        resolution: tooth pitch and lost motion [rad]: what the drive must move the wheel by to gain a tooth.
    """

    case: str
    time: float
    force: float
    pawl_deflection: float
    pawl_stress: float
    pawl_shortening: float
    crank_deflection: float
    crank_stress: float
    lost_motion: float
    lost_part: float
    resolution: float


#: Units of the numbers of a `Compliance`.
COMPLIANCE_UNITS = {
    "time": "s",
    "force": "N",
    "pawl_deflection": "m",
    "pawl_stress": "Pa",
    "pawl_shortening": "m",
    "crank_deflection": "m",
    "crank_stress": "Pa",
    "lost_motion": "rad",
    "lost_part": "1",
    "resolution": "rad",
}


def compliance_of(
    parameters: Mapping[str, Value], results: pd.DataFrame, impacts: pd.DataFrame
) -> tuple[Compliance, ...]:
    """What gives way most while the pawl holds the wheel, and most in an impact on a face; () where there is neither.

    Args:
        parameters: of the FMU; without `PARAMETERS` it describes no such ratchet.
        results: recorded variables, in their SI units; without `OUTPUTS` it does not, either.
        impacts: of the run.
    """
    if not set(PARAMETERS) <= set(parameters) or not set(OUTPUTS) <= set(results):
        return ()
    links = Links({name: float(parameters[name]) for name in PARAMETERS})
    found = []
    finite = np.isfinite(results[list(OUTPUTS)].to_numpy(dtype=np.float64)).all(axis=1)
    held = results[finite & (results["contact_force"].to_numpy() > 0.0)]
    if not held.empty:
        found.append(_told("contact force", links.held(held), links))
    if set(IMPACTS) <= set(impacts):
        blows = impacts[(impacts["contact"] == _FACE) & (impacts["impulse"] > 0.0) & (impacts["closing_speed"] > 0.0)]
        if not blows.empty:
            found.append(_told("impact", links.struck(results, blows), links))
    return tuple(found)


def compliance_summary(found: tuple[Compliance, ...]) -> list[dict[str, Any]]:
    """What was found, ready for JSON."""
    return [asdict(one) for one in found]


def _told(case: str, load: Loaded, links: Links) -> Compliance:
    pitch, lost = links.values["tooth_pitch"], abs(load.motion)
    return Compliance(
        case,
        load.time,
        load.force,
        abs(load.pawl_deflection),
        abs(load.pawl_stress),
        abs(load.pawl_stretch),
        abs(load.crank_deflection),
        abs(load.crank_stress),
        lost,
        lost / pitch,
        pitch + lost,
    )
