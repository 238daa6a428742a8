import math

import numpy as np
import pytest

from mechanism_fmu.elastodynamics.gear_tooth import GearTooth
from tests.plane_tooth import PlaneTooth

E, NU = 2.0, 0.3


def plate_end(height, end):
    """Flexibility of the end section, 3 x 3, of a plate with a root 1 thick."""
    plate = PlaneTooth(height, 1.0, end, E, NU, np.linspace(0, height, 17), np.linspace(-1, 1, 7))
    tractions = [
        lambda x, y: (1 / end + 0 * y, 0 * y),
        lambda x, y: (0 * y, 1.5 / end * (1 - (2 * y / end) ** 2)),
        lambda x, y: (-12 * y / end**3, 0 * y),
    ]
    forces = [plate.forces("end", traction) for traction in tractions]
    return np.array([[f @ u for f in forces] for u in map(plate.displacements, forces)])


def plate_flank(height, end, half_contact, angle):
    """How far the contact moves along the force, in a plate whose tip is 0.3 above it."""
    length, a = height + 0.3, half_contact
    near = [np.linspace(height + i * a, height + j * a, n) for i, j, n in ((-4, -1, 6), (-1, 1, 13), (1, 4, 6))]
    x = np.unique(np.concatenate([np.linspace(0, height - 4 * a, 9), *near, np.linspace(height + 4 * a, length, 4)]))
    eta = np.unique(np.concatenate([np.linspace(-1, 0, 5), 1 - np.geomspace(1, 0.5 * a / end, 12), [1.0]]))
    plate = PlaneTooth(length, 1.0, 1.0 + (end - 1.0) * length / height, E, NU, x, eta)

    def hertz(x, y):
        # Per length of flank, which is longer than its projection.
        pressure = 2 / (math.pi * a) * np.sqrt(np.maximum(1 - ((x - height) / a) ** 2, 0.0)) * math.cos(angle)
        return -pressure * math.sin(angle), -pressure * math.cos(angle)

    moved = plate.at(plate.displacements(plate.forces("flank", hertz)), height, 0.5 * end)
    return -moved @ [math.sin(angle), math.cos(angle)]


@pytest.mark.parametrize("end", [1.0, 0.75, 0.5])
@pytest.mark.parametrize("height", [0.75, 1.0, 3.0])
def test_bending_and_shear_are_those_of_a_plate(height, end):
    expected, found = plate_end(height, end), GearTooth(height, 1.0, end, 1.0, E, NU).flexibility()
    # The clamped root of the plate cannot warp: the plate is stiffer than the beam, the more so the stubbier it is.
    assert 0.0 < found[1, 1] / expected[1, 1] - 1 < 0.04 / height**0.5
    assert 0.0 < found[1, 2] / expected[1, 2] - 1 < 0.055 / height
    assert 0.0 < found[2, 2] / expected[2, 2] - 1 < 0.04 / height
    # Along a tapered tooth the lines of force spread, which the beam does not know.
    assert abs(found[0, 0] / expected[0, 0] - 1) < 0.05 / height
    assert abs(expected[0, 1]) < 1e-9 * expected[0, 0]


def test_without_the_taper_in_it_the_shear_would_be_too_much():
    tooth = GearTooth(1.0, 1.0, 0.5, 1.0, E, NU)
    h = 1.0 - 0.5 * np.linspace(0, 1, 20001)
    uniform = 1.2 * np.trapezoid(1 / h, dx=1 / 20000) / (E / (2 * (1 + NU)))
    straight = GearTooth(1.0, 1.0, 1.0, 1.0, E, NU).flexibility()[1, 1]
    assert straight == pytest.approx(4 / E + 1.2 * 2 * (1 + NU) / E, rel=1e-12)
    bending = 12 / E * np.trapezoid(np.linspace(1, 0, 20001) ** 2 / h**3, dx=1 / 20000)
    assert 0.05 < (bending + uniform) / tooth.flexibility()[1, 1] - 1 < 0.06


@pytest.mark.parametrize(("height", "end", "half_contact"), [(0.75, 0.6, 0.04), (1.2, 0.5, 0.02), (2.0, 0.6, 0.06)])
def test_contact_on_a_flank_gives_way_as_that_of_a_plate(height, end, half_contact):
    angle = math.atan((1.0 - end) / (2 * height))
    tooth = GearTooth(height, 1.0, end, 1.0, E, NU)
    expected = plate_flank(height, end, half_contact, angle)
    assert 0.0 < tooth.along_normal(angle, half_contact) / expected - 1 < 0.1
    # Without compression it would be far off for a stubby tooth.
    assert tooth.along_normal(angle, half_contact) - tooth.compression(half_contact) < expected


def test_compression_is_the_change_of_distance_under_hertz_pressure():
    # Between a = 0.02 and 0.01 the plate under the flank gives way by the logarithm alone.
    tooth = GearTooth(1.0, 1.0, 1.0, 1.0, E, NU)
    more = plate_flank(1.0, 1.0, 0.02, 0.0) - plate_flank(1.0, 1.0, 0.04, 0.0)
    assert tooth.compression(0.02) - tooth.compression(0.04) == pytest.approx(
        2 * math.log(2) / (math.pi * E), rel=1e-12
    )
    assert more == pytest.approx(2 * math.log(2) / (math.pi * E), rel=0.02)


def test_steel_gear_gives_way_by_micrometres():
    # Module 5 mm, 20 mm wide. ISO 6336-1 has 14 N/(mm um) for a pair of real teeth, bodies and all.
    tooth = GearTooth(0.006, 0.0105, 0.0075, 0.02, 210e9, 0.3)
    stiffness = 1 / tooth.along_normal(math.radians(20), 5e-5) / 0.02 * 1e-9
    assert 14 < stiffness / 2 < 25


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"height": 0.0}, "the height of the tooth is 0"),
        ({"young": math.nan}, "the young of the tooth is nan"),
        ({"poisson": 1.2}, "Poisson's ratio of the tooth is 1.2"),
    ],
)
def test_a_tooth_that_cannot_be_is_refused(change, message):
    right = {
        "height": 0.006,
        "root_thickness": 0.01,
        "contact_thickness": 0.007,
        "face_width": 0.02,
        "young": 210e9,
        "poisson": 0.3,
    }
    GearTooth(**right)
    with pytest.raises(ValueError, match=message):
        GearTooth(**right | change)


@pytest.mark.parametrize("half_contact", [0.0, 0.2, math.nan])
def test_a_contact_that_is_none_is_refused(half_contact):
    with pytest.raises(ValueError, match="half width of the contact"):
        GearTooth(1.0, 1.0, 0.7, 1.0, E, NU).compression(half_contact)
