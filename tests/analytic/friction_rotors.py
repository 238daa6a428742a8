"""The oracle of friction, what turns: discs that roll, pendulums on a pin with friction or with a brake."""

from __future__ import annotations

import math

from friction_cases import after, now, numbered, run, simulation_of

from mechanism_fmu.model import GROUND, Body, Brake, CamFlatFollower, Revolute, TorsionSpring, circle

_BEYOND = 1.0 + 1e-6

# 3: a round body that rolls and slips.


def disc(data, coefficient, tolerance, rates=(0.0, 0.0), incline=0.0):
    radius, g = data["r"], data["g"]
    body = Body("disc", data["m"], data["kappa"] * data["m"] * radius**2, (0.0, radius, 0.0), (rates[0], 0.0, rates[1]))
    touch = CamFlatFollower(
        "floor", "disc", circle(radius), GROUND, (0.0, 0.0), (1.0, 0.0), unilateral=True, friction=coefficient
    )
    return simulation_of([body], tolerance, [touch], gravity=(g * math.sin(incline), -g * math.cos(incline)))


def rolls(case, tolerance, seen):
    data, results = case["data"], case["results"]
    simulation = disc(data, data["mu"], tolerance, (data["v0"], data["omega0"]))
    if "a_t_turns_back" in results:
        there = after(simulation, results["a_t_turns_back"]).state
        seen.add("v", "turns back", there["disc.x_rate"], 0.0)
    (moment,) = run(simulation, results["a_t_roll"] * _BEYOND)
    assert (moment.name, moment.modes) == ("floor.sticks", "s")
    seen.add("time", "rolls", moment.time, results["a_t_roll"])
    for quantity, what in (("v", "x_rate"), ("omega", "speed"), ("x", "x")):
        seen.add(quantity, "rolls", moment.state[f"disc.{what}"], results[f"a_{quantity}_roll"])
    seen.add("energy", "lost", moment.state["energy.lost"], results["a_lost"])
    seen.add("force", "rolls", moment.friction[0], results["a_friction_after"])
    seen.add("force", "bound", data["mu"] * moment.state["floor.force"], data["mu"] * data["m"] * data["g"])
    later = after(simulation, 2.0 * results["a_t_roll"]).state
    seen.add("omega", "rolls on", later["disc.speed"], results["a_omega_roll"])


def released(case, tolerance, seen):
    data, results = case["data"], case["results"]
    incline = math.radians(data["alpha_deg"])
    simulation = disc(data, data["mu2"], tolerance, incline=incline)
    assert now(simulation).modes == ("s" if results["b_mode"] == "rolls" else "+")
    rates, friction = simulation.read_rates(), now(simulation).friction[0]
    seen.add("acceleration", "of the centre", rates["disc.x_rate"], results["b_acceleration"])
    seen.add("angular", "acceleration", rates["disc.speed"], results["b_angular_acceleration"])
    seen.add("force", "friction", friction, results["b_friction"])
    limit = data["kappa"] / (1.0 + data["kappa"]) * math.tan(incline)
    seen.add("mu", "limit", limit, results["b_mu_limit"])
    later = after(simulation, 1.0).state
    seen.add("x", "after 1 s", later["disc.x"], 0.5 * results["b_acceleration"])
    seen.add("speed", "after 1 s", later["disc.speed"], results["b_angular_acceleration"])


# 8: a pendulum with a friction torque, and one on a pin with friction; a disc on a torsion spring.


def pendulum(data):
    angle, length = data["theta0"], data["l"]
    return Body("pendulum", data["m"], data["J"], (length * math.sin(angle), -length * math.cos(angle), angle))


def pin(data, radius=0.0):
    return Revolute("pin", "pendulum", (0.0, data["l"]), GROUND, (0.0, 0.0), friction_radius=radius)


def swings(simulation, body, name, results, part, seen):
    """Half swings until it rests, each ending in an event `name`."""
    until = results[f"{part}_rests_from"]
    moments = run(simulation, 1.5 * until)
    assert [moment.name for moment in moments] == [name] * results[f"{part}_number_of_half_swings"]
    assert ["s" in moment.modes for moment in moments] == [False] * (len(moments) - 1) + [True]
    for number, time in numbered(results, f"{part}_t_turn_").items():
        moment = moments[number - 1]
        seen.add("time", f"turn {number}", moment.time, time)
        seen.add("angle", f"turn {number}", moment.state[f"{body}.angle"], results[f"{part}_theta_turn_{number}"])
    seen.add("time", "rests", moments[-1].time, until)
    seen.add("angle", "rests", now(simulation).state[f"{body}.angle"], results[f"{part}_rests_at"])


def braked(case, tolerance, seen):
    data, results = case["data"], case["results"]
    brake = (Brake("brake", "pendulum", limit=data["Tf"]),)
    gravity = 0.0, -data["g"]
    simulation = simulation_of([pendulum(data)], tolerance, joints=(pin(data),), forces=brake, gravity=gravity)
    swings(simulation, "pendulum", "brake.sticks", results, "a", seen)


def pinned(case, tolerance, seen):
    data, results = case["data"], case["results"]
    joints = (pin(data, data["rho"]),)
    simulation = simulation_of([pendulum(data)], tolerance, joints=joints, gravity=(0.0, -data["g"]))
    acceleration = simulation.read_rates()["pendulum.speed"]
    seen.add("acceleration", "at release", acceleration, results["b_acceleration_at_release"])
    swings(simulation, "pendulum", "pin.sticks", results, "b", seen)


def on_torsion_spring(case, tolerance, seen):
    data, results = case["data"], case["results"]
    body = Body("disc", 1.0, data["J_r"], (0.0, 0.0, data["phi0"]))
    axle = Revolute("axle", "disc", (0.0, 0.0), GROUND, (0.0, 0.0))
    forces = TorsionSpring("spring", "disc", stiffness=data["k"]), Brake("brake", "disc", limit=data["T_r"])
    simulation = simulation_of([body], tolerance, joints=(axle,), forces=forces)
    moments = run(simulation, 1.5 * results["c_rests_from"])
    assert [moment.name for moment in moments] == ["brake.sticks"] * len(results["c_turns"])
    assert ["s" in moment.modes for moment in moments] == [False] * (len(moments) - 1) + [True]
    seen.add("angle", "turns", [moment.state["disc.angle"] for moment in moments], results["c_turns"])
    for number, time in numbered(results, "c_t_").items():
        seen.add("time", f"turn {number}", moments[number - 1].time, time)
        seen.add("angle", f"turn {number}", moments[number - 1].state["disc.angle"], results[f"c_phi_{number}"])
    seen.add("time", "rests", moments[-1].time, results["c_rests_from"])
    seen.add("angle", "rests", now(simulation).state["disc.angle"], results["c_turns"][-1])
