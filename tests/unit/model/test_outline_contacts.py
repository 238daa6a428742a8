"""Contacts of outlines: the places they make of themselves, what their tables hold, and what is refused."""

import math
from dataclasses import replace
from types import SimpleNamespace

import pytest

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    Body,
    CircularCopies,
    LinearCopies,
    Mechanism,
    MechanismError,
    Model,
    Outline,
    OutlineContact,
    Output,
    Parameter,
    compile_mechanism,
)
from mechanism_fmu.model.symbol import Recorder
from mechanism_fmu.model.trace import trace
from mechanism_fmu.simulation import Simulation, SimulationError

BODY = Body("body", 1.0, 0.01, start=(0.0, 1.0, 0.0))
SQUARE = Outline.polygon([(0.1, 0.1), (-0.1, 0.1), (-0.1, -0.1), (0.1, -0.1)])
FLOOR = Outline.chain([(1.0, 0.0), (-1.0, 0.0)])


def contact(**changes: object) -> OutlineContact:
    return OutlineContact("c", BODY, GROUND, **({"outline_i": SQUARE, "outline_j": FLOOR} | changes))


def mechanism(**changes: object) -> Mechanism:
    return Mechanism((BODY,), contacts=(contact(**changes),), gravity=(0.0, -9.81))


def test_a_mechanism_has_a_contact_for_each_place_and_one_more() -> None:
    made = mechanism(points=3)
    names = [one.name for one in made.contacts]
    assert names == ["c", "c_2", "c_3", "c_4"]
    assert [one.name for one in replace(made, gravity=None).contacts] == names
    assert list(compile_mechanism(made).contact_group) == [0, 0, 0, 0]


def test_an_outline_is_a_chain_of_vertices_and_elements() -> None:
    rounded = Outline.polygon([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], corner_radius=(0.0, 0.1, 0.0))
    tables = compile_mechanism(mechanism(outline_i=rounded))
    assert list(tables.outline_count) == [8, 3]
    assert list(tables.outline_closed) == [1, 0]
    v, s, a = codes.VERTEX, codes.SEGMENT, codes.ARC
    assert list(tables.feature_kind) == [v, s, v, a, v, s, v, s, v, s, v]
    arc = tables.feature_data[3]
    assert arc[codes.FEATURE_RADIUS] == pytest.approx(0.1, rel=1e-14)
    assert arc[codes.FEATURE_HALF] == pytest.approx(math.radians(135.0) / 2, rel=1e-14)
    assert tables.feature_data[0, codes.FEATURE_TURN] == 1.0
    assert abs(tables.feature_data[2, codes.FEATURE_TURN]) < 1e-12  # smooth
    assert list(tables.feature_data[[8, 10], codes.FEATURE_TURN]) == [codes.FREE_END] * 2


def test_an_outline_that_several_contacts_share_stands_once() -> None:
    two = (contact(), replace(contact(), name="d"))
    tables = compile_mechanism(Mechanism((BODY,), contacts=two))
    assert len(tables.outline_count) == 2
    assert list(tables.contact_outline_i) == [0] * 6


def test_copies_have_a_pitch() -> None:
    assert CircularCopies(4).data() == (math.pi / 2, 0.0, 0.0)
    assert LinearCopies(("5 mm", 0.0)).data() == (0.0, 0.005, 0.0)


def test_copies_of_an_open_outline_may_follow_from_parameters() -> None:
    """Whether the ends of copies join is asked of symbols, too: a model of them has a native FMU."""

    def made(values: SimpleNamespace) -> Mechanism:
        step = Outline.chain([(values.step, 0.0), (0.5 * values.step, values.height), (0.0, 0.0)])
        return mechanism(outline_j=step, copies=LinearCopies((values.step, 0.0)))

    parameters = Parameter("step", 0.2, "", minimum=0.1, maximum=1.0), Parameter("height", 0.05, "", maximum=0.1)
    model = Model("Steps", "", parameters, made, drawing=())
    values = model.values(step=0.3)
    found, wanted = trace(model).evaluate(values), compile_mechanism(model.build(values))
    assert found.columns["feature_data"].tobytes() == wanted.feature_data.tobytes()


def test_an_outline_is_given_where_its_body_is_drawn() -> None:
    drawn = replace(BODY, centre=(0.3, 0.2))
    made = OutlineContact("c", drawn, GROUND, outline_i=SQUARE, outline_j=FLOOR)
    assert made.outline_i.points == SQUARE.moved(-0.3, -0.2).points
    assert made.outline_j is FLOOR


