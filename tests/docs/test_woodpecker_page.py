"""docs/explanation/woodpecker.md: its numbers are the program's, its picture is the script's, its links hold."""

import re
import runpy

import numpy as np
import pytest
from pages import JOINTS

from docs.drawings.woodpecker_drawing import PICTURE, PROGRAM, drawing

PAGE = JOINTS.parent / "explanation" / "woodpecker.md"
TEXT = PAGE.read_text(encoding="utf-8")
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]\d+)?")


@pytest.mark.slow
def test_its_numbers_are_those_of_the_program(capsys: pytest.CaptureFixture) -> None:
    """But for rounding, which is another on another processor; residuals are rounding."""
    runpy.run_path(str(PROGRAM), run_name="__main__")
    printed = capsys.readouterr().out.replace("\n\nnewton", "\nnewton", 1)
    kept = "\n".join(part.strip() for part in re.findall(r"<!-- \w+ -->\n(.*?)<!-- end -->", TEXT, re.DOTALL))
    texts = [[line.rstrip() for line in text.splitlines() if line.strip()] for text in (kept, printed)]
    assert len(texts[0]) == len(texts[1]) > 40
    for stated, found in zip(*texts, strict=True):
        assert _NUMBER.sub("#", stated).replace(" ", "") == _NUMBER.sub("#", found).replace(" ", "")
        numbers = [[float(number) for number in _NUMBER.findall(text)] for text in (stated, found)]
        if stated.startswith("| "):
            assert all(row[4] < 1e-9 for row in numbers if row)
            numbers = [row[:4] + row[5:] for row in numbers]
        np.testing.assert_allclose(*numbers, rtol=1e-6, atol=2e-8)


def test_its_picture_is_that_of_its_script() -> None:
    number = re.compile(r"-?\d+\.\d+")
    kept, drawn = PICTURE.read_text(encoding="utf-8"), drawing()
    assert number.sub("#", kept) == number.sub("#", drawn), "python -m docs.drawings.woodpecker_drawing"
    places = ([float(x) for x in number.findall(text)] for text in (kept, drawn))
    np.testing.assert_allclose(*places, rtol=0, atol=0.021)


def test_what_it_links_to_is_there() -> None:
    targets = re.findall(r"\]\(([^)#]+)", TEXT)
    assert len(targets) > 3
    assert not [target for target in targets if not (PAGE.parent / target).exists()]
