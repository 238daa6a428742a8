"""Laws of impacts in closed form: those of the engine, small steps along Routh's path, energy and cone."""

import numpy as np
import pytest
from friction_cases import run, simulation_of
from friction_rods import rates_of
from hypothesis import assume, given, strategies as st

from harness.analysis.impact_laws import LAWS, Contact, newton, poisson, stronge, wang_mason
from harness.analysis.measured_impacts import Impacts, impacts_of
from mechanism_fmu.model import GROUND, Body, Mechanism, Output, PointLineContact, Revolute, rigid_body
from mechanism_fmu.simulation import Simulation

BY_NAME = {law.name: law for law in LAWS}
MASS = 0.37


def random_impacts(count: int, seed: int) -> tuple[Impacts, list[tuple[np.ndarray, np.ndarray, float]]]:
    """Impacts of bodies on a level floor; and of each the velocity before, the place and the radius of gyration."""
    random = np.random.default_rng(seed)
    rates = random.uniform(-1.0, 1.0, (count, 3)) * (3.0, 1.0, 20.0)
    place = random.uniform((-0.06, -0.06), (0.06, -0.01), (count, 2))
    radius = random.uniform(0.02, 0.05, count)
    rates[:, 1] = -rates[:, 2] * place[:, 0] - random.uniform(0.2, 2.0, count)  # what approaches
    normal = np.tile((0.0, 1.0), (count, 1))
    return impacts_of(rates, rates, place, normal, radius), list(zip(rates, place, radius.tolist(), strict=True))


