"""A four-bar linkage whose coupler carries a path point, with links that bend.

Frame: the crank's hinge at the origin, the rocker's hinge at (d, 0). The coupler is two beams, welded at the crank pin:
one to the rocker pin, and the arm to the path point P. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import GROUND, CompliantShaft, Mechanism, Model, Revolute, Settings, Torque
from mechanism_fmu.model.four_bar_checks import objections, warnings

from .links import links
from .ports import INPUTS, OUTPUTS, PARAMETERS, calculated
from .shapes import SHAPES


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The path generator for parameter values that raise no objection."""
    crank, coupler, rocker = linkage = links(values)
    arm, bar = coupler.parts.members
    crank_bar, rocker_bar = crank.parts.members[0], rocker.parts.members[0]
    return Mechanism(
        bodies=tuple(link.body for link in linkage),
        joints=(
            Revolute("crank_hinge", "crank", crank_bar.start, GROUND, (0.0, 0.0)),
            Revolute("crank_pin", "coupler", bar.start, "crank", crank_bar.end),
            Revolute("rocker_pin", "rocker", rocker_bar.end, "coupler", bar.end),
            Revolute("rocker_hinge", "rocker", rocker_bar.start, GROUND, (values.ground_length, 0.0)),
        ),
        forces=(
            Torque("drive", "crank"),
            CompliantShaft("shaft", "crank", stiffness=values.drive_stiffness, damping=values.drive_damping),
        ),
        members=(arm, crank_bar, bar, rocker_bar),
        disks=coupler.parts.disks,
        inputs=INPUTS,
        outputs=OUTPUTS,
        calculated=calculated(values),
        held=("crank.angle",),
        settings=Settings.of(values),
    )


MODEL = Model(
    name="FourBarPathGenerator",
    description="Four-bar path generator whose links bend: rigid and elastic path, stresses",
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    warnings=warnings,
    stop_time=0.24,
    step_size=5e-4,
    drawing=SHAPES,
    author="The mechanism_fmu team",
    license="MIT",
)
