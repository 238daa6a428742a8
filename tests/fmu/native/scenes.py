"""What instances of the ratchet are taken through: by fmpy's host, or written down for a host in C.

Each scene is a function of an `Instance`, or of a `Script`, which knows no values yet.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from mechanism_fmu.moving import MovingMechanism
from models.ratchet.model import MODEL
from tests.fmu.conformance.host import Instance, Value
from tests.fmu.test_indexing_cycle import CYCLE, PERIOD, stroke

#: Outputs of FMI 2.0 and 3.0 alike that do not speak of the last communication step alone.
LASTING = (
    *("wheel_angle", "crank_angle", "pawl_angle", "wheel_speed", "crank_speed", "pawl_speed", "contact_force"),
    *("impact_count", "event_count", "impact_time", "impact_velocity", "impact_closing_speed", "impact_impulse"),
    *("impact_wheel_speed", "impact_tooth", "clicks", "latched_angle", "tooth_index", "slope_active", "face_active"),
    *("kinetic_energy", "spring_energy", "work_done", "energy_lost"),
)
HOLD = 0.02

Look = Callable[[Any], None]


def paper(one: Any, look: Look) -> None:
    """The paper's case, 6 s; all inputs change at each communication point."""
    one.begin()
    while one.time < 6.0 - 1e-9:
        turn = math.sin(3.0 * one.time)
        one.set({"drive_torque": 1e-3 + 2e-4 * turn, "spring_preload": 1e-4 * turn**2, "load_torque": -5e-5 * turn})
        one.step(0.01)
        look(one)


def cycle(one: Any, look: Look, until: float = 4 * PERIOD) -> None:
    """The free pawl goes over four teeth and bounces; both inputs of the drive change every 20 ms."""
    one.begin(CYCLE | {"restitution": 0.3})
    while one.time < until - 1e-9:
        stroke(one, one.time + HOLD, HOLD)
        look(one)


class InEngine:
    """The ratchet without an FMU: parameters to tables in Python, the engine compiled just in time.

    Attributes:
        time: that has been reached [s].
    """

    def begin(self, start: Mapping[str, float] | None = None) -> None:
        given = dict(start or {})
        names = {port.name for port in MODEL.build(MODEL.values()).inputs}
        mechanism = MODEL.build(MODEL.values(**{name: given[name] for name in given.keys() - names}))
        self._simulation = MovingMechanism(
            mechanism, inputs=[given.get(port.name, port.start) for port in mechanism.inputs]
        )
        self.time = 0.0

    def set(self, values: Mapping[str, float]) -> None:
        for name, value in values.items():
            self._simulation.set_input(name, value)

    def step(self, size: float) -> None:
        self._simulation.advance(self.time + size)
        self.time += size

    def outputs(self) -> dict[str, float]:
        return self._simulation.read()


def steps(scene: Callable[[Any, Look], None], one: Instance | InEngine) -> list[dict[str, Value]]:
    """All outputs after each communication step."""
    found: list[dict[str, Value]] = []
    scene(one, lambda one: found.append(one.outputs()))
    return found


def samples(one: Any, names: Iterable[str] = LASTING, until: float = 4 * PERIOD, every: int = 25) -> list[float]:
    """Outputs after each 25th step of the cycle, one after the other."""
    found: list[float] = []
    counted = 0

    def look(one: Any) -> None:
        nonlocal counted
        counted += 1
        if counted % every == 0:
            found.extend(map(float, one.get(names).values()))

    cycle(one, look, until)
    return found
