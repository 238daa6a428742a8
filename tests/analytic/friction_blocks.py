"""The oracle of friction, blocks: on an incline, pushed, on a belt, on each other."""

from __future__ import annotations

import math

from friction_cases import after, block, exciter, now, numbered, on_line, run, simulation_of

from mechanism_fmu.model import GROUND, AngleDriver, Bushing, Input, PointForce, XDriver, YDriver, polynomial_motion

#: How far beyond its last instant a case goes on.
_BEYOND = 1.0 + 1e-6

# 1: a block on an incline, and a block that is pushed.


def thrown(case, tolerance, seen):
    data, results = case["data"], case["results"]
    angle, g = math.radians(data["alpha_deg"]), data["g"]
    body = block("block", data["m"], 0.0, data["v0"])
    gravity = (-g * math.sin(angle), -g * math.cos(angle))
    contacts = [on_line("floor", "block", GROUND, data["mu"])]
    simulation = simulation_of([body], tolerance, contacts, gravity=gravity)
    (stop,) = run(simulation, results["a_t_stop"] * _BEYOND)
    assert stop.name == "floor.sticks"
    seen.add("time", "stop", stop.time, results["a_t_stop"])
    seen.add("x", "stop", stop.state["block.x"], results["a_s_stop"])
    if "a_t_back_at_start" in results:
        assert stop.modes == "-"
        acceleration = simulation.read_rates()["block.x_rate"]
        seen.add("acceleration", "after the turn", acceleration, results["a_acceleration_after_turn"])
        back = after(simulation, results["a_t_back_at_start"])
        seen.add("x", "back", back.state["block.x"], 0.0)
        seen.add("v", "back", back.state["block.x_rate"], results["a_v_back_at_start"])
        return
    assert stop.modes == "s"
    seen.add("force", "after the stop", stop.friction[0], results["a_friction_after_stop"])
    seen.add("force", "normal", stop.state["floor.force"], results["normal_force"])
    seen.add("energy", "lost", stop.state["energy.lost"], results["a_lost_until_stop"])
    assert not run(simulation, 100.0 * results["a_t_stop"])
    seen.add("x", "rests", now(simulation).state["block.x"], results["a_s_stop"])


def pushed(case, tolerance, seen):
    data, results = case["data"], case["results"]
    angle, g = math.radians(data["alpha_deg"]), data["g"]
    simulation = simulation_of(
        [block("block", data["m"])],
        tolerance,
        [on_line("floor", "block", GROUND, data["mu"])],
        gravity=(-g * math.sin(angle), -g * math.cos(angle)),
        forces=(PointForce("push", "block"),),
        inputs=(Input("push", "push.x", 0.0, "", "N"),),
    )
    simulation.set_slope("push", data["k"])
    balanced = after(simulation, results["b_t_friction_zero"])
    assert balanced.modes == "s"
    seen.add("force", "balanced", balanced.friction[0], 0.0)
    seen.add("force", "bound", data["mu"] * balanced.state["floor.force"], data["mu"] * data["m"] * g * math.cos(angle))
    simulation.set_slope("push", data["k"])
    (slips,) = run(simulation, results["b_t"])
    assert (slips.name, slips.modes) == ("floor.slips", "+")
    end = now(simulation)
    seen.add("time", "slip", slips.time, results["b_t_slip"])
    seen.add("x", "end", end.state["block.x"], results["b_s_at_t"])
    seen.add("v", "end", end.state["block.x_rate"], results["b_v_at_t"])


def shaken(case, tolerance, seen):
    data, results = case["data"], case["results"]
    bodies, parts = exciter(block("block", data["m"]), data["F0"], data["Omega"], -0.5 * math.pi)
    contacts = [on_line("floor", "block", GROUND, data["mu"])]
    simulation = simulation_of(bodies, tolerance, contacts, gravity=(0.0, -data["g"]), **parts)
    moments = run(simulation, results["c_t_stop_2"] * _BEYOND)
    expected = []
    sticks = True
    for number, time in numbered(results, "c_t_stop_").items():
        if sticks:
            expected.append(("floor.slips", results[f"c_t_slip_{number}"], None))
        sticks = results[f"c_sticks_after_stop_{number}"]
        expected.append(("floor.sticks", time, results[f"c_s_stop_{number}"]))
    assert [moment.name for moment in moments] == [name for name, _, _ in expected]
    for moment, (name, time, place) in zip(moments, expected, strict=True):
        seen.add("time", name, moment.time, time)
        if place is not None:
            seen.add("x", name, moment.state["block.x"], place)


# 2: a mass on a spring and a moving belt; on a plane with a harmonic force.


def spring(data):
    return Bushing("spring", "block", (0.0, 0.0), GROUND, (0.0, 0.0), stiffness_x=data["k"])


