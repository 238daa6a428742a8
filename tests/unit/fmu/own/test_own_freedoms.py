"""Degrees of freedom that a build reports, against those of kinematic analysis and of the books."""

import math
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from own_file import change
from typer.testing import CliRunner

import build_fmu
import models
from harness.app.cli import main
from mechanism_fmu.fmu.native.objects import library_of
from mechanism_fmu.fmu.own.freedoms import Freedoms, freedoms
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Mechanism,
    Revolute,
    Translational,
    bar,
    four_bar_points,
    polynomial_motion,
    rigid_body,
)
from mechanism_fmu.model.body import Point
from mechanism_fmu.model.joints import Joint


def four_bar(angle: float = 0.7, joints: Callable[[list[Body]], tuple[Joint, ...]] = lambda links: ()) -> Mechanism:
    pins = four_bar_points((0, 0), (0.2, 0), crank=0.05, coupler=0.18, rocker=0.12, angle=angle)
    return linkage(pins, joints)


def parallelogram(angle: float, joints: Callable[[list[Body]], tuple[Joint, ...]]) -> Mechanism:
    x, y = 0.1 * math.cos(angle), 0.1 * math.sin(angle)
    return linkage(((0, 0), (x, y), (0.2 + x, y), (0.2, 0)), joints)


def linkage(pins: Sequence[Point], joints: Callable[[list[Body]], tuple[Joint, ...]]) -> Mechanism:
    """Three links from pin to pin; the first and last pin are fixed."""
    links = [bar(name, a, b, mass=1.0) for name, a, b in zip("abc", pins, pins[1:], strict=False)]
    hinges = (Revolute("p", links[0].a, GROUND.at(*pins[0])), Revolute("q", links[1].a, links[0].b))
    others = (Revolute("r", links[2].a, links[1].b), Revolute("s", links[2].b, GROUND.at(*pins[3])))
    return Mechanism(tuple(links), (*hinges, *others, *joints(links)))


def drive(angle: float) -> Callable[[list[Body]], tuple[Joint, ...]]:
    return lambda links: (AngleDriver("d", links[0], motion=polynomial_motion(angle, 0.0)),)


def of(mechanism: Mechanism) -> Freedoms:
    return freedoms(mechanism, library_of())


def test_a_four_bar_has_one() -> None:
    assert str(of(four_bar())) == "1 degree of freedom (9 coordinates, 8 rows, 0 redundant)"
    assert [*of(four_bar()).remarks()] == []


def test_a_driver_takes_it() -> None:
    assert str(of(four_bar(0.7, drive(0.7)))) == "0 degrees of freedom (9 coordinates, 9 rows, 0 redundant)"


def test_two_slides_of_one_body_repeat_each_other() -> None:
    """Two parallel guides: the second says again that the body keeps its angle and its line."""
    table = rigid_body("table", mass=1.0, inertia=1.0)
    guides = [
        Translational(name, GROUND.line((0, y), (1, 0)), table.line((0, y), (1, 0))) for name, y in (("u", 0), ("v", 1))
    ]
    found = of(Mechanism((table,), tuple(guides)))
    assert str(found) == "1 degree of freedom (3 coordinates, 4 rows, 2 redundant)"
    (said,) = found.remarks()
    assert said.startswith("rows of v follow from those of other joints")


def test_a_parallelogram_in_line_is_singular_not_redundant() -> None:
    """Equal cranks side by side on the line of their hinges: all links in one line, a change point."""
    for angle, singular in ((0.7, False), (0.0, True)):
        for joints in ((lambda links: ()), drive(angle)):
            found = of(parallelogram(angle, joints))
            assert found.redundant == ()
            assert found.singular == singular
            assert [one.split(",")[0] for one in found.remarks()] == ["it starts in a singular position"] * singular


@pytest.mark.parametrize("name", sorted(models.available()))
def test_the_ready_made_models_have_what_is_meant(name: str) -> None:
    found = of(build_fmu.mechanism(name))
    free = found.coordinates - found.rank
    assert free == {"motor": 1, "four_bar": 1, "slider_crank": 1, "four_bar_path_generator": 1}.get(name, free)
    assert found.redundant == ()


def test_the_build_says_them_and_warns_of_joints_that_repeat_others(new_folder: Path) -> None:
    said = CliRunner().invoke(main, ["build", "lever.py", "-o", "out"])
    assert said.stdout.startswith("lever: 1 degree of freedom (3 coordinates, 2 rows, 0 redundant)\n")
    assert said.stderr == ""
    change(new_folder, "joints=(hinge,)", 'joints=(hinge, Revolute("again", lever.a, GROUND))')
    said = CliRunner().invoke(main, ["build", "lever.py", "-o", "out"])
    assert said.stdout.startswith("lever: 1 degree of freedom (3 coordinates, 4 rows, 2 redundant)\n")
    assert "Warning: lever.py: rows of again follow from those of other joints" in " ".join(said.stderr.split())
