"""A user's mechanism that can be built, but of which something is worth saying."""

from pathlib import Path

import pytest
from own_file import built, change, refused


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("    weight = ", "    if values.mass > 1: pass\n    weight = ", "must not branch on a parameter"),
        (
            "/ 12  #",
            "/ 12 * __import__('math').exp(0 * mass)  #",
            "must not branch on a parameter, compare it, or turn it into",
        ),
        ("length * length", "length**2", "must not use **, // or % on a parameter"),
    ],
)
def test_what_cannot_be_traced_is_refused_for_native_and_a_warning_for_pythonfmu(
    old: str, new: str, said: str, folder: Path
) -> None:
    line = change(folder, old, new)
    output = refused("--flavour", "native")
    assert f"lever cannot be traced, lever.py, line {line} " in output
    assert said in output
    output = built()
    said_too = "as it is, it cannot be shown by `page`, nor built with --flavour native."
    assert output.startswith(f"Warning: lever.py: {said_too}")
    assert said in output


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "radians(30)",
            "30",
            "Body 'lever': its start angle is 30 rad, more than a turn. Angles are in radians: if you",
        ),
        ("angle=0.0, rest", "angle=-90, rest", "AngleStop 'stop': its angle is -90 rad, more than a turn."),
        ('"rad", "deg")', '"deg")', "angle has the unit 'deg', but the mechanism calculates in SI units"),
        (
            '"Speed after an impact, as a fraction of the speed before"',
            '"m"',
            "bounce has the description 'm', which looks like a unit",
        ),
    ],
)
def test_what_looks_like_a_mistake_is_a_warning(old: str, new: str, said: str, folder: Path) -> None:
    change(folder, old, new)
    assert f"Warning: lever.py: {said}" in built()
