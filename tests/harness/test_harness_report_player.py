"""What the player of mechanisms gets: numbers by hand, for a scene of one shape of each kind."""

import json
import math
import re

import numpy as np
import pytest

from harness.report.animation import (
    decimals,
    flags,
    legend,
    picture_data,
    player,
    playing_speeds,
    rounded,
    times_data,
)
from harness.report.motion import Contact
from harness.report.scene import Scene, bounds, names_of
from harness.run.drawing import Shape

SHAPES = (
    Shape("disc", (0.0, 0.0), "eye", {"radius": "size"}),
    Shape("bar", ("x", "-y"), "arm", {"angle": "-turn", "length": 2.0}),
    Shape("bar", "arm", "hand", {"angle": "turn", "length": "size"}),
    Shape("striker", "arm"),
    Shape("wheel", (1.0, 0.0), "wheel", {"angle": "turn", "count": "teeth"}, (("size", 0.0), (0.3, "-y")), True),
    Shape("hinge", (0.0, 0.0), ""),
)
TURN = np.array([0.0, 0.1, 0.2])


def scene(turn: list[float] | np.ndarray = TURN, **constants: float) -> Scene:
    known = {"x": 0.5, "y": 0.25, "size": 0.4, "teeth": 8.0} | constants
    return Scene(SHAPES, {"turn": np.asarray(turn)}, known)


def test_names_that_a_drawing_needs() -> None:
    assert names_of(SHAPES) == {"size", "x", "y", "turn", "teeth"}


def test_shapes_have_plain_numbers_and_columns_with_their_sign() -> None:
    data = picture_data(scene(), {"turn"})
    assert data is not None
    assert data["columns"] == [[0.0, 0.1, 0.2]]
    assert data["shapes"] == [
        {"kind": "disc", "name": "eye", "at": [0.0, 0.0], "radius": 0.4, "colour": "#c9d2dc"},
        {"kind": "bar", "name": "arm", "at": [0.5, -0.25], "angle": [0, -1], "length": 2.0, "pointed": True}
        | {"colour": "#0072B2"},
        {"kind": "bar", "name": "hand", "at": "arm", "angle": [0, 1], "length": 0.4, "pointed": False}
        | {"colour": "#D55E00"},
        {"kind": "striker", "name": "", "at": "arm"},
        {"kind": "wheel", "name": "wheel", "at": [1.0, 0.0], "angle": [0, 1], "count": 8, "pitch": -math.pi / 4}
        | {"outline": [[0.4, 0.0], [0.3, -0.25]], "colour": "#c9d2dc"},
        {"kind": "hinge", "name": "", "at": [0.0, 0.0]},
    ]


def test_the_view_holds_everything_at_all_times() -> None:
    """The arm from (0.5, -0.25), 2 m long at 0 to -0.2 rad; the hand 0.4 m from its end, at 0 to 0.2 rad."""
    end_x, end_y = 0.5 + 2 * np.cos(TURN), -0.25 - 2 * np.sin(TURN)
    hand_x, hand_y = end_x + 0.4 * np.cos(TURN), end_y + 0.4 * np.sin(TURN)
    # left: the disc; below: the arm's end; right: the hand's; above: disc and wheel, of the same radius
    assert bounds(scene()) == pytest.approx((-0.4, min(end_y.min(), hand_y.min()), hand_x.max(), 0.4))


def test_a_bar_that_turns_far_between_two_frames_may_point_anywhere() -> None:
    shapes = (Shape("bar", (1.0, 2.0), "arm", {"angle": "turn", "length": -3.0}),)
    assert bounds(Scene(shapes, {"turn": np.array([0.0, 0.21])}, {})) == (-2.0, -1.0, 4.0, 5.0)
    left, bottom, right, top = bounds(Scene(shapes, {"turn": np.array([0.0, 0.19])}, {}))
    assert (left, right, top) == (-2.0, 1.0, 2.0)
    assert bottom == pytest.approx(2.0 - 3 * math.sin(0.19))


@pytest.mark.parametrize(("teeth", "count"), [(8.4, 8), (0.0, 1), (-3.0, 1), (9_999.0, 9_999), (1e6, 10_000)])
def test_a_wheel_has_at_least_one_tooth_and_not_too_many(teeth: float, count: int) -> None:
    data = picture_data(scene(teeth=teeth), set())
    assert data is not None
    wheel = data["shapes"][4]
    assert (wheel["count"], wheel["pitch"]) == (count, -2 * math.pi / count)


