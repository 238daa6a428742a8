"""The program of the first page prints what stands below it, and the moving picture of README.md is that of its run."""

import re
from pathlib import Path

import pytest
from pages import examples, what_prints

from docs.drawings.ratchet_moving import PICTURE, drawing, run

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.parametrize("name", ["index.md"])
def test_examples_print_what_the_page_says(name: str) -> None:
    found = examples(DOCS / name)
    assert found
    for program, expected in found:
        assert what_prints(program, DOCS / name) == expected


def test_the_moving_picture_is_that_of_a_run() -> None:
    """Of a stroke in which the wheel goes on by one tooth of 18 deg, so that it can begin again."""
    result = run()
    assert result.at(16.0)["clicks"] - result.at(8.0)["clicks"] == 1
    number = re.compile(r"-?\d+\.\d+")
    kept, drawn = PICTURE.read_text(encoding="utf-8"), drawing(result)
    assert number.sub("#", kept) == number.sub("#", drawn), "python -m docs.drawings.ratchet_moving"
    places = ([float(x) for x in number.findall(text)] for text in (kept, drawn))
    assert next(places) == pytest.approx(next(places), abs=0.021)
    wheel = [float(x) for x in re.findall(r'values="([^"]*)"', kept)[0].split(";")]
    assert wheel[0] - wheel[-1] == pytest.approx(18.0, abs=0.05)