def after(impacts: Impacts, impulse: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Velocities after the impulses, the last one as k omega, shape (rows, 3)."""
    p_n, p_t = impulse
    return impacts.before + p_n[:, None] * impacts.normal + p_t[:, None] * impacts.tangent


@pytest.mark.parametrize("law", ["newton", "poisson", "stronge"])
@pytest.mark.parametrize(("mu", "e"), [(0.17, 0.53), (0.6, 0.8), (0.9, 0.0)])
def test_a_law_is_that_of_the_engine(law: str, mu: float, e: float) -> None:
    """The engine carries out the impact of a body on the floor; the same velocities to 1e-12 of the largest."""
    impacts, cases = random_impacts(12, seed=3)
    expected = after(impacts, BY_NAME[law].impulse(impacts.contact, np.asarray(mu), np.asarray(e)))
    for row, (rates, place, radius) in zip(expected, cases, strict=True):
        x, y = place
        body = Body("body", MASS, MASS * radius**2, (-x, -y, 0.0), tuple(rates))
        floor = PointLineContact("floor", "body", (x, y), GROUND, (0.0, 0.0), (0.0, 1.0), friction=mu, restitution=e)
        moment = run(simulation_of([body], 1e-9, [floor], impact_law=law, energy_guard=False), 1e-9)[0]
        found = np.array(rates_of(moment, "body")) * (1.0, 1.0, radius)
        np.testing.assert_allclose(found, row, rtol=0, atol=1e-12 * np.abs(rates).max())


def by_small_steps(contact: Contact, mu: float, e: float, by_work: bool) -> np.ndarray:
    """Normal and tangential impulses by many small steps of P_N, the friction against the slip of each."""
    found = []
    for g_nn, g_nt, g_tt, v_n, v_t in zip(*contact, strict=True):
        step = -v_n / g_nn / 2000.0
        p_n = p_t = work = 0.0
        end = np.inf
        while p_n < end if not by_work else work < end:
            dp_t = np.clip(-(v_t + g_nt * step) / g_tt, -mu * step, mu * step)
            before = v_n
            v_n, v_t = v_n + g_nn * step + g_nt * dp_t, v_t + g_nt * step + g_tt * dp_t
            p_n, p_t, work = p_n + step, p_t + dp_t, work + 0.5 * (before + v_n) * step
            if end == np.inf and v_n >= 0.0:
                end = work * (1.0 - e * e) if by_work else (1.0 + e) * p_n
        found.append((p_n, p_t))
    return np.array(found).T


@pytest.mark.parametrize("law", [stronge, wang_mason])
def test_rouths_path_is_what_small_steps_follow(law) -> None:
    contact = random_impacts(8, seed=5)[0].contact
    found = np.array(law(contact, np.asarray(0.5), np.asarray(0.6)))
    stepped = by_small_steps(contact, 0.5, 0.6, law is stronge)
    np.testing.assert_allclose(found, stepped, rtol=0, atol=3e-3 * np.abs(found).max())


def test_without_friction_all_laws_agree() -> None:
    impacts, _ = random_impacts(50, seed=7)
    for law in LAWS:
        p_n, p_t = law.impulse(impacts.contact, np.asarray(0.0), np.asarray(0.4))
        np.testing.assert_allclose(p_n, -1.4 * impacts.contact.v_n / impacts.contact.g_nn, rtol=1e-12)
        assert np.abs(p_t).max() == 0.0


def test_a_ball_that_grips_has_the_tangential_restitution() -> None:
    """A thin disc struck below its centre, e_t = 0.5, much friction: slip -e_t times that before (G_NT = 0)."""
    rates = np.array([[1.0, -1.0, 0.0]])
    disc = impacts_of(rates, rates, np.array([[0.0, -0.1]]), np.array([[0.0, 1.0]]), np.array([0.1]))
    contact = disc.contact
    p_n, p_t = newton(contact, np.asarray(2.0), np.asarray(0.5), 0.5)
    assert contact.v_t + contact.g_tt * p_t == pytest.approx(-0.5)
    assert contact.v_n + contact.g_nn * p_n == pytest.approx(0.5)


numbers = st.floats(0.0, 1.0, allow_subnormal=False)


@given(seed=st.integers(0, 10**6), mu=st.floats(0.0, 1.5), e=numbers)
def test_impulses_are_in_the_cone_and_no_law_but_newtons_gains_energy(seed: int, mu: float, e: float) -> None:
    impacts, _ = random_impacts(40, seed)
    before = np.einsum("ij,ij->i", impacts.before, impacts.before)
    for law in LAWS:
        p_n, p_t = law.impulse(impacts.contact, np.asarray(mu), np.asarray(e))
        assert np.all(np.isfinite(p_n))
        assert np.all(p_n >= 0.0)
        assert np.all(np.abs(p_t) <= mu * p_n + 1e-9 * np.abs(p_n).max())
        found = after(impacts, (p_n, p_t))
        closing = np.einsum("ij,ij->i", impacts.normal, found)
        assert np.all(closing >= -1e-9 * np.abs(impacts.before).max())  # it separates, or stays
        if law.impulse is not newton:
            assert np.all(np.einsum("ij,ij->i", found, found) <= before * (1.0 + 1e-9)), law.name


def test_newtons_law_can_gain_energy() -> None:
    """As Kane and Levinson found: a slip that ends and e near 1; Poisson's and Stronge's laws lose there."""
    impacts, _ = random_impacts(4000, seed=1)
    before = np.einsum("ij,ij->i", impacts.before, impacts.before)

    def gains(law) -> int:
        found = after(impacts, law(impacts.contact, np.asarray(0.8), np.asarray(0.9)))
        return int(np.sum(np.einsum("ij,ij->i", found, found) > before * (1.0 + 1e-9)))

    assert gains(newton) > 0
    assert gains(poisson) == gains(stronge) == 0


@given(angle=st.floats(-1.4, 1.4), friction=st.floats(0.05, 0.6), e=st.floats(0.0, 1.0), length=st.floats(0.05, 2.0))
def test_with_one_degree_of_freedom_slip_ends_with_compression(angle, friction, e, length) -> None:
    """Stronge's law of a bar on a pin whose end strikes: slip turns round where compression ends, to the last digit.

    With v_N = a q' and v_T = b q', the slope of v_N over P_N is (a^2 +- mu |a b|) / I: + in compression, - behind it,
    and work in expansion is e^2 of that in compression. Friction that locks it (mu |b| >= a) gives nothing back.
    """
    a, b = length * np.cos(angle), -length * np.sin(angle)
    bar = rigid_body("bar", mass=1.0, inertia=length**2 / 12, centre=(length / 2, 0.0), angle=angle, speed=-3.0)
    floor = GROUND.line((a, -b), (1.0, 0.0))
    tip = PointLineContact("tip", bar.at(length, 0.0), floor, friction=friction, restitution=e)
    assume(abs(abs(a) - friction * abs(b)) > 1e-3 * length)
    mechanism = Mechanism(
        (bar,),
        (Revolute("pin", bar.at(0.0, 0.0), GROUND.at(0.0, 0.0)),),
        contacts=(tip,),
        outputs=(Output("speed", "bar.speed", "", "rad/s"),),
        impact_law="stronge",
        energy_guard=False,
    )
    simulation = Simulation(mechanism)
    simulation.advance(1e-9)
    ratio = (abs(a) - friction * abs(b)) / (abs(a) + friction * abs(b))
    assert simulation.read()["speed"] == pytest.approx(3.0 * e * np.sqrt(max(0.0, ratio)), abs=1e-8)
