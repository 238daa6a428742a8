"""Outlines against an oracle: cases computed elsewhere, in two ways each, in tests/data/shapes.json.

The variable SHAPES_ORACLE names another file with the same kinds of cases and other numbers.
"""

import json
import os
from pathlib import Path
from typing import Any

import pytest

from mechanism_fmu.model import Outline
from tests.outlines_apart import Pose, nearest

_FILE = Path(os.environ.get("SHAPES_ORACLE") or Path(__file__).parents[1] / "data" / "shapes.json")
CASES: list[dict[str, Any]] = json.loads(_FILE.read_text(encoding="utf-8"))["cases"]


def of_kind(kind: str) -> list[Any]:
    return [pytest.param(case, id=case["case"]) for case in CASES if case["kind"] == kind]


@pytest.mark.parametrize("case", of_kind("gap_pairs"))
def test_gap_pairs(case: dict[str, Any]) -> None:
    """The distance that tests measure with is right itself: so is the geometry of elements that it takes."""
    for result in case["results"]:
        a, b = (Outline(tuple(map(tuple, result[f"outline_{which}"]))) for which in "ab")
        found = nearest(a, Pose(*result["pose_a"]), b, Pose(*result["pose_b"]))
        assert found.distance == pytest.approx(result["distance"], abs=case["tolerance"])
        for point, which, element, outline in zip(found.points, "ab", found.elements, (a, b), strict=True):
            assert abs(point - complex(*result[f"point_{which}"])) < 1e-9
            count = len(outline.elements)
            assert (element - result[f"element_{which}"]) % count in (0, 1, count - 1)
