"""Components for Model Exchange: foreign ones of the kinds of the Reference FMUs, and those of this project."""

import math
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from harness.app.commands.machine_ready import prepared
from harness.errors import FmuError, UsageError
from harness.fmu import open_fmu
from harness.fmu.instances.common import FmuSlave
from harness.fmu.instances.integration import Integrator
from harness.papers.study import indexing
from mechanism_fmu.fmu.native.package import build_native_fmu
from tests.harness.machine.foreign import in_c
from tests.once import once

G = 9.81


@pytest.fixture(scope="module")
def foreign(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """A function that gives the foreign FMU of a kind."""
    pytest.importorskip("ziglang")

    def made(kind: str) -> Path:
        return (
            once(tmp_path_factory, f"exchange_{kind}", lambda folder: in_c.for_exchange(folder, kind)) / f"{kind}.fmu"
        )

    return made


@pytest.fixture
def instance() -> Iterator[Callable[..., FmuSlave]]:
    """A function that makes an initialized instance of an FMU."""
    with ExitStack() as stack:

        def make(path: Path, integrator: Integrator | None = None, **values: float) -> FmuSlave:
            slave = stack.enter_context(stack.enter_context(open_fmu(path, integrator)).instantiate("one"))
            slave.set(values)
            slave.initialize(0.0, 100.0)
            return slave

        yield make


def steps(slave: FmuSlave, count: int, size: float) -> None:
    for k in range(count):
        slave.step(k * size, size)


@pytest.mark.parametrize("method", ["DOP853", "RK45"])
def test_a_foreign_ball_bounces_when_theory_says(foreign, instance, method):
    ball = instance(foreign("bouncing"), Integrator(method))
    fall = math.sqrt(2.0 / G)
    steps(ball, 100, 0.01)
    assert ball.get(["count"]) == [1]
    speed, since = 0.7 * G * fall, 1.0 - fall
    assert ball.get(["x0", "x1"]) == pytest.approx([speed * since - 0.5 * G * since**2, speed - G * since], rel=1e-9)
    # all bounces end within fall (1 + 2 (e + e^2 + ...)) = fall (1 + e) / (1 - e) = 2.56 s
    for k in range(100, 300):
        ball.step(k * 0.01, 0.01)
    bounces = 1 + math.ceil(math.log(1e-3 / (0.7 * G * fall)) / math.log(0.7))
    assert ball.get(["count", "x1"]) == [bounces, 0.0]
    assert abs(ball.get(["x0"])[0]) < 1e-6


def test_what_is_integrated_does_not_depend_on_how_often_one_looks(foreign, instance):
    once_a_second, often = (instance(foreign("van_der_pol")) for _ in range(2))
    steps(once_a_second, 5, 1.0)
    steps(often, 500, 0.01)
    assert often.get(["x0", "x1"]) == once_a_second.get(["x0", "x1"])
    found = solve_ivp(
        lambda _, x: (x[1], (1.0 - x[0] ** 2) * x[1] - x[0]), (0.0, 5.0), (2.0, 0.0), "DOP853", rtol=1e-12, atol=1e-12
    )
    assert often.get(["x0", "x1"]) == pytest.approx(found.y[:, -1].tolist(), abs=1e-8)


def test_events_by_time_happen_at_their_time(foreign, instance):
    stair = instance(foreign("stair"))
    seen = []
    for k in range(18):
        stair.step(k * 0.25, 0.25)
        seen.append(stair.get(["count"])[0])
    assert seen == [0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4]


def test_a_snapshot_of_a_ball_in_flight(foreign, instance):
    ball = instance(foreign("bouncing"))
    steps(ball, 10, 0.07)
    state = ball.save()
    after = []
    for _ in range(2):
        for k in range(10, 20):
            ball.step(k * 0.07, 0.07)
        after.append(ball.get(["x0", "x1", "count"]))
        ball.restore(state)
    ball.free_state(state)
    assert after[0] == pytest.approx(after[1], rel=1e-8)


def test_outlines_are_followed_from_any_communication_point(built, instance):
    """Ticks of a pin pallet: what is asked for between the integrator's steps is no step."""
    path = built("pin_pallet", build_native_fmu)
    stepped, integrated = (instance(path, integrator) for integrator in (None, Integrator()))
    for slave in (stepped, integrated):
        steps(slave, 20, 0.01)
    names = ["balance_angle", "wheel_angle", "impact_count"]
    assert integrated.get(names) == pytest.approx(stepped.get(names), rel=1e-7)


@pytest.mark.parametrize("when", [0, 50])
def test_a_snapshot_as_bytes_goes_on_in_another_instance(built, instance, when):
    path = built("ratchet", build_native_fmu)
    one, other = (instance(path, Integrator()) for _ in range(2))
    steps(one, when, 0.01)
    data = one.serialize(one.save())
    other.restore(other.deserialize(data))
    for slave in (one, other):
        for k in range(when, 120):
            slave.step(k * 0.01, 0.01)
    assert other.get(["wheel_angle", "impact_time"]) == pytest.approx(one.get(["wheel_angle", "impact_time"]), rel=1e-9)


@pytest.mark.parametrize("restitution", [0.0, 0.3])
@pytest.mark.parametrize("fmi", [2, 3])
def test_the_ratchet_goes_the_way_of_co_simulation(built, instance, restitution, fmi):
    path = built("ratchet", build_native_fmu, fmi=fmi)
    names = ["wheel_angle", "wheel_speed", "energy_lost", "work_done"]
    stepped, integrated = (
        instance(path, integrator, restitution=restitution)
        for integrator in (None, Integrator(relative_tolerance=1e-10))
    )
    first = []
    for k in range(300):
        for slave in (stepped, integrated):
            slave.step(k * 0.01, 0.01)
        if k == 93:
            first = [slave.get(["impact_time"])[0] for slave in (stepped, integrated)]
    assert first[1] == pytest.approx(first[0], abs=1e-9)
    assert integrated.get(names) == pytest.approx(stepped.get(names), rel=1e-7)
    # hops of less than a nanometre are not hops here: the last of ten impacts are one
    assert integrated.get(["impact_count"])[0] >= (1 if restitution == 0.0 else 9)


def test_an_input_that_jumps_between_steps(built, instance):
    path = built("ratchet", build_native_fmu)
    stepped, integrated = (instance(path, integrator) for integrator in (None, Integrator()))
    torques = [1e-3, 2e-3, 0.5e-3, 1.5e-3] * 30
    for k, torque in enumerate(torques):
        for slave in (stepped, integrated):
            slave.set({"drive_torque": torque})
            slave.step(k * 0.01, 0.01)
    names = ["wheel_angle", "wheel_speed", "impact_time"]
    assert integrated.get(names) == pytest.approx(stepped.get(names), rel=1e-8)


def test_a_machine_takes_components_for_model_exchange(tmp_path):
    file = tmp_path / "machine.toml"
    written = {}
    for line in ("", 'integrator = "DOP853"\ntolerance = 1e-10'):
        file.write_text(
            f'[component.wheel]\nmodel = "ratchet"\n{line}\n[run]\nstop_time = "2 s"\nstep = "10 ms"\n',
            encoding="utf-8",
        )
        with prepared(str(file)) as machine, ExitStack() as stack:
            wheel = stack.enter_context(machine.fmus["wheel"].instantiate("wheel"))
            wheel.initialize(0.0, 2.0)
            steps(wheel, 200, 0.01)
            written[line] = wheel.get(["wheel_angle", "impact_time"])
    first, second = written.values()
    assert second == pytest.approx(first, rel=1e-9)


def test_mistakes_are_told(built, foreign, ratchet_fmu, instance):
    with pytest.raises(UsageError, match="it has Co-Simulation only"):
        instance(ratchet_fmu, Integrator())
    with pytest.raises(UsageError, match="take DOP853 or RK45"):
        Integrator("LSODA")
    with pytest.raises(UsageError, match="give one from 1e-13 to 1"):
        Integrator(relative_tolerance=0.0)
    with pytest.raises(FmuError, match="restitution"):
        instance(built("ratchet", build_native_fmu), Integrator(), restitution=2.0)


def test_no_states_and_no_indicators_are_no_trouble(foreign, instance):
    stair = instance(foreign("stair"), Integrator())
    stair.step(0.0, 2.5)
    assert stair.get(["count"]) == [2]
    assert np.isfinite(stair.get(["time"])[0])


def drive(time: float) -> dict[str, float]:
    turn = math.tau / indexing.PERIOD
    return {
        "drive_angle": indexing.MEAN - indexing.AMPLITUDE * math.cos(turn * time),
        "drive_speed": indexing.AMPLITUDE * turn * math.sin(turn * time),
    }


@pytest.mark.parametrize(
    ("restitution", "strokes"), [(0.0, 1), *(pytest.param(e, 4, marks=pytest.mark.slow) for e in (0.0, 0.3))]
)
def test_an_indexing_cycle(built, instance, restitution, strokes):
    """Latches right, as many clicks, the same ledger: four strokes of the free ratchet have some hundred events."""
    path = built("ratchet", build_native_fmu)
    values = {**indexing.VALUES, "restitution": restitution}
    ledger = ["work_done", "energy_lost", "kinetic_energy", "spring_energy"]
    hold, ends = 0.05, []
    for integrator in (None, Integrator(relative_tolerance=1e-10)):
        slave = instance(path, integrator, **values)
        for k in range(round(strokes * indexing.PERIOD / hold)):
            slave.set(drive((k + 0.5) * hold))
            slave.step(k * hold, hold)
        assert slave.get(["clicks"]) == [strokes]
        assert slave.get(["latched_angle"])[0] == pytest.approx(math.radians(75 + 18 * strokes), abs=1e-9)
        ends.append(slave.get(ledger))
    scale = abs(ends[0][0])
    assert np.array(ends[1]) == pytest.approx(np.array(ends[0]), abs=1e-6 * scale)
    start = instance(path, None, **values).get(ledger)
    work, lost, kinetic, spring = (end - begin for end, begin in zip(ends[1], start, strict=True))
    assert abs(kinetic + spring + lost - work) <= 1e-6 * scale
