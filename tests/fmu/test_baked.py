"""FMUs with numbers of their own: they move as the others do that are given the same from outside, in both flavours."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu

import models
from harness.errors import FmuError
from harness.fmu import open_fmu
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.model import MechanismError, compile_mechanism
from mechanism_fmu.model.baked import NOTHING_BAKED, Baked, Seen, baked_model
from mechanism_fmu.tables.layout import field_of, pack

#: Starts of a parameter of each type and of a free input, and a connected input that comes in degrees, turned round.
STARTS = {"drive_stiffness": 5.0, "unilateral": True, "cam_speed_start": 0.5, "drive_damping": 0.2}
SEEN = Seen(-math.pi / 180.0, 0.3, "deg")
BAKED = Baked(STARTS, {"drive_angle": SEEN})
SIGNALS = ("cam_angle", "cam_speed", "follower_angle", "drive_shaft_torque")


@pytest.fixture(scope="module")
def own(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """A function that builds the FMU with numbers of its own, once for each flavour and version."""
    made: dict[str, Path] = {}

    def build(by: Callable[..., Path], **version: int) -> Path:
        key = f"{by.__name__}{version}"
        if key not in made:
            made[key] = by(models.load("cam_drive"), tmp_path_factory.mktemp("own"), baked=BAKED, **version)
        return made[key]

    return build


def moved(path: Path, values: dict[str, float], given: Callable[[float], float]) -> np.ndarray:
    """Outputs at 100 communication points while the shaft's driven end turns, shape (100, signals)."""
    rows = []
    with open_fmu(path) as fmu, fmu.instantiate("cam") as cam:
        cam.set(values)
        cam.initialize(0.0, 1.0)
        for k in range(100):
            cam.set({"drive_angle": given(k / 100.0)})
            cam.step(k / 100.0, 0.01)
            rows.append(cam.get(SIGNALS))
    return np.array(rows)


@pytest.mark.parametrize(("by", "fmi"), [(build_native_fmu, 2), (build_native_fmu, 3), (build_fmu, None)])
def test_it_moves_as_the_one_that_is_given_the_same(
    by, fmi: int | None, own: Callable[..., Path], built: Callable[..., Path]
) -> None:
    version = {} if fmi is None else {"fmi": fmi}
    path = own(by, **version)
    expected = moved(built("cam_drive", by, **version), STARTS, lambda t: 0.3 + 2.0 * t)
    found = moved(path, {}, lambda t: -2.0 * t * 180.0 / np.pi)
    assert np.ptp(expected, axis=0).min() > 1e-3
    assert np.abs(found - expected).max() < 1e-12


@pytest.mark.parametrize("by", [build_native_fmu, build_fmu])
def test_its_description_says_so(by, own: Callable[..., Path], built: Callable[..., Path]) -> None:
    path = own(by)
    assert validate_fmu(str(path)) == []
    plain, mine = (read_model_description(str(p)) for p in (built("cam_drive", by), path))
    assert plain.guid != mine.guid
    before, now = ({v.name: v for v in one.modelVariables} for one in (plain, mine))
    assert [v.valueReference for v in plain.modelVariables] == [v.valueReference for v in mine.modelVariables]
    assert {n: now[n].start for n in STARTS} == {
        "drive_stiffness": "5.0",
        "unilateral": "true",
        "cam_speed_start": "0.5",
        "drive_damping": "0.2",
    }
    angle = now["drive_angle"]
    assert (angle.unit, before["drive_angle"].unit) == ("deg", "rad")
    assert SEEN.factor * float(angle.start) + SEEN.offset == pytest.approx(float(before["drive_angle"].start))
    assert "acts as -0.0174532925199 * value + 0.3 rad" in angle.description


def test_saved_states_are_of_one_build_only(own: Callable[..., Path], built: Callable[..., Path]) -> None:
    """Other numbers, other GUID: a state of the plain FMU is refused."""
    with open_fmu(built("cam_drive", build_native_fmu)) as fmu, fmu.instantiate("plain") as plain:
        plain.initialize(0.0, 1.0)
        state = plain.serialize(plain.save())
    with open_fmu(own(build_native_fmu)) as fmu, fmu.instantiate("mine") as mine:
        mine.initialize(0.0, 1.0)
        with pytest.raises(FmuError, match="state"):
            mine.deserialize(state)


def test_slopes_are_those_of_the_outside(own: Callable[..., Path]) -> None:
    """A ramp in degrees, turned round, is what many short steps with held inputs come to."""
    model = baked_model(models.load("cam_drive").MODEL, BAKED)
    block = pack(compile_mechanism(model.mechanism(model.values())))
    names = [port.name for port in model.mechanism(model.values()).inputs]
    k = names.index("drive_angle")
    assert field_of(block, "input_factor")[k] == pytest.approx(-np.pi / 180.0)
    assert field_of(block, "input_offset")[k] == 0.3
    assert np.delete(field_of(block, "input_factor"), k) == pytest.approx(1.0)
    with open_fmu(own(build_native_fmu)) as fmu, fmu.instantiate("ramp") as ramp, fmu.instantiate("fine") as fine:
        for one in (ramp, fine):
            one.initialize(0.0, 1.0)
        slope = ramp.reals(["drive_angle"])
        slope.values[:] = [10.0]
        slope.write_slopes()
        ramp.step(0.0, 0.1)
        for i in range(1000):  # held at the middle of each short step
            fine.set({"drive_angle": fine_start(fine, i)})
            fine.step(i * 1e-4, 1e-4)
        assert ramp.get(["cam_angle"])[0] == pytest.approx(fine.get(["cam_angle"])[0], rel=1e-6)


def fine_start(instance: object, i: int) -> float:
    """What a ramp of 10 deg/s from the start value, (0 - 0.3 rad) turned round, has come to."""
    return (0.0 - SEEN.offset) / SEEN.factor + 10.0 * (i + 0.5) * 1e-4


@pytest.mark.parametrize(
    ("baked", "said"),
    [
        (Baked({"no_such": 1.0}), "has no parameter or input no_such"),
        (Baked({}, {"cam_angle": Seen()}), "has no parameter or input cam_angle"),
        (Baked({"drive_stiffness": -1.0}), "drive_stiffness"),
        (Baked({}, {"drive_angle": Seen(0.0)}), "the factor of input drive_angle is 0"),
    ],
)
def test_what_cannot_be(baked: Baked, said: str) -> None:
    with pytest.raises(MechanismError, match=said):
        baked_model(models.load("cam_drive").MODEL, baked)


def test_limits_turn_round_with_the_sign() -> None:
    model = models.load("motor").MODEL
    limited = next(port for port in model.mechanism(model.values()).inputs)
    own = baked_model(model, Baked({}, {limited.name: Seen(-2.0, 1.0)}))
    port = next(port for port in own.mechanism(own.values()).inputs if port.name == limited.name)
    for ours, theirs in ((port.minimum, limited.maximum), (port.maximum, limited.minimum)):
        assert (ours is None) is (theirs is None)
        if ours is not None and theirs is not None:
            assert -2.0 * ours + 1.0 == pytest.approx(theirs)


def test_nothing_baked_is_the_model_itself() -> None:
    model = models.load("ratchet").MODEL
    assert baked_model(model, NOTHING_BAKED) is model
