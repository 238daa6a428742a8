"""The page of the gallery shows every mechanism, and its pictures are those that the script draws."""

import re

import pytest
from gallery_examples import GALLERY, model

from docs.drawings.gallery_drawing import PICTURES, svg

NAMES = sorted(path.stem for path in GALLERY.glob("*.py"))
PAGE = (PICTURES.parent / "gallery.md").read_text(encoding="utf-8")

_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def test_every_mechanism_has_a_row_with_its_lines() -> None:
    rows = dict(re.findall(r"\| !\[\]\(gallery/\w+\.svg\) \| \[.*?\]\(examples/gallery/(\w+)\.py\) \| (\d+) \|", PAGE))
    assert sorted(rows) == NAMES
    for name in NAMES:
        text = (GALLERY / f"{name}.py").read_text(encoding="utf-8")
        assert int(rows[name]) == text[text.index("def mechanism") :].count("\n")


@pytest.mark.parametrize("name", NAMES)
def test_its_picture_is_the_one_that_is_drawn(name: str) -> None:
    """Places may differ by rounding, which is another on another processor."""
    kept, drawn = (PICTURES / f"{name}.svg").read_text(encoding="utf-8"), svg(name)
    assert _NUMBER.sub("#", kept) == _NUMBER.sub("#", drawn), "python -m docs.drawings.gallery_drawing"
    places = [[float(number) for number in _NUMBER.findall(text)] for text in (kept, drawn)]
    assert places[0] == pytest.approx(places[1], abs=0.02)
    bars = len(model(name).build(model(name).values()).bodies)
    assert len(kept) < max(12_000, 500 * bars)


def test_there_are_no_other_pictures() -> None:
    assert sorted(path.stem for path in PICTURES.glob("*.svg")) == NAMES
