"""Where axes, ticks, curves and texts of a figure stand, to the tenth of a pixel; and what the PNG makes of them."""

import io
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest
from PIL import Image

from harness.report.plot import Curve, Plot
from harness.report.static import Png, Svg, draw_plot, svg_text, tick_labels, ticks, write_static
from tests.kept import same_as_kept

RED, BLUE = "#d00000", "#0072B2"
PLAIN = Plot("A <title>", "x [s]", "y [m]", [Curve("one", [0.0, 10.0], [0.0, 5.0], BLUE)])


@pytest.mark.parametrize(
    ("low", "high", "intervals", "expected"),
    [
        (0.0, 7.0, 7, [0, 1, 2, 3, 4, 5, 6, 7]),
        (0.0, 7.1, 7, [0, 2, 4, 6]),
        (0.0, 14.0, 7, [0, 2, 4, 6, 8, 10, 12, 14]),
        (0.0, 14.1, 7, [0, 5, 10]),
        (0.0, 35.0, 7, [0, 5, 10, 15, 20, 25, 30, 35]),
        (0.0, 35.1, 7, [0, 10, 20, 30]),
        (-0.3, 0.3, 3, [-0.2, 0.0, 0.2]),
        (0.1, 0.3, 2, [0.1, 0.2, 0.3]),
        (90.0, 190.0, 5, [100, 120, 140, 160, 180]),
        (2.0000000001, 3.9999999999, 2, [2, 3, 4]),
        (2.0001, 3.9999, 2, [3]),
    ],
)
def test_ticks_of_known_ranges(low: float, high: float, intervals: int, expected: list[float]) -> None:
    assert ticks(low, high, intervals) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([0.0, 1.0], ["0", "1"]),
        ([-0.5, 0.0, 0.5], ["−0.5", "0.0", "0.5"]),
        ([0.1, 0.11], ["0.10", "0.11"]),
        ([0.0, 0.1], ["0.0", "0.1"]),
        ([100.0, 300.0], ["100", "300"]),
        ([2.0], ["2"]),
        ([], []),
    ],
)
def test_labels_have_as_few_decimals_as_tell_ticks_apart(values: list[float], expected: list[str]) -> None:
    assert tick_labels(values) == expected


class Recorded:
    """A canvas that keeps what is drawn, in order."""

    def __init__(self) -> None:
        self.lines: list[tuple[str, float, npt.NDArray[np.float64]]] = []
        self.areas: list[tuple[str, npt.NDArray[np.float64]]] = []
        self.dots: list[tuple[str, float, tuple[float, float]]] = []
        self.texts: list[tuple[str, tuple[float, float], float, str, bool]] = []

    def line(self, points, colour, width):
        self.lines.append((colour, width, np.array(points)))

    def area(self, points, colour):
        self.areas.append((colour, np.array(points)))

    def dot(self, centre, radius, colour):
        self.dots.append((colour, radius, centre))

    def text(self, at, text, size, anchor="middle", upright=True):
        self.texts.append((text, (round(at[0], 6), round(at[1], 6)), size, anchor, upright))


def recorded(plot: Plot, corner: tuple[float, float] = (100.0, 200.0)) -> Recorded:
    kept = Recorded()
    draw_plot(kept, plot, corner, 500.0, 300.0)
    return kept


