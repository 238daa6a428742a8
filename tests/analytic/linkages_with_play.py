"""Linkages with play, of outlines: a slider in a guide, a pin in a hole, and a four-bar with three clearances."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from benchmarks.world.cases.clearance_four_bar import COUPLER, CRANK as CRANK_OF_FOUR, GROUND_LENGTH, ROCKER, four_bar
from benchmarks.world.cases.clearance_slider_crank import CRANK, ROD, in_guide, slider_crank
from mechanism_fmu.model import (
    GROUND,
    Body,
    Mechanism,
    Outline,
    OutlineContact,
    Output,
    Translational,
)

G = (0.0, -9.81)


def of_body(*names: str) -> tuple[Output, ...]:
    """Outputs of coordinates, as "disc.x", and their rates."""
    every = [part for name in names for part in (name, f"{name}_rate")]
    return tuple(Output(name, name.replace("angle_rate", "speed"), "") for name in every)


#: What the slider-cranks show.
_SHOWN = of_body("crank.angle", "rod.angle", "slider.angle", "slider.x")


def slider_crank_in_guide(e: float, spin: float, friction: float = 0.0) -> Mechanism:
    """The slider is a block of 100 x 50 mm, with 1 mm to a guide on either side, and turns at `spin` [rad/s]."""
    return replace(in_guide(e, spin, friction), outputs=_SHOWN)


def slider_crank_with_play(e: float, points: int = 2) -> Mechanism:
    """The slider has a pin of 10 mm in a hole of 10.5 mm of the rod, in the middle at first."""
    slider = Body("slider", 0.076, 2.7e-6, start=(CRANK + ROD, 0.0, 0.0))
    rod = Body("rod", 1.0, 1.0)
    guide = Translational("guide", slider.line((0, 0), (1.0, 0.0)), GROUND.line((0, 0), (1.0, 0.0)))
    play = OutlineContact(
        "play",
        slider,
        rod,
        outline_i=Outline.circle(0.01),
        outline_j=Outline.circle(0.0105, (ROD / 2, 0.0), hole=True),
        restitution=e,
        points=points,
    )
    return replace(slider_crank(slider, (guide,), (play,), rod_end=False), outputs=_SHOWN)


#: Coordinates of the four-bar, as the case counts them.
NAMES_OF_FOUR_BAR = ("crank.angle", "coupler.angle", "rocker.angle", "coupler.x", "coupler.y", "rocker.x", "rocker.y")


def joint_with_play(name: str, pin: Body, at_pin: tuple[float, float], hole: Body | str, at_hole: Any, e: float) -> Any:
    """A pin of 50 mm in a hole of 55 mm."""
    return OutlineContact(
        name,
        pin,
        hole,
        outline_i=Outline.circle(0.05, at_pin),
        outline_j=Outline.circle(0.055, at_hole, hole=True),
        restitution=e,
        points=1,
    )


def four_bar_with_play(e: float) -> Mechanism:
    """All joints but that of the crank on the ground have play."""
    made = four_bar(e)
    crank, coupler, rocker = made.bodies
    half = COUPLER / 2
    contacts = (
        joint_with_play("crank-coupler", crank, (CRANK_OF_FOUR / 2, 0.0), coupler, (-half, 0.0), e),
        joint_with_play("coupler-rocker", rocker, (ROCKER / 2, 0.0), coupler, (half, 0.0), e),
        joint_with_play("rocker-ground", rocker, (-ROCKER / 2, 0.0), GROUND, (GROUND_LENGTH, 0.0), e),
    )
    return replace(made, contacts=contacts, outputs=of_body(*NAMES_OF_FOUR_BAR))
