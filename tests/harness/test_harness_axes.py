"""The numbers of charts on a page, as its script finds them in node."""

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import harness.report

NODE = shutil.which("node")
pytestmark = pytest.mark.skipif(NODE is None, reason="no node is installed (on Debian: apt install nodejs)")

#: What stands for a function between numbers and pixels: [scale, offset].
SCRIPT = """
const AXES = require(process.argv[1]), asked = JSON.parse(require("fs").readFileSync(0, "utf8"));
const linear = (given) => given && given.scale !== undefined ? (value) => given.scale * value + given.offset : given;
console.log(JSON.stringify(asked.map(([name, ...given]) => AXES[name](...given.map(linear)))));
"""


def answers(*calls: list[Any]) -> list[Any]:
    """What functions of axes.js give."""
    script = Path(harness.report.__file__).with_name("axes.js")
    assert NODE is not None
    ended = subprocess.run(
        [NODE, "-e", SCRIPT, str(script)], input=json.dumps(calls), capture_output=True, text=True, check=True
    )
    found: list[Any] = json.loads(ended.stdout)
    return found


def linear(scale: float, offset: float = 0.0) -> dict[str, float]:
    return {"scale": scale, "offset": offset}


def points(path: str) -> list[tuple[float, float]]:
    return [(float(x), float(y)) for x, y in re.findall(r"[ML](\S+?) (-?[\d.]+)", path)]


def test_ticks_are_round_and_few() -> None:
    calls = [[0, 6, 6], [-0.031, 0.02, 5], [0, 1e-5, 4], [-0.11, 0.31, 5], [1e6, 1.00003e6, 5]]
    assert answers(*(["ticks", *call] for call in calls)) == [
        [0, 1, 2, 3, 4, 5, 6],
        [-0.02, 0, 0.02],
        [0, 5e-6, 1e-5],
        [-0.1, 0, 0.1, 0.2, 0.3],
        [1000000, 1000010, 1000020, 1000030],
    ]


def test_ticks_end_where_numbers_can_hardly_be_told_apart() -> None:
    """One more was the same number there, for ever."""
    found = answers(["ticks", 1e6, 1e6 + 1e-9, 6], ["ticks", 0.9399211769321433, 0.9399211769321435, 6])
    assert all(len(ticks) <= 25 for ticks in found)


def test_logarithmic_ticks_are_powers_of_ten_and_more_where_these_are_few() -> None:
    found = answers(["decades", 1e-3, 1e4, 5], ["decades", 30, 400, 5], ["decades", 1, 1e12, 4])
    assert found == [[0.01, 1, 100, 10_000], [50, 100, 200], [1, 1e3, 1e6, 1e9, 1e12]]


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0, "0"),
        (-1.5, "−1.5"),
        (12345.678, "12346"),
        (2.5e7, "25·10⁶"),
        (-3.21e-5, "−32.1·10⁻⁶"),
        (0.01234567, "0.012346"),
        (None, "–"),
    ],
)
def test_numbers_for_people(value: float | None, text: str) -> None:
    assert answers(["number", value]) == [text]


def test_labels_leave_out_a_power_of_ten_and_are_apart() -> None:
    assert answers(["labels", [0, 5e5, 1e6], 6], ["labels", [-0.02, 0, 0.02], 0], ["labels", [7], 0]) == [
        ["0.0", "0.5", "1.0"],
        ["−0.02", "0.00", "0.02"],
        ["7"],
    ]


def test_the_value_of_a_curve_lies_between_its_points_or_is_what_it_steps_to() -> None:
    x, y = [0, 1, 1, 2], [0, 10, 20, 30]
    found = answers(*(["valueAt", x, y, at] for at in (0, 0.25, 1, 1.5, 2, 2.5)))
    assert found == [0, 2.5, 20, 25, 30, None]


def test_only_what_goes_from_left_to_right_has_a_cursor() -> None:
    assert answers(*(["isOver", x] for x in ([0, 1, 1, 2], [0, 2, 1], [0, None, 1], [5], []))) == [
        *(True, False, False, False, False)
    ]


def test_a_long_curve_becomes_few_points_and_keeps_every_peak() -> None:
    rng = np.random.default_rng(3)
    x, y = np.linspace(0.0, 100.0, 20_001), rng.normal(size=20_001)
    y[12_345] = 50.0
    [path] = answers(["path", x.tolist(), y.tolist(), 0, len(x), linear(1.0), linear(-1.0)])
    drawn = np.array(points(path))
    assert len(drawn) <= 4 * 101
    assert path.count("M") == 1
    assert (np.diff(drawn[:, 0]) >= 0).all()
    assert drawn[:, 1].min() == -50.0
    seen = set(np.round(10 * drawn[:, 1]).astype(int).tolist())
    # of each column of pixels the least and the greatest are there
    columns = np.floor(x).astype(int)
    for pixel in range(100):
        own = -y[columns == pixel]
        assert {round(10 * own.min()), round(10 * own.max())} <= seen


def test_a_short_curve_keeps_all_points_and_a_gap_stays_a_gap() -> None:
    [path] = answers(["path", [0, 1, 2, 3, 4], [0, 1, None, 1, 0], 0, 5, linear(10.0), linear(10.0)])
    assert path == "M0 0L10 10M30 10L40 0"
    [part] = answers(["path", [0, 1, 2, 3, 4], [0, 1, 2, 3, 4], 1, 3, linear(10.0), linear(10.0)])
    assert points(part) == [(10.0, 10.0), (20.0, 20.0)]


def test_dots_in_one_place_are_one() -> None:
    [path] = answers(["dots", [1, 1.01, 2, None], [1, 1, 2, 3], linear(10.0), linear(10.0)])
    assert path == "M10 10h0M20 20h0"
