"""`simulate`: known answers, all impacts, the table, and a start without a compiler."""

import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Body,
    Brake,
    Input,
    Mechanism,
    MechanismError,
    Output,
    PointLineContact,
    Revolute,
    Torque,
    default_outputs,
    torque_input,
)
from mechanism_fmu.moving import MovingMechanism
from mechanism_fmu.simulation import Simulation, SimulationError, simulate

GRAVITY = 9.81


def ball(restitution: float = 0.5, height: float = 1.0) -> Mechanism:
    """A ball that falls on the ground."""
    floor = PointLineContact("floor", "ball", (0.0, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0), restitution=restitution)
    return Mechanism(bodies=(Body("ball", 2.0, 1.0, (0.0, height, 0.0)),), contacts=(floor,), gravity=(0.0, -GRAVITY))


def rotor(**parts) -> Mechanism:
    """A wheel of inertia 2 with a motor."""
    return Mechanism(
        bodies=(Body("wheel", 1.0, 2.0),),
        joints=(Revolute("hinge", "wheel", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=(Torque("motor", "wheel"),),
        inputs=(torque_input("motor", "wheel"),),
        **parts,
    )


def test_a_ball_that_bounces_to_rest_loses_no_impact():
    """Each impact has the restitution times the speed of the one before, until the ball rests: Zeno in finite time."""
    result = simulate(ball(0.8), 10.0, step=10.0)  # all in one communication step
    first = math.sqrt(2 * GRAVITY)
    speeds = np.array([impact.closing_speed for impact in result.impacts])
    np.testing.assert_allclose(speeds, first * 0.8 ** np.arange(len(speeds)), rtol=1e-6)
    assert len(speeds) > 60
    assert [impact.instant for impact in result.impacts] == list(range(1, len(speeds) + 1))
    assert result.statistics.impacts == len(result.impact_table) == len(speeds)
    assert result.statistics.events == len(result.events) == len(result.event_table)
    lost = sum(impact.energy_lost for impact in result.impacts)
    assert lost == pytest.approx(2.0 * GRAVITY, rel=1e-9)  # all of it
    assert result["energy_lost"][-1] == pytest.approx(lost, rel=1e-12)


def test_the_motion_does_not_depend_on_the_step():
    coarse, fine = simulate(ball(0.7), 1.5, step=1.5), simulate(ball(0.7), 1.5, step=1e-3)
    assert coarse.impacts == fine.impacts
    last = [result.at(1.5) for result in (coarse, fine)]
    assert [values.pop("impact") for values in last] == [1.0, 0.0]  # whether there was one in the last step
    assert last[0] == last[1]
    assert coarse.statistics.accepted_steps == fine.statistics.accepted_steps


def test_it_is_what_a_simulation_by_hand_gives():
    result = simulate(ball(0.0), 0.4, step=0.1)
    simulation = Simulation(replace(ball(0.0), outputs=(Output("y", "ball.y", ""),)))
    for time, y in zip(result["time"], result["ball_y"], strict=True):
        simulation.advance(time)
        assert simulation.read()["y"] == y == pytest.approx(1.0 - GRAVITY * time**2 / 2, abs=1e-12)


def test_inputs_are_numbers_or_functions_that_are_held_over_a_step():
    result = simulate(rotor(), 1.0, step=0.25, inputs={"motor_torque": lambda t: 2.0 * t})
    assert result["motor_torque"].tolist() == [0.0, 0.0, 0.5, 1.0, 1.5]
    assert result["wheel_speed"][-1] == pytest.approx(0.25 * (0.0 + 0.5 + 1.0 + 1.5) / 2.0, rel=1e-12)
    held = simulate(rotor(), 1.0, inputs={"motor_torque": 2.0})
    assert held["wheel_speed"][-1] == pytest.approx(1.0, rel=1e-12)
    assert held["wheel_angle"][-1] == pytest.approx(0.5, rel=1e-9)


def test_the_table_has_units_and_what_was_asked_for():
    angle = Output("angle", "wheel.angle", "Of the wheel", "rad", "deg")
    mechanism = rotor(outputs=(angle,))
    result = simulate(
        mechanism, 1.0, outputs=["angle", "wheel.speed", "wheel.x_rate", Output("e", "energy.work", "", "J")]
    )
    assert list(result.table) == ["time", "motor_torque", "angle", "wheel_speed", "wheel_x_rate", "e"]
    assert result.table.attrs["units"] == dict(zip(result.table, ["s", "N.m", "rad", "rad/s", "m/s", "J"], strict=True))
    assert list(simulate(mechanism, 1.0).table) == ["time", "motor_torque", "angle"]
    with pytest.raises(MechanismError, match=r"wheel\.angel.*did you mean"):
        simulate(mechanism, 1.0, outputs=["wheel.angel"])


def test_times_end_where_they_are_asked_to():
    assert simulate(rotor(), 1.0, step=0.3)["time"].tolist() == pytest.approx([0.0, 0.3, 0.6, 0.9, 1.0])
    assert len(simulate(rotor(), 0.7).table) == 1001
    assert simulate(rotor(), 3.0, start=2.0, step=0.5)["time"].tolist() == [2.0, 2.5, 3.0]


@pytest.mark.parametrize(("until", "step"), [(0.0, 0.1), (1.0, 0.0), (math.inf, 0.1), (1.0, math.nan)])
def test_impossible_times_are_refused(until, step):
    with pytest.raises(ValueError, match="give finite times"):
        simulate(rotor(), until, step=step)


def test_an_unknown_input_is_refused():
    with pytest.raises(MechanismError, match="there is no input 'torque'; there are: motor_torque"):
        simulate(rotor(), 1.0, inputs={"torque": 1.0})


def test_between_rows_is_interpolated_and_counts_are_those_of_the_row_before():
    result = simulate(ball(0.5), 1.0, step=0.1)
    middle = (result["ball_y"][1] + result["ball_y"][2]) / 2
    assert result.at(0.15)["ball_y"] == pytest.approx(middle, rel=1e-12)
    assert (result.at(0.45)["impact_count"], result.at(0.55)["impact_count"]) == (0.0, 1.0)
    assert result.at(1.0)["time"] == 1.0
    with pytest.raises(ValueError, match="not within the run"):
        result.at(1.5)
    with pytest.raises(KeyError, match="there are: time"):
        result["nothing"]


def test_a_csv_file_has_units_in_its_headings(tmp_path):
    result = simulate(ball(), 0.5, step=0.25)
    result.to_csv(tmp_path / "ball.csv")
    table = pd.read_csv(tmp_path / "ball.csv")
    assert list(table)[:3] == ["time [s]", "ball_x [m]", "ball_y [m]"]
    assert table["ball_y [m]"].tolist() == result["ball_y"].tolist()
    assert table["floor_active"].tolist() == [False, False, False]


def test_a_plot_has_a_chart_for_each_unit_and_a_line_for_each_impact():
    result = simulate(ball(0.5), 1.0)
    figure = result.plot("ball_y", "floor_gap", "kinetic_energy")
    assert [trace.name for trace in figure.data] == ["ball y", "floor gap", "kinetic energy"]
    assert (figure.layout.yaxis.title.text, figure.layout.yaxis2.title.text) == ("[m]", "[J]")
    times = {shape.x0 for shape in figure.layout.shapes}
    assert times == {impact.time for impact in result.impacts}
    drawn = {trace.name for trace in result.plot().data}
    assert "ball y" in drawn
    assert "ball x" not in drawn  # it does not change


def test_many_contacts_at_one_instant_are_all_kept():
    """Twenty arms on one shaft strike their stops at the same time."""
    count = 20
    bodies = tuple(Body(f"arm{k}", 1.0, 1.0, start_rate=(0.0, 0.0, -1.0)) for k in range(count))
    hinges = tuple(Revolute(f"hinge{k}", f"arm{k}", (0.0, 0.0), GROUND, (0.0, 0.0)) for k in range(count))
    stops = tuple(AngleStop(f"stop{k}", f"arm{k}", GROUND, -0.5, restitution=0.5) for k in range(count))
    result = simulate(Mechanism(bodies, hinges, contacts=stops), 1.0)
    assert len(result.impacts) == count
    assert {impact.contact for impact in result.impacts} == {stop.name for stop in stops}
    np.testing.assert_allclose([impact.time for impact in result.impacts], 0.5, rtol=1e-12)


def test_statistics_count_what_the_solver_does():
    still = simulate(rotor(), 1.0)
    fast = simulate(ball(0.9), 3.0)
    for statistics in (still.statistics, fast.statistics):
        tried = statistics.evaluations / 6  # Dormand and Prince: seven stages, of which the first is the last before
        assert tried >= statistics.accepted_steps + statistics.rejected_steps
        assert statistics.accepted_steps > 0
        assert statistics.wall_time > 0.0
    assert fast.statistics.evaluations > still.statistics.evaluations


def test_a_motion_that_cannot_go_on_says_so():
    mechanism = replace(ball(), bodies=(Body("ball", 2.0, 1.0, (0.0, -1.0, 0.0)),))
    with pytest.raises((MechanismError, SimulationError), match="floor"):
        simulate(mechanism, 1.0)


def test_a_simulation_takes_the_compiled_engine_and_its_numbers_are_the_same():
    """In a process of its own: it compiles nothing, and numba is not even imported."""
    program = (
        "import sys\n"
        "from mechanism_fmu.simulation import simulate\n"
        "from mechanism_fmu.model import Body, Mechanism\n"
        "result = simulate(Mechanism((Body('stone', 1.0, 1.0),), gravity=(0.0, -9.81)), 1.0)\n"
        "print(result['stone_y'][-1].hex(), 'numba' in sys.modules)\n"
    )
    root = Path(__file__).parents[3]
    done = subprocess.run([sys.executable, "-c", program], cwd=root, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    y, numba = done.stdout.split()
    stone = Mechanism((Body("stone", 1.0, 1.0),), gravity=(0.0, -GRAVITY), outputs=(Output("y", "stone.y", ""),))
    simulation = MovingMechanism(stone)
    simulation.advance(1.0)
    assert float.fromhex(y) == simulation.read()["y"]
    assert numba == "False"


def test_an_input_with_a_name_of_its_own_stays_at_its_start():
    mechanism = replace(rotor(), inputs=(Input("pull", "motor.torque", 4.0, "Of the motor", "N.m"),))
    assert simulate(mechanism, 1.0)["wheel_speed"][-1] == pytest.approx(2.0, rel=1e-12)


@pytest.mark.parametrize(
    ("inputs", "said"),
    [
        ([0.5], r"inputs has 1 values for 2 inputs \(motor_torque, brake\)"),
        ([], "inputs has 0 values for 2 inputs"),
        ([0.5, 1.0, 2.0], "inputs has 3 values for 2 inputs"),
        ([0.5, 3.0], "brake = 3 N.m is above its limit; give at most 2 N.m"),
        ([0.5, math.nan], "brake = nan is not a finite number"),
        ([0.5, "3 m"], "brake wants N.m, got '3 m'"),
        ([0.5, None], "brake wants a number in N.m, got None"),
    ],
)
def test_values_of_inputs_are_checked_wherever_they_are_given(inputs, said):
    brake = Input("brake", "brake.torque", 0.0, "Brake", "N.m", maximum=2.0)
    one = rotor()
    both = replace(one, forces=(*one.forces, Torque("brake", "wheel")), inputs=(*one.inputs, brake))
    for kind in (Simulation, MovingMechanism):
        with pytest.raises(MechanismError, match=said):
            kind(both, 0.0, inputs)
    if len(inputs) == 2:
        with pytest.raises(MechanismError, match=said):
            Simulation(both).set_input("brake", inputs[1])
        with pytest.raises(MechanismError, match=said):
            simulate(both, 0.1, inputs={"brake": inputs[1]})
        with pytest.raises(MechanismError, match=said):
            simulate(both, 0.1, inputs={"brake": lambda t: inputs[1] if t > 0.05 else 0.0})


def test_inputs_take_texts_with_units_and_unknown_ones_are_named():
    simulation = Simulation(rotor(), 0.0, ["500 N.mm"])
    assert simulation.inputs[0] == 0.5
    simulation.set_input("motor_torque", "200 N.mm")
    assert simulation.inputs[0] == 0.2
    assert simulate(rotor(), 0.1, inputs={"motor_torque": "500 N.mm"})["motor_torque"][-1] == 0.5
    for change in (simulation.set_input, simulation.set_slope):
        with pytest.raises(MechanismError, match="there is no input 'motor'; there are: motor_torque"):
            change("motor", 0.1)
    with pytest.raises(MechanismError, match="motor_torque: slope = nan is not a finite number"):
        simulation.set_slope("motor_torque", math.nan)


@pytest.mark.parametrize("time", [math.nan, math.inf, -math.inf])
def test_a_start_time_that_is_not_finite_is_refused(time):
    with pytest.raises(MechanismError, match=r"the start time is .* s; give a finite one"):
        Simulation(rotor(), time)


@pytest.mark.parametrize("target", [math.nan, math.inf, -1.0])
def test_within_a_step_too_the_motion_only_goes_on_to_a_later_time(target):
    simulation = Simulation(rotor())
    simulation.begin_step()
    with pytest.raises(SimulationError, match="give a later time"):
        simulation.go_on(target, codes.STOP_AT_STEP)
    assert simulation.time == 0.0


@pytest.mark.parametrize("what", ["impacts", "events"])
def test_a_buffer_of_a_step_is_no_column_of_a_run(what):
    source = f"{what}[1].time"
    for asked in (source, Output("first", source, "")):
        with pytest.raises(MechanismError, match=rf"take result\.{what} or result\.{what[:-1]}_table"):
            simulate(ball(), 1.0, outputs=["ball_y", asked])


def test_impulses_of_stops_are_torques_times_time():
    stop = AngleStop("stop", "wheel", GROUND, angle=-1.0)
    stopped = simulate(replace(rotor(), contacts=(stop,)), 3.0, step=1.0, inputs={"motor_torque": -1.0})
    units = stopped.impact_table.attrs["units"]
    assert stopped.impacts[0].impulse == pytest.approx(2.0 * stopped.impacts[0].closing_speed)  # inertia times speed
    assert (units["closing_speed"], units["impulse"], units["energy_lost"]) == ("rad/s", "N.m.s", "J")
    assert stopped.event_table.attrs["units"]["impulse"] == "N.m.s"
    assert {output.name: output.unit for output in default_outputs(stopped.mechanism)}["events[1].impulse"] == "N.m.s"
    falls = simulate(ball(), 1.0, step=1.0)
    assert (falls.impact_table.attrs["units"]["impulse"], falls.event_table.attrs["units"]["impulse"]) == ("N.s", "N.s")
    mixed = simulate(replace(ball(), contacts=(*ball().contacts, AngleStop("stop", "ball", GROUND, angle=-1.0))), 1)
    assert mixed.impact_table.attrs["units"]["impulse"] == "N.s"
    assert mixed.impact_table.attrs["descriptions"]["impulse"] == "Impulse; of stops and locks per radian"


def test_what_slips_as_an_input_jumps_is_among_the_events():
    body = Body("rotor", 1.0, 0.2)
    pin = Revolute("pin", body.at(0, 0), GROUND.at(0, 0))
    forces = (Brake("brake", body, limit=1.0), Torque("motor", body))
    inputs = (Input("torque", "motor.torque", 0.0, "", "N.m"),)
    driven = Mechanism((body,), (pin,), forces=forces, inputs=inputs)
    result = simulate(driven, 2.0, inputs={"torque": lambda t: 2.0 if t >= 1.0 else 0.0})
    assert [(event.guard, event.time) for event in result.events] == [("brake.slips", pytest.approx(1.0))]
    assert result.statistics.events == 1
