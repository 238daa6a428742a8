"""A cam under its follower over one turn: lift, pressure angle, curvature, and what is wrong with its profile.

    python docs/examples/cam_report.py cam_drive contact cam base_radius=0.03

writes cam_report.csv. The arguments are a ready-made model, or a file of your own
(docs/tutorials/your-first-mechanism.md), the name of its pair of profiles, the body that is the cam, and parameters in
SI units. No FMU is built and nothing is simulated: it is the geometry of the mechanism
(docs/explanation/kinematics.md).
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
import pandas as pd

from build_fmu import mechanism
from mechanism_fmu.kinematics import CamReport, cam_report, mobility


def table(report: CamReport, follower: str) -> pd.DataFrame:
    """A row for each angle of the cam; derivatives are by that angle."""
    columns = {"cam angle [deg]": np.degrees(report.cam_angle)}
    for coordinate, unit in (("x", "m"), ("y", "m"), ("angle", "rad")):
        for what, values in zip(("", "' ", '" '), report.motion.of(f"{follower}.{coordinate}"), strict=True):
            columns[f"{follower} {coordinate}{what or ' '}[{unit}]"] = values
    columns["pressure angle [deg]"] = np.degrees(report.pressure_angle)
    columns["relative curvature [1/m]"] = report.relative_curvature
    return pd.DataFrame(columns)


def main(model: str, contact: str, cam: str, *settings: str, file: Path = Path("cam_report.csv")) -> CamReport:
    """Report on a cam, and write what it does over a turn."""
    values = {name: float(value) for name, _, value in (setting.partition("=") for setting in settings)}
    described = mechanism(model, **values)
    print(mobility(described))
    report = cam_report(described, contact, cam)
    pair = next(one for one in described.contacts if one.name == contact)
    follower = pair.body_j if pair.body_i == cam else pair.body_i
    table(report, follower).to_csv(file, index=False)
    worst = int(np.argmax(report.pressure_angle))
    print(
        f"pressure angle at most {math.degrees(report.pressure_angle[worst]):.2f} deg, at cam angle "
        f"{math.degrees(report.cam_angle[worst]):.0f} deg"
    )
    profile = report.profile
    print(f"profile from {1e3 * profile.least_rho:.4g} to {1e3 * profile.largest_rho:.4g} mm from its centre")
    hollow = f"{1e3 * profile.hollow_radius:.4g} mm" if profile.hollows else "none"
    print(f"smallest radius of curvature: {1e3 * profile.tip_radius:.4g} mm; of hollows: {hollow}")
    for problem in report.problems() or ("nothing to object",):
        print(f"- {problem}")
    return report


if __name__ == "__main__":
    main(*sys.argv[1:])
