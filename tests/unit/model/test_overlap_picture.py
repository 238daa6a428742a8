"""The picture of two bodies that have gone into each other: what it shows, and that its overlap is as deep as it is."""

import math
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    CircularCopies,
    ClearanceJoint,
    Mechanism,
    MechanismError,
    Outline,
    OutlineContact,
    PointLineContact,
    deg,
    ratchet_tooth,
    rigid_body,
)
from mechanism_fmu.model.errors import picture_of
from mechanism_fmu.simulation import Simulation, SimulationError

#: Half the size of a panel, by how many depths it reaches, and rounding [px].
HALF, DEPTHS, ROUNDING = 160.0, 5.0, 0.02
SVG = "{http://www.w3.org/2000/svg}"


def picture_at_the_start(body, contact) -> ElementTree.Element:
    bodies = body if isinstance(body, tuple) else (body,)
    with pytest.raises(MechanismError) as caught:
        Simulation(Mechanism(bodies, contacts=(contact,)))
    return ElementTree.fromstring(caught.value.picture)


def panels(picture: ElementTree.Element) -> list[ElementTree.Element]:
    return picture.findall(f"{SVG}svg")


def red_line(panel: ElementTree.Element) -> tuple[float, float, float, float]:
    (line,) = panel.findall(f"{SVG}line[@class='overlap']")
    x, y, u, v = (float(line.attrib[name]) for name in ("x1", "y1", "x2", "y2"))
    return x, y, u, v


def points(shape: ElementTree.Element) -> list[tuple[float, float]]:
    pairs = (pair.split(",") for pair in shape.attrib["points"].split())
    return [(float(x), float(y)) for x, y in pairs]


BLOCK = Outline.polygon(((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)), 0.02)
FLOOR = Outline.polygon(((-1.0, -0.3), (1.0, -0.3), (1.0, 0.0), (-1.0, 0.0)))
#: How high the middle of a block is that stands on a rounding, turned by 0.2 rad.
STANDS = 0.08 * (math.cos(0.2) + math.sin(0.2)) + 0.02


@pytest.mark.parametrize("depth", [4e-3, 1e-5, 5e-9])
def test_a_rounding_in_a_floor_is_as_deep_as_it_is(depth):
    """The magnified panel reaches five depths to either side: a nanometre of overlap is seen as a millimetre is."""
    block = rigid_body("block", (0.0, STANDS - depth), mass=1.0, inertia=1e-2, angle=0.2)
    picture = picture_at_the_start(block, OutlineContact("floor", block, GROUND, outline_i=BLOCK, outline_j=FLOOR))
    whole, magnified = panels(picture)
    x, y, u, v = red_line(magnified)
    assert (x, y) == pytest.approx((HALF, HALF), abs=ROUNDING)
    assert (u, v) == pytest.approx((HALF, HALF - HALF / DEPTHS), abs=1e-5 / depth * ROUNDING if depth < 1e-6 else 0.02)
    own, floor = (points(shape) for shape in magnified.findall(f"{SVG}polygon"))
    assert max(down for _, down in own) == pytest.approx(HALF, abs=0.1)  # its lowest point
    assert min(down for _, down in floor) == pytest.approx(HALF - HALF / DEPTHS, abs=0.1)
    assert len(whole.findall(f"{SVG}polygon")) == 2
    assert "'block' reaches" in "".join(picture.itertext())


def test_a_pin_in_the_wall_of_its_hole():
    pin = rigid_body("pin", (0.0, -2e-3), mass=1.0, inertia=1.0)
    joint = ClearanceJoint("play", pin, GROUND.at(0.0, 0.0), pin_radius=0.01, hole_radius=0.011)
    magnified = panels(picture_at_the_start(pin, joint))[1]
    assert red_line(magnified) == pytest.approx((HALF, HALF, HALF, HALF - HALF / DEPTHS), abs=ROUNDING)