def test_axes_by_hand() -> None:
    """Room of 64, 34, 52 and 124 px around the axes: 312 px for 1.08 times 10 s, 214 px for 1.08 times 5 m."""
    kept = recorded(PLAIN)
    [(_, width, curve)] = [line for line in kept.lines if line[0] == BLUE and len(line[2]) == 2 and line[2][0, 0] < 476]
    left, right, top, bottom = 164.0, 476.0, 234.0, 448.0
    assert width == 2
    x = [left + (right - left) * (value + 0.4) / 10.8 for value in (0.0, 10.0)]
    y = [bottom - (bottom - top) * (value + 0.2) / 5.4 for value in (0.0, 5.0)]
    np.testing.assert_allclose(curve, np.column_stack((x, y)), atol=1e-9)
    labels = {text: (at, size, anchor) for text, at, size, anchor, _ in kept.texts}
    for value in (2, 4, 6, 8, 10):
        place = (round(left + (right - left) * (value + 0.4) / 10.8, 6), bottom + 14)
        assert (str(value), place, 12.0, "middle", True) in kept.texts
    for value in (1, 3, 5):
        place = (left - 7, round(bottom - (bottom - top) * (value + 0.2) / 5.4, 6))
        assert (str(value), place, 12.0, "end", True) in kept.texts
    assert labels["A <title>"] == ((320.0, 218.0), 15.0, "middle")
    assert labels["x [s]"] == ((320.0, 484.0), 13.0, "middle")
    assert ("y [m]", (114.0, 341.0), 13.0, "middle", False) in kept.texts
    assert labels["one"] == ((510.0, 244.0), 12.0, "start")
    np.testing.assert_allclose(kept.lines[-1][2], [(488.0, 244.0), (504.0, 244.0)])


def test_grid_and_frame_by_hand() -> None:
    kept = recorded(PLAIN)
    grid = [points for colour, width, points in kept.lines if colour == "#dfe5ea" and width == 1]
    assert len(grid) == 6 + 6
    assert all(line[:, 1].tolist() == [448.0, 234.0] and np.ptp(line[:, 0]) == 0 for line in grid[:6])
    assert all(line[:, 0].tolist() == [164.0, 476.0] and np.ptp(line[:, 1]) == 0 for line in grid[6:])
    [frame] = [points for colour, width, points in kept.lines if colour == "#5b6875" and width == 1]
    assert frame.tolist() == [[164.0, 234.0], [164.0, 448.0], [476.0, 448.0]]


def test_without_legend_there_is_room() -> None:
    kept = recorded(Plot("", "", "", PLAIN.curves, legend=False))
    [frame] = [points for colour, _, points in kept.lines if colour == "#5b6875"]
    assert frame[-1].tolist() == [582.0, 448.0]


@pytest.mark.parametrize(
    ("y", "low", "high"), [([5.0, 5.0], 0.0, 10.0), ([0.0, 0.0], -1.0, 1.0), ([-5.0, -5.0], -10.0, 0.0)]
)
def test_a_level_curve_has_room_of_its_own_height(y: list[float], low: float, high: float) -> None:
    kept = recorded(Plot("", "", "", [Curve("one", [0.0, 1.0], y, BLUE)]))
    middle = (234.0 + 448.0) / 2
    assert next(points for colour, _, points in kept.lines if colour == BLUE)[0, 1] == pytest.approx(middle)
    said = [text for text, at, _, anchor, _ in kept.texts if anchor == "end" and at[1] in (234.0, 448.0)]
    assert {float(text.replace("−", "-")) for text in said} == {low, high}


def test_from_zero_only_the_lower_end_moves() -> None:
    kept = recorded(Plot("", "", "", [Curve("one", [0.0, 1.0], [4.0, 5.0], BLUE)], from_zero=True))
    points = next(points for colour, _, points in kept.lines if colour == BLUE)
    np.testing.assert_allclose(points[:, 1], [448.0 - 214.0 * y / 5.04 for y in (4.0, 5.0)])


def test_to_scale_the_middle_stays() -> None:
    """The unit square: 312 by 214 px, so 1.08 m is 214 px high."""
    square = Curve("one", [0.0, 1.0, 1.0, 0.0], [0.0, 0.0, 1.0, 1.0], BLUE)
    points = next(p for c, _, p in recorded(Plot("", "", "", [square], to_scale=True)).lines if c == BLUE)
    side = 214.0 / 1.08
    np.testing.assert_allclose(points.mean(axis=0), (320.0, 341.0))
    np.testing.assert_allclose(np.diff(points, axis=0), [(side, 0), (0, -side), (-side, 0)], atol=1e-9)