def belt(case, tolerance, seen):
    data, results = case["data"], case["results"]
    joints = (
        XDriver("belt_x", "belt", (0.0, 0.0), polynomial_motion(0.0, data["vb"])),
        YDriver("belt_y", "belt", (0.0, 0.0), polynomial_motion(0.0)),
        AngleDriver("belt_angle", "belt", polynomial_motion(0.0)),
    )
    simulation = simulation_of(
        [block("block", data["m"], data["x0"], data["v0"]), block("belt", 1.0, 0.0, data["vb"])],
        tolerance,
        [on_line("touch", "block", "belt", data["mu"])],
        gravity=(0.0, -data["N"] / data["m"]),
        joints=joints,
        forces=(spring(data),),
    )
    moments = run(simulation, results["a_t_leaves_belt"] * _BEYOND)
    times = numbered(results, "a_t_reaches_belt_")
    assert [m.name for m in moments] == ["touch.sticks"] * len(times) + ["touch.slips"]
    assert [m.modes[0] == "s" for m in moments].index(True) == results["a_slip_reversals_before_sticking"]
    for moment, number in zip(moments, times, strict=False):
        seen.add("time", f"reaches {number}", moment.time, times[number])
        seen.add("x", f"reaches {number}", moment.state["block.x"], results[f"a_x_reaches_belt_{number}"])
    leaves = moments[-1]
    seen.add("time", "leaves", leaves.time, results["a_t_leaves_belt"])
    seen.add("x", "leaves", leaves.state["block.x"], results["a_x_leaves_belt"])
    rest, moving = results["a_x_leaves_belt"], data["vb"]
    quarter, period = results["cycle_quarter"], results["cycle_period"]
    points = (
        (quarter, (results["cycle_x_max"], 0.0)),
        (2 * quarter, (rest, -moving)),
        (3 * quarter, (results["cycle_x_min"], 0.0)),
        (period, (rest, moving)),
        (1.0, results["a_state_1s_after_leaving"]),
    )
    for since, state in sorted(points):
        there = after(simulation, leaves.time + since).state
        seen.add("x", f"{since:g} s after it has left", there["block.x"], state[0])
        seen.add("v", f"{since:g} s after it has left", there["block.x_rate"], state[1])


def den_hartog(case, tolerance, seen):
    data, results = case["data"], case["results"]
    bodies, parts = exciter(block("block", data["m"], data["x0"]), data["F0"], data["Omega"], 0.0)
    parts["forces"].append(spring(data))
    contacts = [on_line("floor", "block", GROUND, data["mu"])]
    simulation = simulation_of(bodies, tolerance, contacts, gravity=(0.0, -data["N"] / data["m"]), **parts)
    period, place = results["b_period"], results["b_turning_point_X"]
    seen.add("time", "period", 2.0 * math.pi / data["Omega"], period)
    slipped = results["b_slip_start_after_force_minimum"]
    first = slipped - 0.5 * results["b_stick_duration"]
    number, before, x = 0, math.inf, data["x0"]
    while abs(x - before) > 1e-13 and number < 200:  # until it has settled
        before = x
        x = after(simulation, first + number * period).state["block.x"]
        number += 1
    lost = simulation.read()["energy.lost"]
    for past in range(number - 1, number + 2):
        moments = run(simulation, first + (past + 1) * period)
        assert [m.name for m in moments] == ["floor.slips", "floor.sticks"] * 2
        assert [m.modes[0] for m in moments] == ["-", "s", "+", "s"]
        times = [m.time - past * period for m in moments]
        stopped = slipped + 0.5 * period - results["b_stick_duration"]
        seen.add("time", "slips", times[0], slipped)
        seen.add("time", "stops", times[1], stopped)
        seen.add("time", "slips back", times[2], slipped + 0.5 * period)
        seen.add("time", "stops again", times[3], stopped + 0.5 * period)
        seen.add("x", "turning points", [m.state["block.x"] for m in moments], [place, -place, -place, place])
        seen.add("energy", "lost", now(simulation).state["energy.lost"] - lost, results["b_lost_per_period"])
        lost = now(simulation).state["energy.lost"]


# 7: two blocks, one on the other.


def stacked(case, tolerance, seen):
    data, results = case["data"], case["results"]
    simulation = simulation_of(
        [block("lower", data["m1"]), block("upper", data["m2"])],
        tolerance,
        [on_line("floor", "lower", GROUND, data["mu1"]), on_line("upper_on_lower", "upper", "lower", data["mu2"])],
        gravity=(0.0, -data["g"]),
        joints=(AngleDriver("upright", "lower", polynomial_motion(0.0)),),
        forces=(PointForce("push", data["force_on"]),),
        inputs=(Input("push", "push.x", 0.0, "", "N"),),
    )
    simulation.set_slope("push", data["k"])
    moments = run(simulation, data["T1"])
    simulation.set_input("push", 0.0)
    simulation.begin_step()
    moments.append(now(simulation, "force off"))
    moments += run(simulation, results["sequence"][-1]["t"] * _BEYOND)
    names = {"floor.slips": "floor slips", "floor.sticks": "floor stops"}
    names |= {"upper_on_lower.slips": "upper slips", "upper_on_lower.sticks": "upper stops"}
    found = [(names.get(m.name, m.name), m.modes[:2]) for m in moments if m.name != "input"]
    assert found == [(event["event"], event["modes_after"]) for event in results["sequence"]]
    for number, (moment, event) in enumerate(zip(moments, results["sequence"], strict=True), start=1):
        state, there = results[f"state_{number}"], moment.state
        seen.add("time", event["event"], moment.time, event["t"])
        seen.add("x", event["event"], (there["lower.x"], there["upper.x"]), (state[0], state[2]))
        seen.add("v", event["event"], (there["lower.x_rate"], there["upper.x_rate"]), (state[1], state[3]))
