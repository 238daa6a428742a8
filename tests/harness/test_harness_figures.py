"""Charts as data, drawn into SVG, PNG and reports."""

import io
import json
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st
from PIL import Image

from harness.errors import UsageError
from harness.report.page import chart
from harness.report.plot import Curve, Plot, interactive
from harness.report.static import Png, Svg, draw_plot, tick_labels, ticks, write_static

BLUE = "#0072B2"
NAMESPACE = "{http://www.w3.org/2000/svg}"


def plot(*curves: Curve, **more: bool) -> Plot:
    return Plot("Stress & strain", "slope angle β₀ [deg]", "stress [kPa]", curves, **more)


DIAGONAL = Curve("one < two", [0.0, 10.0], [0.0, 5.0], BLUE)


class Notes:
    """A canvas that keeps lines and texts."""

    def __init__(self) -> None:
        self.lines: dict[str, list[list[tuple[float, float]]]] = {}
        self.texts: dict[str, tuple[float, float]] = {}

    def line(self, points, colour, width):
        self.lines.setdefault(colour, []).append(list(points))

    def area(self, points, colour):
        self.lines.setdefault(colour, []).append(list(points))

    def dot(self, centre, radius, colour):
        self.lines.setdefault(colour, []).append([centre])

    def text(self, at, text, size, anchor="middle", upright=True):
        self.texts[text] = at


def drawn(*curves: Curve, **more: bool) -> Notes:
    notes = Notes()
    draw_plot(notes, plot(*curves, **more), (0.0, 0.0), 400.0, 300.0)
    return notes


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        (0.0, 1.0, ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]),
        (84.2, 105.8, ["85", "90", "95", "100", "105"]),
        (-0.031, 0.02, ["−0.03", "−0.02", "−0.01", "0.00", "0.01", "0.02"]),
        (0.0, 23e3, ["0", "5000", "10000", "15000", "20000"]),
    ],
)
def test_ticks_are_round_numbers(low: float, high: float, expected: list[str]) -> None:
    assert tick_labels(ticks(low, high)) == expected


@given(st.floats(-1e6, 1e6), st.floats(1e-3, 1e6))
def test_ticks_lie_within_evenly_and_are_few_but_not_too_few(low: float, span: float) -> None:
    found = ticks(low, low + span)
    assert 2 <= len(found) <= 8
    assert low - 1e-6 * span <= found[0]
    assert found[-1] <= low + span * (1 + 1e-6)
    assert np.ptp(np.diff(found)) <= 1e-9 * max(abs(low), span)
    assert len(set(tick_labels(found))) == len(found)


def test_a_curve_stands_where_the_ticks_say() -> None:
    notes = drawn(DIAGONAL)
    (x0, y0), (x1, y1) = notes.lines[BLUE][0]
    assert notes.texts["0"][0] == pytest.approx(x0) or notes.texts["0"][1] == pytest.approx(y0)
    assert notes.texts["10"][0] == pytest.approx(x1)
    assert notes.texts["5"][1] == pytest.approx(y1)
    assert y1 < y0  # up


def test_shapes_are_drawn_to_scale() -> None:
    circle = np.linspace(0, 2 * np.pi, 101)
    points = np.array(drawn(Curve("wheel", 3 * np.cos(circle), 3 * np.sin(circle), BLUE), to_scale=True).lines[BLUE][0])
    radii = np.hypot(*(points - points[:-1].mean(axis=0)).T)
    assert radii == pytest.approx(radii[0] * np.ones(101), rel=1e-12)


def test_stress_begins_at_zero_when_asked() -> None:
    notes = drawn(Curve("a", [0.0, 1.0], [80.0, 90.0], BLUE), from_zero=True)
    assert "0" in notes.texts
    assert "0" not in drawn(Curve("a", [2.0, 3.0], [80.0, 90.0], BLUE)).texts


def test_curves_of_one_name_have_one_entry_in_the_legend() -> None:
    notes = drawn(DIAGONAL, Curve("one < two", [5.0], [2.5], BLUE, line=False, dots=True))
    # the curve, its dot, and one line in the legend
    assert [len(points) for points in notes.lines[BLUE]] == [2, 1, 2]
    assert "one < two" not in drawn(DIAGONAL, legend=False).texts


def test_both_files_are_the_same_picture_and_reproducible(tmp_path: Path) -> None:
    first = [path.read_bytes() for path in write_static([plot(DIAGONAL)] * 3, tmp_path / "a")]
    again = [path.read_bytes() for path in write_static([plot(DIAGONAL)] * 3, tmp_path / "b")]
    assert first == again
    svg = ElementTree.fromstring(first[0])
    size = int(svg.attrib["width"]), int(svg.attrib["height"])
    image = Image.open(io.BytesIO(first[1]))
    assert image.size == (1.5 * size[0], 1.5 * size[1])
    texts = [element.text for element in svg.iter(f"{NAMESPACE}text")]
    assert texts.count("Stress & strain") == 3
    assert texts.count("slope angle β₀ [deg]") == 3
    line = next(e for e in svg.iter(f"{NAMESPACE}polyline") if e.attrib["stroke"] == BLUE)
    (x0, y0), (x1, y1) = (map(float, point.split(",")) for point in line.attrib["points"].split())
    middle = round(1.5 * (x0 + x1) / 2), round(1.5 * (y0 + y1) / 2)
    around = [image.getpixel((middle[0], middle[1] + k)) for k in range(-2, 3)]
    assert (0x00, 0x72, 0xB2) in around


def test_png_says_greek_letters_in_words() -> None:
    """The font that comes with Pillow has none; a box would stand for each."""

    def picture(text: str) -> bytes:
        canvas = Png(300, 40)
        canvas.text((150, 20), text, 13)
        return canvas.file()

    assert picture("β₀ − σ") == picture("beta_0 - sigma")


def test_what_the_disk_refuses_is_told(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="cannot be written"):
        write_static([plot(DIAGONAL)], tmp_path / "nowhere" / "figure")
    assert not list(tmp_path.iterdir())


def test_texts_in_an_svg_are_escaped() -> None:
    canvas = Svg(100, 100)
    canvas.text((1, 1), "<b> & co", 12)
    assert next(ElementTree.fromstring(canvas.file()).iter(f"{NAMESPACE}text")).text == "<b> & co"


def test_a_plot_in_a_report_has_its_units_curves_and_colours_of_the_page() -> None:
    twin = Curve("one < two", [1.0], [float("nan")], "#123456", line=False, dots=True, about="x_y", labels=["first"])
    figure = interactive(plot(DIAGONAL, twin, to_scale=True, from_zero=True), height=90)
    assert {name: figure[name] for name in ("title", "x", "y", "height", "to_scale", "from_zero")} == {
        "title": "Stress & strain",
        "x": "slope angle β₀ [deg]",
        "y": "stress [kPa]",
        "height": 90,
        "to_scale": True,
        "from_zero": True,
    }
    assert figure["curves"][0] == {
        "name": "one < two",
        "x": [0.0, 10.0],
        "y": [0.0, 5.0],
        "colour": "var(--c1)",
        "line": True,
    }
    assert [figure["curves"][1][name] for name in ("colour", "line", "dots", "about", "labels")] == [
        "#123456",
        False,
        True,
        "x_y",
        ["first"],
    ]


def test_a_chart_holds_its_figure_as_json_that_cannot_close_its_script() -> None:
    figure = interactive(plot(Curve("</script>", [1.0], [2.0], BLUE)))
    [text] = re.findall(r'<script type="application/json">(.*?)</script>', chart(figure))
    assert json.loads(text) == figure