def test_a_filled_curve_is_paler_inside_and_dots_are_dots() -> None:
    filled = Curve("one", [0, 1, 1], [0, 0, 1], "#0072B2", line=False, filled=True)
    dots = Curve("two", [0.0], [0.5], RED, line=False, dots=True)
    kept = recorded(Plot("", "", "", [filled, dots]))
    [(colour, points)] = kept.areas
    # a quarter of each part's distance to white, whole steps of it
    assert colour == f"#{255 - 255 // 4:02x}{255 - (255 - 0x72) // 4:02x}{255 - (255 - 0xB2) // 4:02x}"
    assert points.shape == (3, 2)
    [(colour, radius, centre)] = kept.dots
    assert (colour, radius) == (RED, 3.5)
    assert centre[1] == pytest.approx(341.0)


def test_entries_of_a_legend_stand_below_each_other_with_the_first_curve_of_their_name() -> None:
    curves = [Curve(name, [0.0, 1.0], [0.0, 1.0], colour) for name, colour in (("a", RED), ("b", BLUE), ("a", BLUE))]
    kept = recorded(Plot("", "", "", curves))
    entries = [(text, at) for text, at, *_ in kept.texts if text in ("a", "b")]
    assert entries == [("a", (510.0, 244.0)), ("b", (510.0, 264.0))]
    assert [colour for colour, _, _ in kept.lines[-2:]] == [RED, BLUE]
    assert kept.lines[-1][2].tolist() == [[488.0, 264.0], [504.0, 264.0]]


def test_kept_figures() -> None:
    """Letter by letter: an SVG has a decimal of a pixel."""
    turn = np.linspace(0.0, 2 * np.pi, 13)
    wheel = Curve("wheel", 3 * np.cos(turn), 3 * np.sin(turn), "#5b6875", filled=True)
    wave = Curve("wave & dots", turn, np.sin(turn), RED, dots=True)
    same_as_kept(
        "figures.svg",
        svg_text(
            [
                PLAIN,
                Plot("To scale", "x [mm]", "y [mm]", [wheel], to_scale=True, legend=False),
                Plot("From zero", "β₀ [deg]", "σ [kPa]", [Curve("a", [85, 105], [80, 90], BLUE), wave], from_zero=True),
            ]
        ),
    )


def test_plots_stand_two_to_a_row(tmp_path) -> None:
    for count, size in ((1, (480, 340)), (2, (960, 340)), (3, (960, 680)), (4, (960, 680)), (5, (960, 1020))):
        written = write_static([PLAIN] * count, tmp_path / "figure")
        assert [path.name for path in written] == ["figure.svg", "figure.png"]
        assert f'width="{size[0]}" height="{size[1]}"' in written[0].read_text()
        with Image.open(written[1]) as image:
            assert image.size == (1.5 * size[0], 1.5 * size[1])


def test_an_svg_of_one_of_each() -> None:
    svg = Svg(100, 50)
    svg.line([(1, 2), (3.25, 4.06)], RED, 1.5)
    svg.area([(1, 2), (3, 4), (5, 6)], BLUE)
    svg.dot((10, 20), 3.5, RED)
    svg.text((1, 2), "a", 12)
    svg.text((1, 2), "b", 13.5, "end", upright=False)
    lines = svg.file().decode().splitlines()
    font = "font-family=\"Arial, Helvetica, 'DejaVu Sans', sans-serif\""
    assert lines == [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 50" width="100" height="50" {font} fill="none" '
        'stroke-linejoin="round" stroke-linecap="round">',
        '<rect width="100" height="50" fill="#ffffff"/>',
        f'<polyline points="1.0,2.0 3.2,4.1" stroke="{RED}" stroke-width="1.5"/>',
        f'<polygon points="1.0,2.0 3.0,4.0 5.0,6.0" fill="{BLUE}"/>',
        f'<circle cx="10.0" cy="20.0" r="3.5" fill="{RED}"/>',
        '<text x="1.0" y="2.0" dy="0.36em" font-size="12" text-anchor="middle" fill="#1c2733">a</text>',
        '<text x="1.0" y="2.0" dy="0.36em" font-size="13.5" text-anchor="end" fill="#1c2733" '
        'transform="rotate(-90 1.0 2.0)">b</text>',
        "</svg>",
    ]


