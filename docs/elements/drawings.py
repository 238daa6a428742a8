"""The drawings of the pages of force elements and contacts.

python -m docs.elements.drawings      rewrites the .svg files beside this file, in the root of a clone
"""

from __future__ import annotations

from pathlib import Path

from .contact_drawings import (
    angle_lock,
    angle_stop,
    circular_pattern,
    clearance_joint,
    logical_function,
    outline_contact,
    point_line_contact,
)
from .force_drawings import bushing, force, marker, nonlinear_spring, oscillation, spring_damper, torque, torsion_spring
from .shaft_drawings import brake, compliant_shaft, dc_motor

DRAWINGS = {
    "torque": torque,
    "force": force,
    "marker": marker,
    "oscillation": oscillation,
    "spring_damper": spring_damper,
    "torsion_spring": torsion_spring,
    "bushing": bushing,
    "nonlinear_spring": nonlinear_spring,
    "compliant_shaft": compliant_shaft,
    "brake": brake,
    "dc_motor": dc_motor,
    "point_line_contact": point_line_contact,
    "outline_contact": outline_contact,
    "clearance_joint": clearance_joint,
    "angle_stop": angle_stop,
    "angle_lock": angle_lock,
    "circular_pattern": circular_pattern,
    "logical_function": logical_function,
}


def main() -> None:
    """Rewrite all drawings."""
    for name, draw in DRAWINGS.items():
        (Path(__file__).parent / f"{name}.svg").write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main()
