import math
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, strategies as st

from harness.report.plot import frame_rows, strongest
from harness.report.scene import Scene, bounds, names_of
from harness.run.drawing import Shape

CRANK = Shape("bar", (1.0, 0.0), "crank", {"angle": "phi", "length": "a"})
PAWL = Shape("bar", "crank", "pawl", {"angle": "-phi", "length": 1.0})


def scene(*shapes: Shape, phi: list[float], **constants: float) -> Scene:
    return Scene(shapes, {"phi": np.array(phi)}, constants)


def test_a_chain_of_bars_reaches_from_end_to_end() -> None:
    # from (1, 0) by 2 upwards, then by 1 downwards
    assert bounds(scene(CRANK, PAWL, phi=[math.pi / 2], a=2.0)) == pytest.approx((1, 0, 1, 2))


def test_a_slow_bar_is_bounded_by_where_it_was() -> None:
    assert bounds(scene(CRANK, phi=[0.0, 0.1], a=2.0)) == pytest.approx((1, 0, 3, 2 * math.sin(0.1)))


def test_a_bar_that_jumps_may_be_anywhere_in_between() -> None:
    assert bounds(scene(CRANK, PAWL, phi=[0.0, 6.0], a=2.0)) == pytest.approx((-2, -3, 4, 3))


def test_wheels_and_discs_reach_around_their_centres() -> None:
    wheel = Shape("wheel", (0.0, 0.0), "w", {"angle": "phi", "count": 3.0}, ((0.5, 0.0), ("a", 0.1)))
    disc = Shape("disc", (5.0, 1.0), "d", {"radius": 0.25})
    assert bounds(scene(wheel, disc, phi=[0.0], a=2.0)) == (-2, -2, 5.25, 2)


def test_a_line_reaches_as_far_as_its_copies() -> None:
    """One is turned to (0, 1) ... (0, 2), one displaced to (3, 5) ... (4, 5): as the wheel turns, anywhere around."""
    copies = ((0.0, 0.0, math.pi / 2), (2.0, "b", 0.0))
    line = Shape("polyline", (1.0, 0.0), "teeth", {"angle": "phi"}, ((1.0, 0.0), ("a", 0.0)), copies=copies)
    far = math.hypot(4.0, 5.0)
    assert bounds(scene(line, phi=[0.0], a=2.0, b=5.0)) == pytest.approx((1 - far, -far, 1 + far, far))
    assert names_of([line]) == {"phi", "a", "b"}


def test_the_names_of_a_drawing_are_those_of_its_variables() -> None:
    wheel = Shape("wheel", ("x", 0.0), "w", {"angle": "-phi", "count": "n"}, (("r", 0.0), (1.0, "-o")))
    assert names_of([wheel, PAWL, Shape("striker", "pawl")]) == {"x", "phi", "n", "r", "o"}


@given(
    angles=st.lists(st.floats(-20, 20), min_size=2, max_size=8),
    lengths=st.tuples(st.floats(0.1, 3), st.floats(0.1, 3)),
    part=st.floats(0, 1),
)
def test_the_mechanism_stays_in_view_between_the_frames(
    angles: list[float], lengths: tuple[float, float], part: float
) -> None:
    crank = Shape("bar", (0.5, -0.5), "crank", {"angle": "phi", "length": lengths[0]})
    pawl = Shape("bar", "crank", "pawl", {"angle": "-phi", "length": lengths[1]})
    left, bottom, right, top = bounds(scene(crank, pawl, phi=angles))
    # Between frames that are 0.2 rad apart an arc rises above its chord by 0.5 % of the radius.
    spare = 0.005 * sum(lengths) + 1e-9
    for before, after in pairwise(angles):
        phi = before + part * (after - before)
        x, y = 0.5 + lengths[0] * math.cos(phi), -0.5 + lengths[0] * math.sin(phi)
        for px, py in ((x, y), (x + lengths[1] * math.cos(-phi), y + lengths[1] * math.sin(-phi))):
            assert left - spare <= px <= right + spare
            assert bottom - spare <= py <= top + spare


@given(
    steps=st.lists(st.floats(0.01, 1), min_size=1, max_size=300),
    parts=st.lists(st.floats(1e-9, 1), max_size=10),
    limit=st.integers(2, 100),
)
def test_frames_hold_every_instant_between_two_samples(steps: list[float], parts: list[float], limit: int) -> None:
    time = np.concatenate(([0.0], np.cumsum(steps)))
    instants = np.array(parts) * time[-1]
    rows = frame_rows(time, instants, limit)
    assert rows[0] == 0
    assert rows[-1] == len(time) - 1
    assert (np.diff(rows) > 0).all()
    assert len(rows) <= max(limit, 2 * len(parts) + 2)
    for instant in instants:
        after = int(np.flatnonzero(time >= instant)[0])
        assert {after - 1, after} <= set(rows.tolist())


def test_few_samples_are_all_frames() -> None:
    assert frame_rows(np.arange(5.0), np.array([2.0]), 100).tolist() == [0, 1, 2, 3, 4]
    assert frame_rows(np.array([0.0]), np.empty(0), 100).tolist() == [0]


def test_the_strongest_impacts_keep_their_order() -> None:
    impacts = pd.DataFrame({"time": [1.0, 2.0, 3.0, 4.0], "velocity": [-5.0, 1.0, 2.0, 3.0]})
    assert strongest(impacts, 2).tolist() == [1.0, 4.0]
    assert strongest(impacts, 9).tolist() == [1.0, 2.0, 3.0, 4.0]
    assert strongest(impacts[["time"]], 2).tolist() == [1.0, 4.0]
    assert strongest(impacts.head(0), 2).tolist() == []
