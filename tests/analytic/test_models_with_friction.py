"""The ready models with friction in hinges, slots, guides and on slopes: ledger, losses, and the number of steps."""

import importlib
import itertools

import pytest

from mechanism_fmu import codes
from mechanism_fmu.simulation import Simulation

CASES = [
    ("ratchet", {"friction": 0.3}),
    ("ratchet", {"friction": 0.3, "joint_friction_radius": 1e-3}),
    ("gear_train", {"joint_friction_radius": 1e-3}),
    ("four_bar", {"joint_friction_radius": 5e-3}),
    ("geneva", {"slot_friction": 0.1}),
    ("geneva", {"slot_friction": 0.3, "joint_friction_radius": 1e-3}),
    ("cam_drive", {"joint_friction_radius": 1e-3, "contact_friction": 0.2}),
    ("slider_crank", {"joint_friction_radius": 1e-3, "slider_friction": 0.2}),
]
POINTS = 100


def run(name: str, **values: float) -> tuple[Simulation, list[float], list[float]]:
    """The simulation behind its stop time; what the energy ledger should keep constant; what has been lost."""
    model = importlib.import_module(f"models.{name}.model").MODEL
    simulation = Simulation(model.build(model.values(**values)))
    kept, lost = [], []
    for k in range(POINTS + 1):
        simulation.advance(k * model.stop_time / POINTS)
        found = simulation.read()
        kept.append(found["kinetic_energy"] + found["spring_energy"] - found["work_done"] + found["energy_lost"])
        lost.append(found["energy_lost"])
    return simulation, kept, lost


@pytest.mark.parametrize(("name", "values"), CASES)
def test_friction_only_takes_energy_and_needs_few_steps_more(name: str, values: dict[str, float]) -> None:
    simulation, kept, lost = run(name, **values)
    plain, _, plain_lost = run(name)
    scale = max(map(abs, (*kept, *lost)))
    assert max(kept) - min(kept) < 1e-7 * scale
    assert all(after >= before - 1e-9 * scale for before, after in itertools.pairwise(lost))
    assert lost[-1] > plain_lost[-1]
    events = simulation.counters[codes.COUNT_EVENTS]
    assert simulation.counters[codes.COUNT_STEPS] <= 3 * plain.counters[codes.COUNT_STEPS] + events


def test_a_hinge_that_stuck_does_not_stop_the_geneva_driver_as_its_pin_enters() -> None:
    """The slot's row has nearly no lever there: mending rows with the hinge as one of them once took all the speed."""
    simulation, _, _ = run("geneva", joint_friction_radius=1e-3)
    assert simulation.read()["driver_speed"] == pytest.approx(6.283185, abs=1e-3)
    assert simulation.read()["energy_lost"] < 0.05
