"""The oracle of friction, rods and blocks that strike: Painleve's rod, a rod on the floor, a block that rocks."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from friction_cases import after, mechanism_of, now, numbered, run, simulation_of

from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, Body, MechanismError, PointLineContact
from mechanism_fmu.simulation import SimulationError, friction_solutions

_BEYOND = 1.0 + 1e-6
#: Long enough for an impact at the start, and too short for any motion [s].
_AT_ONCE = 1e-9

# 4: a rod that slides on its lower end.


def rod(data, angle, rates, tolerance, touch, make=simulation_of, **law):
    """Rod with its lower end at the origin; angle as (cos, sin), rates of the centre of mass and of the angle."""
    mass, half = data["m"], data["l"]
    c, s = angle
    body = Body("rod", mass, mass * half**2 / 3.0, (half * c, half * s, math.atan2(s, c)), rates)
    floor = PointLineContact("floor", "rod", (-half, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0), **touch)
    return make([body], tolerance, [floor], **law)


def sliding(data, angle, rate, slip, mu, tolerance, **law):
    """The rod on the floor, with an angle, its rate and a slip speed of the lower end."""
    c, s = math.cos(angle), math.sin(angle)
    rates = (slip - data["l"] * s * rate, data["l"] * c * rate, rate)
    return rod(data, (c, s), rates, tolerance, {"closed": True, "friction": mu}, gravity=(0.0, -data["g"]), **law)


def forces_of(moment):
    """Of the lower end: normal force and friction."""
    return moment.state["floor.force"], moment.friction[0]


def rates_of(moment, body):
    return [moment.state[f"{body}.{what}"] for what in ("x_rate", "y_rate", "speed")]


def slides(case, tolerance, seen):
    data, results = case["data"], case["results"]
    for number, expected in enumerate(results["runs"], start=1):
        start = expected["theta0"], expected["thetadot0"], expected["vT0"], expected["mu"]
        simulation = sliding(data, *start, tolerance)
        x = simulation.read()["rod.x"]
        if expected["event"] == "stick":
            moment = run(simulation, expected["t"] * _BEYOND)[0]
            assert moment.name == "floor.sticks"
            (behind,) = [choice for choice in expected["after"] if choice["mode"] == moment.modes]
            seen.add("force", f"{number}", forces_of(moment), (behind["N"], behind["T"]))
        else:
            moment = after(simulation, expected["t"])
        seen.add("time", f"{number}", moment.time, expected["t"])
        state = (moment.state[f"rod.{what}"] for what in ("angle", "speed", "x", "x_rate"))
        for quantity, value in zip(("theta", "thetadot", "x_com", "vx_com"), state, strict=True):
            seen.add(quantity, f"{number}", value - (x if quantity == "x_com" else 0.0), expected[quantity])


def table(case, _tolerance, seen):
    """At one instant, with the slip of the table and without slip; no forces, or one of several, where that is so."""
    for number, line in enumerate(case["results"]["table"]):
        state, sigma, mu = (line["theta"], line["thetadot"]), line["sigma"], line["mu"]
        every = friction_solutions(sliding(case["data"], *state, sigma, mu, 1e-9, make=mechanism_of))
        assert len(every) == len(line["N"]) == {"none": 0, "unique": 1, "two": 2}[line["kind"]]
        for one, (normal, along, turn) in enumerate(zip(line["N"], line["xdd"], line["thetadd"], strict=True)):
            solution = sorted(every, key=lambda s: s.normal_forces["floor"])[one]
            seen.add("force", f"{number} of all", solution.normal_forces["floor"], normal)
            x, _, angle = solution.accelerations["rod"]
            seen.add("acceleration", f"{number} of all", x, along)
            seen.add("angular", f"{number} of all", angle, turn)
        still = friction_solutions(sliding(case["data"], *state, 0.0, mu, 1e-9, make=mechanism_of))
        assert len(still) == len(line["at_zero_slip"])
        if line["kind"] == "none":
            with pytest.raises(MechanismError, match="No set of pushing contacts"):
                sliding(case["data"], *state, sigma, mu, 1e-9)
        else:
            simulation = sliding(case["data"], *state, sigma, mu, 1e-9)
            there, rates = now(simulation), simulation.read_rates()
            choice = 0 if there.modes == "o" else len(line["N"]) - 1
            normal = line["N"][choice]
            assert there.modes == ("o" if normal == 0.0 else "+" if sigma > 0 else "-")
            seen.add("force", f"{number}", forces_of(there), (normal, -sigma * mu * normal))
            seen.add("acceleration", f"{number}", rates["rod.x_rate"], line["xdd"][choice])
            seen.add("angular", f"{number}", rates["rod.speed"], line["thetadd"][choice])
        there = now(sliding(case["data"], *state, 0.0, mu, 1e-9))
        (expected,) = [choice for choice in line["at_zero_slip"] if choice["mode"] == there.modes]
        seen.add("force", f"{number} at zero slip", forces_of(there), (expected["N"], expected["T"]))


def jams(case, tolerance, seen):
    """Where A and b vanish together: what the motion comes close to, and what that leads to."""
    data, results = case["data"], case["results"]
    for expected in results["runs"]:
        if "jam" not in expected:
            continue
        start = expected["theta0"], expected["thetadot0"], expected["vT0"], expected["mu"]
        simulation = sliding(data, *start, tolerance)
        with pytest.raises(SimulationError):
            simulation.advance(2.0 * expected["jam"]["t"])
        end, there = simulation.time, simulation.read()
        angle, mu = there["rod.angle"], expected["mu"]
        a = 1.0 + 3.0 * math.cos(angle) * (math.cos(angle) - mu * math.sin(angle))
        slope = -3.0 * (math.sin(2.0 * angle) + mu * math.cos(2.0 * angle)) * there["rod.speed"]
        left = -a / slope
        states = []
        again = sliding(data, *start, tolerance)
        for before in (3.0 * left, left, 0.0):
            state = after(again, end - before).state
            states.append((state["rod.angle"], state["rod.speed"]))
        limit = [z - (z - y) ** 2 / (z - 2.0 * y + x) for x, y, z in zip(*states, strict=True)]
        found = (end + left, *limit)
        for quantity, value, name in zip(("time", "angle", "speed"), found, ("t", "theta", "thetadot"), strict=True):
            seen.add(quantity, "jam", value, expected["jam"][name])


def shocks(case, _tolerance, seen):
    """The jump where no finite force exists."""
    for number, line in enumerate(case["results"]["table"]):
        if line["kind"] != "none":
            continue
        slip = line["impulse"]["vT_before"]
        (expected,) = (solution for solution in line["impulse"]["solutions"] if solution["P_N"] > 0.0)
        state = line["theta"], line["thetadot"], slip, line["mu"]
        simulation = sliding(case["data"], *state, 1e-9, tangential_shock=True)
        (event,) = simulation.events_in_step()
        assert event.guard == "floor.shock"
        moment = now(simulation)
        seen.add("velocity", f"{number}", rates_of(moment, "rod"), expected["velocities"])
        seen.add("impulse", f"{number}", moment.state["impact.impulse:floor"], expected["P_N"])


# 5: a rod strikes the floor.


def strikes(case, law, seen, guarded=False):
    """All impacts by one law, with or without the guard of the energy."""
    data = case["data"]
    c, s = (float(Fraction(data[name])) for name in ("cos", "sin"))
    for number, impact in enumerate(case["results"]["impacts"]):
        touch = {"friction": impact["mu"], "restitution": impact["e"]}
        simulation = rod(data, (c, s), impact["v"], 1e-9, touch, impact_law=law, energy_guard=guarded)
        grows = guarded and impact[law].get("energy_grows", False)
        expected = impact["poisson" if grows else law]
        seen.add("energy", f"{number}", simulation.read()["energy.kinetic"], impact["T_before"])
        moment = run(simulation, _AT_ONCE)[0]
        assert moment.name == "floor.gap"
        assert simulation.counters[codes.COUNT_BY_POISSON] == grows
        state = moment.state
        seen.add("velocity", f"{number}", rates_of(moment, "rod"), expected["v_after"])
        seen.add("energy", f"{number}", state["energy.kinetic"], expected["T_after"])
        seen.add("energy", f"{number} lost", state["impact.energy_lost"], impact["T_before"] - expected["T_after"])
        seen.add("impulse", f"{number}", state["impact.impulse:floor"], expected["P_N"])


def strikes_guarded(case, law, seen):
    strikes(case, law, seen, guarded=True)


# 6: a block that rocks on its two lower corners.


def rocking(data, angle, rate, mu, tolerance, half_width=None, restitution=0.0, **law):
    """Block on its left corner at (-half_width, 0), tilted by an angle; at zero the right one is about to touch."""
    mass, half_height = data["m"], data["h"]
    half_width = data["b"] if half_width is None else half_width
    c, s = math.cos(angle), math.sin(angle)
    x, y = c * half_width - s * half_height, s * half_width + c * half_height
    inertia = mass * (half_width**2 + half_height**2) / 3.0
    body = Body("block", mass, inertia, (x - half_width, y, angle), (-rate * y, rate * x, rate))
    corners = [
        PointLineContact(
            name,
            "block",
            (side * half_width, -half_height),
            GROUND,
            (0.0, 0.0),
            (0.0, 1.0),
            closed=name == "A",
            restitution=restitution,
            friction=mu,
        )
        for name, side in (("A", -1.0), ("B", 1.0))
    ]
    return simulation_of([body], tolerance, corners, gravity=(0.0, -data["g"]), **law)


def modes_behind(moment, half_height):
    """Of an impact: which corners had an impulse, and how they slip behind it, A and B."""
    slip = moment.state["block.x_rate"] + half_height * moment.state["block.speed"]
    mode = "s" if abs(slip) < 1e-9 else "+" if slip > 0.0 else "-"
    return "".join(mode if moment.state[f"impact.impulse:{corner}"] > 0.0 else "o" for corner in "AB")


def rocks(case, tolerance, seen):
    """Large friction, no restitution: it rocks from corner to corner (Housner)."""
    data, results = case["data"], case["results"]
    alpha = math.atan2(data["b"], data["h"])
    ratio = 1.0 - 1.5 * math.sin(alpha) ** 2
    seen.add("ratio", "alpha", alpha, results["alpha"])
    seen.add("ratio", "r", ratio, results["r"])
    seen.add("ratio", "mu", 0.75 * math.sin(2.0 * alpha) / (1.0 + ratio), results["mu_least_no_slip"])
    times, rates, amplitudes = (
        numbered(results, f"housner_{what}_") for what in ("t_impact", "rate_before", "amplitude")
    )
    start = data["fraction"] * alpha, 0.0, data["mu_large"], tolerance
    moments = run(rocking(data, *start), 2.0 * max(times.values()))
    again = rocking(data, *start)
    for number, time in times.items():
        moment = moments[number - 1]
        assert (moment.name, moment.modes) == (("B.gap", "os"), ("A.gap", "so"))[(number - 1) % 2]
        seen.add("time", f"impact {number}", moment.time, time)
        before = moment.state["impact.speed_before:block"]
        seen.add("rate", f"before {number}", abs(before), rates[number])
        seen.add("rate", f"behind {number}", abs(moment.state["block.speed"]), results["r"] * rates[number])
        turns = after(again, 0.5 * (moment.time + moments[number].time)).state
        seen.add("angle", f"amplitude {number}", abs(turns["block.angle"]), amplitudes[number])
        seen.add("rate", f"turns {number}", turns["block.speed"], 0.0)


def strikes_flat(case, law, seen):
    """One impact of the right corner, the left one at rest: with large and small friction, with restitution; wide."""
    data, results = case["data"], case["results"]
    rate = -results["housner_rate_before_1"]
    mass, height, law = data["m"], data["h"], {"impact_law": law, "energy_guard": False}

    def impact(name, mu, restitution=0.0):
        moment = run(rocking(data, 0.0, rate, data[mu], 1e-9, restitution=restitution, **law), _AT_ONCE)[0]
        state = results[f"impact_{name}"]
        states = state if isinstance(state[0], list) else [state]
        rates = rates_of(moment, "block")
        seen.add("velocity", name, rates, min(states, key=lambda s: math.dist(s, rates)))
        if f"impact_{name}_modes" in results:
            modes = results[f"impact_{name}_modes"]
            assert modes_behind(moment, height) in ([modes] if isinstance(modes, str) else modes)
        return moment.state

    if law["impact_law"] == "poisson":
        impact("e_poisson", "mu_large", data["e"])
    else:
        impact("e_newton", "mu_large", data["e"])
    large = impact("large_mu", "mu_large")
    normal = [large[f"impact.impulse:{corner}"] for corner in "AB"]
    seen.add("impulse", "large", normal, results["impact_large_mu_P_N"])
    along = mass * (large["block.x_rate"] + rate * height)
    seen.add("impulse", "large, along", along, results["impact_large_mu_P_T_sum"])
    small = impact("small_mu", "mu_small")
    seen.add("impulse", "small", small["impact.impulse:B"], results["impact_small_mu_P_N_B"])
    slip = small["block.x_rate"] + height * small["block.speed"]
    seen.add("velocity", "slip", slip, results["impact_small_mu_slip_after"])
    seen.add("energy", "small", small["impact.energy_lost"], results["impact_small_mu_lost"])
    wide = run(rocking(data, 0.0, -1.0, data["mu_large"], 1e-9, 2.0 * height, **law), _AT_ONCE)[0]
    seen.add("velocity", "wide", rates_of(wide, "block"), (0.0, 0.0, 0.0))
    normal = [wide.state[f"impact.impulse:{corner}"] for corner in "AB"]
    seen.add("impulse", "wide", normal, results["wide_block_P_N"])
    seen.add("impulse", "wide, along", -mass * height, results["wide_block_P_T_sum"])