@pytest.mark.parametrize(("radius", "drawn"), [(1e-10, True), (1.1e-12, True), (0.4e-12, False), (0.0, False)])
def test_how_small_a_mechanism_may_be(radius: float, drawn: bool) -> None:
    """Its picture is at least 1e-12 m wide or high."""
    tiny = Scene((Shape("disc", (0.0, 0.0), "d", {"radius": radius}),), {}, {})
    assert (picture_data(tiny, set()) is not None) is drawn


@pytest.mark.parametrize("broken", [{"turn": [0.0, math.nan]}, {"x": math.inf}])
def test_what_is_not_finite_is_no_picture(broken: dict) -> None:
    assert picture_data(scene(**broken), set()) is None


def test_lengths_are_rounded_to_what_is_seen_and_angles_to_four_digits() -> None:
    """The picture is 100 m wide, of which a ten-thousandth is seen: 1 cm."""
    shapes = (Shape("bar", ("x", 0.0), "arm", {"angle": "turn", "length": 0.0}),)
    columns = {"x": np.array([0.0, 33.33333333, 100.0]), "turn": np.array([0.0, 0.123456789, 0.2])}
    data = picture_data(Scene(shapes, columns, {}), {"turn"})
    assert data is not None
    assert data["columns"] == [[0.0, 33.33, 100.0], [0.0, 0.1235, 0.2]]
    assert data["view"] == [0.0, 0.0, 100.0, 0.0]


@pytest.mark.parametrize(("step", "places"), [(1.0, 0), (10.0, 0), (0.5, 1), (0.1, 1), (0.09, 2), (1e-3, 3), (2e-5, 5)])
def test_decimals_that_tell_steps_apart(step: float, places: int) -> None:
    assert decimals(step) == places


def test_the_clock_of_a_run() -> None:
    data = times_data(np.array([0.0, 0.123456789, 2.0]))
    # a hundredth of the shortest time between frames, 1.2 ms
    assert data["time"] == [0.0, 0.123, 2.0]
    assert data["decimals"] == 3
    assert data["speed"] == 1.0
    assert data["speeds"] == [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0]
    still = times_data(np.array([3.0]))
    assert (still["time"], still["decimals"], still["speed"]) == ([3.0], 0, 1.0)


@pytest.mark.parametrize(
    ("span", "slowest", "fastest", "speed"),
    [
        (2.0, 0.1, 10.0, 1.0),
        (1.99, 0.01, 10.0, 0.5),
        (20.0, 0.1, 10.0, 1.0),
        (20.01, 0.1, 10.0, 2.0),
        (0.2, 0.01, 10.0, 0.1),
        (0.02, 0.001, 10.0, 0.01),
        (200.0, 0.1, 10.0, 10.0),
        (201.0, 0.1, 100.0, 20.0),
        (3600.0, 0.1, 1000.0, 200.0),
        (0.0, 0.1, 10.0, 1.0),
    ],
)
def test_speeds_of_known_runs(span: float, slowest: float, fastest: float, speed: float) -> None:
    speeds, default = playing_speeds(span)
    assert (speeds[0], speeds[-1], default) == (slowest, fastest, speed)


def test_flags_and_rounded_numbers() -> None:
    assert flags([True, 0, 1, False]) == "1010"
    assert rounded(np.array([1.23456, -0.5]), 2) == [1.23, -0.5]


def test_the_element_has_its_parts_in_order() -> None:
    data = {"speeds": [0.5, 1.0, 2.0], "speed": 1.0, "impacts": [0.25], "note": "</script>"}
    html = player(data, "<svg></svg>")
    assert html.startswith('<div class="animation"><svg></svg><div class="timeline">')
    held = re.search(r'<script type="application/json">(.*?)</script>', html)
    assert held is not None
    assert json.loads(held[1]) == data
    assert '<option value="0.5">0.5×</option><option value="1.0" selected>1×</option><option value="2.0">2×' in html
    assert '<button type="button" class="next">Next impact</button>' in html
    assert "Next impact</button>" not in player(data | {"impacts": []}, "")


def test_a_legend_names_parts_and_lamps() -> None:
    shapes = [{"name": "a <b>", "colour": "#111111"}, {"name": "", "colour": "#222222"}]
    assert legend(shapes, []) == (
        '<div class="legend"><ul><li><i style="background:#111111"></i>a &lt;b&gt;</li></ul></div>'
    )
    lamps = legend([], [Contact("face", "face_active", "#333333")])
    assert '<ul class="lamps"><li>active contacts:</li><li class="lamp" style="--lamp:#333333">face</li></ul>' in lamps