def test_a_tooth_of_a_wheel():
    wheel = rigid_body("wheel", (0.0, 0.0), mass=1.0, inertia=1.0, angle=deg(90))
    pin = rigid_body("pin", (0.0, 0.095), mass=1.0, inertia=1.0)
    tooth = OutlineContact(
        "tooth",
        pin,
        wheel,
        outline_i=Outline.circle(0.01),
        outline_j=ratchet_tooth(10, deg(90), 0.1, 1.115, tip_radius="1 mm"),
        copies=CircularCopies(10),
    )
    picture = picture_at_the_start((wheel, pin), tooth)
    assert len(panels(picture)[0].findall(f"{SVG}polygon")) == 2  # all teeth are one chain


def test_a_point_behind_a_line():
    bead = rigid_body("bead", (0.2, -0.03), mass=1.0, inertia=1.0)
    picture = picture_at_the_start(bead, PointLineContact("floor", bead, GROUND.line((0.0, 0.0), (1.0, 0.0))))
    magnified = panels(picture)[1]
    assert red_line(magnified) == pytest.approx((HALF, HALF, HALF, HALF - HALF / DEPTHS), abs=ROUNDING)
    (floor,) = (points(shape) for shape in magnified.findall(f"{SVG}polygon"))
    assert min(down for _, down in floor) == pytest.approx(HALF - HALF / DEPTHS, abs=ROUNDING)


def test_a_stop_of_angles_is_two_hands():
    arm = rigid_body("arm", (0.2, 0.0), mass=1.0, inertia=1.0, angle=-0.5)
    (panel,) = panels(picture_at_the_start(arm, AngleStop("stop", arm, GROUND, angle=0.2)))
    angles = []
    for hand in panel.findall(f"{SVG}polyline"):
        (x, y), (u, v) = points(hand)
        angles.append(math.atan2(y - v, u - x))
    assert angles == pytest.approx([-0.5, 0.2], abs=1e-3)


def test_a_motion_that_ends_inside_has_its_picture():
    bead = rigid_body("bead", (0.0, 0.5), mass=1.0, inertia=1.0)
    floor = PointLineContact("floor", bead, GROUND.line((0.0, 0.0), (1.0, 0.0)))
    simulation = Simulation(Mechanism((bead,), contacts=(floor,)))
    simulation.advance(0.25)
    simulation.field("y_end")[1] = -0.125
    simulation.field("clock")[[2, 0]] = simulation.time
    with pytest.raises(SimulationError) as caught:
        simulation.advance(1.0)
    text = "".join(ElementTree.fromstring(caught.value.picture).itertext())
    assert "floor: bead in ground, t = 0.25 s" in text
    assert "the point of 'bead' is 0.125 m behind the line on 'ground'" in text


def test_other_errors_have_none():
    assert picture_of(MechanismError("of something else")) == ""
    assert picture_of(None) == ""


MODEL = """\
from mechanism_fmu.model import GROUND, Mechanism, Model, PointLineContact, rigid_body


def bead(p):
    body = rigid_body("bead", (0.0, -0.1), mass=1.0, inertia=1.0)
    floor = PointLineContact("floor", body, GROUND.line((0.0, 0.0), (1.0, 0.0)))
    return Mechanism(bodies=(body,), contacts=(floor,))


MODEL = Model("Bead", "A bead below a floor", (), bead)
"""


@pytest.mark.parametrize("command", [["check"], ["build", "-o", "out"]], ids=["check", "build"])
def test_the_command_writes_it_into_the_folder_where_it_is(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("bead.py").write_text(MODEL, encoding="utf-8")
    result = CliRunner().invoke(main, [command[0], "bead.py", *command[1:]])
    assert result.exit_code == 1, result.output
    assert "the point of 'bead' is 0.1 m behind the line on 'ground'" in re.sub(r"\s+", " ", result.output)
    assert "The bodies are drawn in bead_overlap.svg." in result.output
    ElementTree.fromstring(Path("bead_overlap.svg").read_text(encoding="utf-8"))
