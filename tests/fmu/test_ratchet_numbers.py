"""The paper's cases through the FMU, against the reference table of two independent implementations."""

import math

import pytest

#: beta_0 [deg]: t_I, then crank, pawl and wheel speed before and after, with the digits that the table has.
TABLE = {
    85: (0.9573080523, 0.566692226, -0.270715394, -0.000681458, 0.0192038168, -0.0069272732, 0.0228046146),
    90: (0.9399211769, 0.574072849, -0.207085356, -0.000779456, 0.0191482997, -0.0069073680, 0.0227388573),
    95: (0.9277144372, 0.579788752, -0.146091124, -0.000774514, 0.0191307988, -0.0069008794, 0.0227178290),
    100: (0.9194210908, 0.584076449, -0.087110987, -0.000672731, 0.0191521427, -0.0069081155, 0.0227425265),
    105: (0.9143304857, 0.587100938, -0.029561498, -0.000475511, 0.0192147646, -0.0069299405, 0.0228158202),
}
NAMES = (
    "impact_time",
    "impact_crank_speed_before",
    "impact_pawl_speed_before",
    "impact_wheel_speed_before",
    "impact_crank_speed",
    "impact_pawl_speed",
    "impact_wheel_speed",
)
#: Half a unit of the last digit of each column.
ROUNDING = (5.1e-11, 5.1e-10, 5.1e-10, 5.1e-10, 5.1e-11, 5.1e-11, 5.1e-11)


@pytest.mark.parametrize("tooth_count", [10, 25])
@pytest.mark.parametrize("slope_angle", TABLE)
def test_impact_of_the_table(instance, slope_angle, tooth_count):
    one = instance().begin({"tooth_slope_angle": math.radians(slope_angle), "tooth_count": tooth_count})
    one.run(1.0, 1e-2)

    found = one.get(NAMES)
    for name, expected, rounding in zip(NAMES, TABLE[slope_angle], ROUNDING, strict=True):
        assert found[name] == pytest.approx(expected, rel=1e-7, abs=rounding), name


@pytest.mark.parametrize("slope_angle", TABLE)
def test_default_tolerance_agrees_with_the_tightest(instance, slope_angle):
    found = []
    for tolerance in (1e-9, 1e-12, 1e-13):
        one = instance().begin({"tooth_slope_angle": math.radians(slope_angle), "relative_tolerance": tolerance})
        one.run(1.0, 1e-2)
        found.append([one[name] for name in NAMES])

    default, tight, tightest = found
    assert default == pytest.approx(tightest, rel=1e-7)
    assert tight == pytest.approx(tightest, rel=1e-10)


def test_impulses_and_energies_of_the_base_case(instance):
    one = instance().begin()
    one.run(0.9399, 1e-2)
    before = one["kinetic_energy"] + one["spring_energy"] - one["work_done"]
    one.step(1e-4)

    assert one["impact_impulse"] == pytest.approx(7.7895902699e-3, rel=1e-9)
    assert one["impact_slope_impulse"] == pytest.approx(1.1321724809e-3, rel=1e-9)
    assert one["energy_lost"] == pytest.approx(2.71981107e-4 - 8.78293469e-6, rel=1e-7)
    assert abs(before) < 1e-15
    jump = one["impact_wheel_speed"] - one["impact_wheel_speed_before"]
    assert jump == pytest.approx(0.0227388573 + 0.000779456, abs=6e-10)
    assert one["impact_velocity"] == pytest.approx(jump * one["tooth_length"], rel=1e-14)
    assert one["impacts[1].velocity"] == one["impact_velocity"]
    assert one["impacts[1].wheel_speed_before"] == one["impact_wheel_speed_before"]
    assert one["impacts[1].instant"] == 1
    assert one["impact_energy_lost"] == pytest.approx(one["energy_lost"], rel=1e-12)


def test_restitution_of_one_half(instance):
    one = instance().begin({"restitution": 0.5})
    one.run(0.94, 1e-2)

    assert one["impact_crank_speed"] == pytest.approx(-0.258313975, rel=2e-9)
    assert one["impact_wheel_speed"] == pytest.approx(0.0344980141, rel=2e-9)
    assert one["impact_impulse"] == pytest.approx(0.0116843854, rel=3e-9)


def test_elastic_impact_loses_nothing(instance):
    one = instance().begin({"restitution": 1})
    one.run(0.94, 1e-2)

    assert one["impact_count"] == 1
    assert abs(one["energy_lost"]) < 1e-10 * one["kinetic_energy"]


def test_swing_after_the_impact(instance):
    one = instance().begin()
    angles, stop = [], None
    one.run(1.0, 1e-2)
    while one.time < 12.0:
        before = one["wheel_speed"]
        one.step(1e-3)
        angles.append(one["wheel_angle"])
        if stop is None and before > 0 >= one["wheel_speed"]:
            stop = one.time

    assert stop == pytest.approx(4.9066, abs=1e-3)
    assert math.degrees(max(angles)) == pytest.approx(82.1675, abs=1e-4)


def test_host_tolerance_tightens_and_never_loosens(instance):
    runs = {}
    for name, parameter, host in (("plain", 1e-9, None), ("loose host", 1e-9, 1e-4), ("tight host", 1e-6, 1e-9)):
        one = instance().begin({"relative_tolerance": parameter}, tolerance=host)
        one.run(1.0, 0.1)
        runs[name] = one["impact_time"]

    assert runs["loose host"] == runs["plain"]
    assert runs["tight host"] == runs["plain"]
