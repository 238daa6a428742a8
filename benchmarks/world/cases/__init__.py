"""The cases, one to a file, in the order of the index."""

from __future__ import annotations

from ..case import Case
from . import (
    andrews,
    bouncing_ball,
    cam_follower,
    clearance_four_bar,
    clearance_slider_crank,
    equal_slider_crank,
    n_four_bar,
    pendulum,
    rockers,
    rocking_block,
    trains,
    woodpecker,
)

CASES: dict[str, Case] = {
    module.CASE.name: module.CASE
    for module in (
        *(andrews, pendulum, n_four_bar, equal_slider_crank, rockers),
        *(trains, bouncing_ball, rocking_block, woodpecker, cam_follower),
        *(clearance_slider_crank, clearance_four_bar),
    )
}
