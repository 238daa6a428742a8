"""Random mechanisms of random force elements: momenta, and a ledger that adds up."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from single_element import ENERGIES, EXACT, POINT, read

from mechanism_fmu.model import (
    Body,
    Bushing,
    Mechanism,
    NonlinearSpring,
    NonlinearTorsionSpring,
    SpringDamper,
    TorsionSpringDamper,
    characteristic,
)
from mechanism_fmu.model.functions import smoothstep, tanh
from mechanism_fmu.simulation import Simulation

SIDE = st.sampled_from(["no", "stretched", "compressed"])
SMALL = st.floats(0.0, 2.0)


@st.composite
def elements(draw, name, body, reaction):
    """A force element between two bodies that keeps momenta."""
    a, b = draw(POINT), draw(POINT)
    stiffness, damping, preload = draw(st.floats(0.0, 20.0)), draw(SMALL), draw(st.floats(-1.0, 1.0))
    kind = draw(st.sampled_from(["line", "torsion", "bushing", "table", "law", "torsion law"]))
    if kind == "line":
        return SpringDamper(name, body, a, reaction, b, stiffness, 1.0, damping, preload, draw(SIDE))
    if kind == "torsion":
        return TorsionSpringDamper(name, body, reaction, stiffness, 0.2, damping, preload, draw(SIDE))
    if kind == "bushing":
        return Bushing(name, body, a, reaction, b, stiffness, 5.0, damping, 0.3, 1.0, damping, 0.1)
    if kind == "table":
        values = draw(st.lists(st.floats(-5.0, 5.0), min_size=4, max_size=4))
        return NonlinearSpring(
            name, body, a, reaction, b, law=characteristic(list(zip((0.2, 0.9, 1.1, 2.0), values, strict=True)))
        )
    if kind == "law":
        return NonlinearSpring(
            name, body, a, reaction, b, law=lambda x, v: stiffness * (x - 1.0) ** 3 + damping * tanh(v) + preload
        )
    return NonlinearTorsionSpring(name, body, reaction, law=lambda x, v: smoothstep(x, -1.0, 1.0) + damping * v)


@settings(deadline=None, max_examples=40, suppress_health_check=[HealthCheck.too_slow])
@given(data=st.data(), rates=st.lists(st.floats(-1.0, 1.0), min_size=9, max_size=9))
def test_free_bodies_with_random_elements_keep_their_momenta_and_the_ledger_adds_up(data, rates):
    names = ("one", "two", "three")
    places = ((0.0, 0.0, 0.3), (1.5, 0.4, -1.0), (0.2, 1.6, 2.0))
    masses = ((1.0, 0.2), (2.0, 0.5), (0.7, 0.3))
    bodies = tuple(
        Body(name, *mass, place, tuple(rates[3 * k : 3 * k + 3]))
        for k, (name, mass, place) in enumerate(zip(names, masses, places, strict=True))
    )
    forces = tuple(
        data.draw(elements(f"e{k}", *pair)) for k, pair in enumerate([names[:2], names[1:], (names[2], names[0])])
    )
    outputs = tuple(o for name in names for o in read(name, "x", "y", "x_rate", "y_rate", "speed"))
    powers = tuple(o for force in forces for o in read(force.name, "power"))
    simulation = Simulation(Mechanism(bodies, forces=forces, outputs=(*outputs, *powers, *ENERGIES), settings=EXACT))

    def kept():
        found = simulation.read()
        total = np.zeros(4)
        for name, (mass, inertia) in zip(names, masses, strict=True):
            x, y, u, v, w = (found[f"{name}.{what}"] for what in ("x", "y", "x_rate", "y_rate", "speed"))
            total[:3] += mass * u, mass * v, inertia * w + mass * (x * v - y * u)
        total[3] = found["kinetic"] + found["spring"] + found["lost"] - found["work"]
        return total

    first = kept()
    for time in (0.1, 0.4, 0.8):
        simulation.advance(time)
        np.testing.assert_allclose(kept(), first, atol=1e-10 * max(1.0, *np.abs(first)))
    found, rates_now = simulation.read(), simulation.read_rates()
    power = sum(found[f"{force.name}.power"] for force in forces)
    assert power == pytest.approx(rates_now["kinetic"], rel=1e-9, abs=1e-9)  # the bodies get what the elements give