BAD = {
    "restitution": (lambda: contact(restitution=1.5), "restitution = 1.5 is outside 0..1"),
    "friction": (lambda: contact(friction=-0.1), "friction = -0.1 must be finite and not negative"),
    "static friction": (lambda: contact(friction=0.3, friction_static=0.2), "friction_static = 0.2 is less"),
    "short": (
        lambda: contact(outline_j=Outline.chain([(1.0, 0.0), (1.0, 1e-10), (2.0, 1.0)])),
        "outline_j: element 0 is 1e-10 m long",
    ),
    "the wrong way": (
        lambda: contact(outline_i=Outline(SQUARE.vertices[::-1])),
        "outline_i encloses -0.04 m2: it runs the wrong way round; give its points counter-clockwise",
    ),
    "no number": (lambda: contact(outline_i=Outline.circle(math.nan)), "must be longer than"),
    "points": (lambda: contact(points=0), "points = 0 is outside 1..20"),
    "no copies": (lambda: contact(copies=CircularCopies(0)), "count = 0, but it must be at least 1"),
    "copies in one place": (lambda: contact(copies=LinearCopies((0.0, 0.0))), "its copies are 0 m apart"),
    "no copies in a row": (lambda: contact(copies=LinearCopies((1.0, 0.0), 0)), "count = 0, but it must be"),
}


@pytest.mark.parametrize(("make", "message"), BAD.values(), ids=BAD)
def test_what_cannot_be_is_refused(make, message) -> None:
    with pytest.raises(MechanismError, match="(?s).*" + message.replace("(", r"\(").replace(".", r"\.")):
        compile_mechanism(Mechanism((BODY,), contacts=(make(),)))


def test_what_starts_inside_is_named_with_its_depth() -> None:
    low = replace(BODY, start=(0.0, 0.09, 0.0))
    contacts = (OutlineContact("c", low, GROUND, outline_i=SQUARE, outline_j=Outline.circle(1.0, (0.0, -1.0))),)
    with pytest.raises(MechanismError, match=r"Contact 'c': 'body' reaches 0\.01 m into 'ground'"):
        Simulation(Mechanism((low,), contacts=contacts))


def test_more_places_than_points_are_an_error_that_says_so() -> None:
    comb = Outline.polygon([(0.3, 0.1), (-0.3, 0.1), *((x, -0.1 + h) for x, h in TEETH), (0.3, 0.0)])
    simulation = Simulation(mechanism(outline_i=comb, points=2))
    with pytest.raises(SimulationError, match="touch at more places at once than their OutlineContact has points"):
        simulation.advance(1.0)
    simulation = Simulation(replace(mechanism(outline_i=comb), outputs=(Output("y", "body.y", ""),)))
    simulation.advance(1.0)
    assert simulation.read()["y"] == pytest.approx(0.1, abs=1e-12)
    assert simulation.mode() == ("c", "c_2", "c_3")


#: Three teeth of a comb, from left to right: x, and how high above the floor of the comb.
TEETH = [(-0.3, 0.1), (-0.25, 0.0), (-0.1, 0.1), (0.0, 0.0), (0.1, 0.1), (0.25, 0.0)]


COMB = Outline.polygon([(0.3, 0.1), (-0.3, 0.1), *((x, -0.1 + h) for x, h in TEETH), (0.3, 0.0)])
TRENCH = Outline.chain([(5.0, 0.2), (0.1, 0.2), (0.1, 0.0), (-0.1, 0.0), (-0.1, 0.2), (-5.0, 0.2)])
NOTCH = Outline.polygon([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (0.0, 0.0), (-1.0, 1.0)])
RING = Outline.chain([(0.0, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1), (-0.1, -0.1), (0.0, -0.1)])

#: Outlines, and at how many places they can touch at once.
PLACES = {
    "two squares": (SQUARE, SQUARE, None, 2),
    "a square on a floor": (SQUARE, Outline.chain([(5.0, 0.0), (-5.0, 0.0)]), None, 2),
    "a square in a trench as wide: both ends of three sides": (SQUARE, TRENCH, None, 6),
    "a disc in a trench": (Outline.circle(0.1), TRENCH, None, 3),
    "a square in a notch": (SQUARE, NOTCH, None, 4),
    "a square under the two ends of a chain": (SQUARE, RING, None, 4),
    "a disc in a bore": (Outline.circle(0.1), Outline.circle(0.2, hole=True), None, 2),
    "a square on four teeth": (
        SQUARE,
        Outline.chain([(0.1, 0.0), (0.05, 0.1), (0.0, 0.0)]),
        LinearCopies((0.1, 0.0)),
        8,
    ),
    "a comb on a floor": (COMB, FLOOR, None, 6),
    "two combs": (COMB, COMB, None, 12),
}


@pytest.mark.parametrize(("one", "other", "copies", "count"), PLACES.values(), ids=PLACES)
def test_shapes_say_at_how_many_places_they_can_touch(one, other, copies, count) -> None:
    places = contact(outline_i=one, outline_j=other, copies=copies).places
    assert len(places) == count + 1  # and one that stands for what comes next
    bounded = contact(outline_i=one, outline_j=other, copies=copies, points=1).places
    assert [place.name for place in bounded] == ["c", "c_2"]


def test_places_of_symbols_are_those_of_the_values_at_which_parameters_start() -> None:
    recorder = Recorder()
    depth = recorder.parameter(0, start=0.5) * 2.0
    notch = Outline.polygon([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (0.0, 1.0 - depth), (-1.0, 1.0)])
    assert len(contact(outline_j=notch).places) == 5
    shallow = Outline.polygon([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (0.0, 1.0 + depth), (-1.0, 1.0)])
    assert len(contact(outline_j=shallow).places) == 3
