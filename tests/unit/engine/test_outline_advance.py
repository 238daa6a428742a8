"""The bounds of speed with which outlines are looked at hold for every step that the dense output can describe."""

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from numpy.polynomial import Polynomial
from written_step import write

from mechanism_fmu import codes
from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.contacts.handover import left_to_go
from mechanism_fmu.engine.outlines.advance import _SLOPE, fastest
from mechanism_fmu.engine.stepping.looks import place_at
from mechanism_fmu.engine.stepping.meeting import fastest_to_end
from mechanism_fmu.model import Body, CircularCopies, Mechanism, Outline, OutlineContact
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tables.layout import field_of
from mechanism_fmu.tables.method import METHOD
from tests.outlines_apart import Pose, nearest


def multiplied(row: int, t: np.ndarray) -> np.ndarray:
    """What a row of the dense output is multiplied by at parts of the step (`engine.interpolation`)."""
    powers = row - 1
    return t * t ** (powers // 2) * (1.0 - t) ** ((powers + 1) // 2)


@pytest.mark.parametrize("row", range(1, METHOD.dense_rows))
def test_no_row_changes_faster_than_the_bound_says(row: int) -> None:
    t = np.linspace(0.0, 1.0, 20_001)
    slopes = np.abs(np.diff(multiplied(row, t)) / np.diff(t))
    assert slopes.max() <= (1.0 + 1e-9 if row <= 3 else _SLOPE)
    assert slopes.max() > 0.02  # it is a bound of something


def test_the_rows_are_those_of_the_interpolation() -> None:
    """The nested form, written out."""
    chance = np.random.default_rng(1)
    dense = chance.standard_normal(METHOD.dense_rows)
    t = 0.37
    value = dense[-1]
    for row in range(METHOD.dense_rows - 2, -1, -1):
        value = dense[row] + (t if row % 2 == 0 else 1.0 - t) * value
    written = dense[0] + sum(dense[row] * multiplied(row, np.array(t)) for row in range(1, METHOD.dense_rows))
    assert written == pytest.approx(value, rel=1e-13)


#: A stadium with a corner, and a tooth with a hollow root, far from the origins of their bodies.
ONE = Outline(((0.5, -0.1, 0.0), (0.9, -0.1, 1.0), (0.9, 0.1, 0.0), (0.6, 0.2, 0.0)))
OTHER = Outline(((1.3, -0.3, 0.3), (1.4, 0.0, 0.0), (1.2, 0.2, -0.4), (1.1, 0.4, 0.0)), closed=False)
TOUCH = {"outline_i": ONE, "outline_j": OTHER, "points": 1}


def block_of(**more: object) -> np.ndarray:
    """Of two bodies that are far apart at first, and a contact of their outlines."""
    bodies = Body("one", 1.0, 1.0, start=(-50.0, 0.0, 0.0)), Body("other", 1.0, 1.0)
    touch = OutlineContact("touch", *bodies, **TOUCH, **more)
    block: np.ndarray = Simulation(Mechanism(bodies, contacts=(touch,)))._block
    return block


ALONE, IN_A_RING = block_of(), block_of(copies=CircularCopies(3))


@entry
def bound(block: np.ndarray) -> float:
    return fastest(block, place_at(block, 0.0), 0)


@entry
def bound_to_end(block: np.ndarray) -> float:
    return fastest_to_end(block, place_at(block, 0.0), 0)


@entry
def to_go(block: np.ndarray, fraction: float) -> float:
    return left_to_go(block, place_at(block, fraction), 0)[0]


NUMBERS = st.floats(-3.0, 3.0)
#: A polynomial of degree 4 for each coordinate of both bodies; many of little change, which a bound may miss by less.
MOTIONS = st.tuples(
    st.lists(st.lists(NUMBERS, min_size=5, max_size=5), min_size=6, max_size=6), st.sampled_from([1.0, 0.1, 0.01])
)


def written(block: np.ndarray, motions: tuple[list[list[float]], float]) -> dict[int, Polynomial]:
    """The motions that a step has now; later coefficients are smaller by a factor."""
    rows, factor = motions
    made = {k: Polynomial([row[0], *(factor * c for c in row[1:])]) for k, row in enumerate(rows)}
    write(block, made)
    return made


@settings(deadline=None, max_examples=60)
@given(motions=MOTIONS, around=st.booleans())
def test_outlines_do_not_meet_faster_than_the_bound_says(motions: tuple, around: bool) -> None:
    """Their distance, calculated independently, at many times of the step."""
    block = IN_A_RING if around else ALONE
    made = written(block, motions)
    most = bound(block)
    turns = [k * 2.0 * np.pi / 3.0 for k in range(3)] if around else [0.0]
    last = None
    for t in np.linspace(0.0, 1.0, 26):
        x = [made[k](t) for k in range(6)]
        apart = min(nearest(ONE, Pose(*x[:3]), OTHER, Pose(x[3], x[4], x[5] + turn)).distance for turn in turns)
        assert last is None or last - apart <= most / 25 * (1.0 + 1e-9) + 1e-12
        last = apart


@settings(deadline=None, max_examples=200)
@given(
    motions=MOTIONS,
    pair=st.sampled_from([(0, 1), (1, 0), (3, 0), (3, 1), (1, 1), (0, 3), (3, 3), (3, 5), (6, 5), (2, 4)]),
)
def test_a_place_of_contact_comes_to_its_end_no_faster_than_the_bound_says(motions: tuple, pair: tuple) -> None:
    """Of a corner or an arc on a segment, on an arc, or on a corner."""
    field_of(ALONE, "contact_feature_i")[0], field_of(ALONE, "contact_feature_j")[0] = (
        pair[0],
        pair[1] + 8,  # those of the second outline stand behind those of the first
    )
    written(ALONE, motions)
    most = bound_to_end(ALONE)
    values = [to_go(ALONE, t) for t in np.linspace(0.0, 1.0, 101)]
    field_of(ALONE, "contact_feature_i")[0] = field_of(ALONE, "contact_feature_j")[0] = codes.NONE
    assume(np.isfinite(most))
    finite = np.isfinite(values)
    assert np.all(np.abs(np.diff(values))[finite[1:] & finite[:-1]] <= most / 100 * (1.0 + 1e-9) + 1e-12)
