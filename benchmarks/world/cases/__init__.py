"""The cases, one to a file, in the order of the index."""

from __future__ import annotations

from ..case import Case
from . import (
    andrews,
    bouncing_ball,
    cam_follower,
    chain,
    clearance_four_bar,
    clearance_slider_crank,
    equal_slider_crank,
    geneva,
    governor,
    graham,
    impacting_stick,
    n_four_bar,
    newtons_cradle,
    painleve_rod,
    pendulum,
    rockers,
    rocking_block,
    trains,
    two_masses,
    verge_foliot,
    woodpecker,
)

CASES: dict[str, Case] = {
    module.CASE.name: module.CASE
    for module in (
        *(andrews, pendulum, chain, n_four_bar, equal_slider_crank, rockers, governor, trains, geneva),
        *(bouncing_ball, newtons_cradle, rocking_block, impacting_stick, painleve_rod, woodpecker, cam_follower),
        *(clearance_slider_crank, clearance_four_bar, verge_foliot, graham, two_masses),
    )
}