def ink(draw: Callable[[Png], None]) -> tuple[float, float, float, float]:
    """Left, top, right, bottom [px] of what is drawn on 100 by 60 px; a PNG has 1.5 pixels for each."""
    png = Png(100, 60)
    draw(png)
    image = Image.open(io.BytesIO(png.file()))
    assert image.size == (150, 90)
    rows, columns = np.nonzero(np.asarray(image.convert("L")) < 128)
    return columns.min() / 1.5, rows.min() / 1.5, (columns.max() + 1) / 1.5, (rows.max() + 1) / 1.5


def test_a_png_has_lines_areas_and_dots_where_they_belong() -> None:
    line = ink(lambda png: png.line([(10, 20), (90, 20)], "#000000", 4))
    assert line == pytest.approx((10, 18, 90, 22), abs=0.7)
    thin = ink(lambda png: png.line([(10, 20), (90, 20)], "#000000", 0.7))
    assert thin[3] - thin[1] <= 1.4
    assert ink(lambda png: png.area([(10, 5), (40, 5), (40, 50)], "#000000")) == pytest.approx((10, 5, 40, 50), abs=0.7)
    assert ink(lambda png: png.dot((50, 30), 8, "#000000")) == pytest.approx((42, 22, 58, 38), abs=0.7)


@pytest.mark.parametrize(("anchor", "left", "right"), [("start", 50, None), ("middle", None, None), ("end", None, 50)])
def test_a_text_of_a_png_stands_at_its_anchor(anchor: str, left: float | None, right: float | None) -> None:
    box = ink(lambda png: png.text((50, 30), "HHHH", 12, anchor))
    assert (box[1] + box[3]) / 2 == pytest.approx(30, abs=1.5)
    assert 7 < box[3] - box[1] < 12  # a capital is some 0.7 of the size
    if left is None and right is None:
        assert (box[0] + box[2]) / 2 == pytest.approx(50, abs=1)
    assert left is None or box[0] == pytest.approx(left, abs=1.6)
    assert right is None or box[2] == pytest.approx(right, abs=1.6)


def test_a_text_that_reads_upwards_is_the_level_one_turned() -> None:
    level = ink(lambda png: png.text((50, 30), "HLLL", 12))
    upright = ink(lambda png: png.text((50, 30), "HLLL", 12, upright=False))
    assert upright[3] - upright[1] == pytest.approx(level[2] - level[0], abs=1.4)
    assert upright[2] - upright[0] == pytest.approx(level[3] - level[1], abs=1.4)
    assert (upright[0] + upright[2]) / 2 == pytest.approx(50, abs=1.5)
    assert (upright[1] + upright[3]) / 2 == pytest.approx(30, abs=1.5)


def test_a_text_that_reads_upwards_begins_below() -> None:
    png = Png(60, 100)
    png.text((30, 50), "H....", 20, upright=False)
    rows = np.asarray(Image.open(io.BytesIO(png.file())).convert("L")) < 128
    middle = rows.sum(axis=1)
    assert middle[75:].sum() > 3 * middle[:75].sum()


def test_a_text_that_reads_upwards_covers_no_more_than_it_needs() -> None:
    """A margin of two fine pixels on each side, and what the font says of its height."""
    png = Png(100, 60)
    png.area([(0, 0), (100, 0), (100, 60), (0, 60)], RED)
    png.text((50, 30), "HHHH", 12, upright=False)
    pixels = np.asarray(Image.open(io.BytesIO(png.file())).convert("RGB")).astype(int)
    rows, columns = np.nonzero(pixels[:, :, 0] - pixels[:, :, 1] < 100)
    box = ink(lambda png: png.text((50, 30), "HHHH", 12, upright=False))
    for mine, of_text in zip((columns.min(), rows.min(), columns.max() + 1, rows.max() + 1), box, strict=True):
        assert mine / 1.5 == pytest.approx(of_text, abs=2.5)
