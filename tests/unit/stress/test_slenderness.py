import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.stress import (
    RectangularTooth,
    SectionBeam,
    TrapezoidTooth,
    WedgeTooth,
    beam_theory_note,
    slenderness,
    wedge_of_sawtooth,
)


@given(length=st.floats(1e-3, 1.0), height=st.floats(1e-3, 1.0), tip=st.floats(0.0, 1.0))
def test_length_over_root_height(length, height, tip):
    assert slenderness(RectangularTooth(length, height)) == pytest.approx(length / height, rel=1e-12)
    assert slenderness(TrapezoidTooth(length, height, tip)) == pytest.approx(length / height, rel=1e-12)


@given(length=st.floats(1e-3, 1.0), apex_angle=st.floats(0.01, 1.5))
def test_of_a_wedge_it_is_the_cotangent_of_the_apex_angle(length, apex_angle):
    assert slenderness(WedgeTooth(length, apex_angle)) == pytest.approx(1 / math.tan(apex_angle), rel=1e-12)


def test_the_paper_s_tooth_is_outside_beam_theory():
    chord = 0.2 * math.sin(math.pi / 10)
    tooth = wedge_of_sawtooth(chord, slope_length=1.115 * chord, chord_angle=math.pi / 10)
    assert slenderness(tooth) == pytest.approx(0.53, abs=0.005)
    note = beam_theory_note(tooth)
    assert note.startswith("Length over root height is 0.531, outside beam theory (5 or more)")
    assert note.endswith("real tooth.")


def test_a_slender_beam_is_within_it():
    assert beam_theory_note(RectangularTooth(0.05, 0.004)) == (
        "Length over root height is 12.5, within beam theory (5 or more)."
    )
    assert "within" in beam_theory_note(RectangularTooth(5.0, 1.0))
    assert "outside" in beam_theory_note(RectangularTooth(4.99, 1.0))


def test_a_beam_without_height_at_its_root_is_refused():
    beam = SectionBeam(0.1, area=lambda x: x, second_moment=lambda x: x**3, outer_fibre=lambda x: np.asarray(x) / 2)
    with pytest.raises(ValueError, match=r"^the beam is 0 m high at its root.*turn it round"):
        slenderness(beam)
