"""One communication step of 1 ms: `solve_ivp` with the pseudoinverse and the impact's event, and the engine."""

from __future__ import annotations

from . import reference
from .instance import INSTANTS, Instance
from .plain import INPUTS, at_rest, driven, outputs
from .timing import Comparison, batch, in_turns, require_agreement

STEP = 1e-3
#: Drive torques [N m], used in turns, so that the engine must drop what it has computed ahead; and one that stays.
DRIVES = {
    "new input each step": (1.1e-3, 1.2e-3),
    "constant input": (INPUTS["drive_torque"], INPUTS["drive_torque"]),
}
#: Both integrate with the relative tolerance 1e-9; what they find differs by less [rad, rad/s].
WITHIN = 1e-8

_LEAST_RATIO = 50.0
_STEPS = 50
_ENGINE_BATCHES = 20


def compare(rounds: int) -> list[Comparison]:
    """Compare before and after the impact, with a drive torque that changes at every step and with one that stays."""
    instances = {when: Instance(time) for when, time in INSTANTS.items()}
    return [
        _compare(f"{drive}, {when}", instance, torques, rounds)
        for drive, torques in DRIVES.items()
        for when, instance in instances.items()
    ]


def _compare(case: str, instance: Instance, torques: tuple[float, float], rounds: int) -> Comparison:
    ratchet, _ = at_rest()

    def plain() -> reference.State:
        state = instance.state
        for k in range(_STEPS):
            state = reference.step(driven(ratchet, torques[k % 2], 0.0, 0.0), state, STEP)
        return state

    def engine() -> None:
        instance.go_back()
        for k in range(_STEPS):
            instance.inputs[0] = torques[k % 2]
            instance.advance(instance.state.time + (k + 1) * STEP)

    engine()
    require_agreement(f"1 ms steps, {case}", outputs(plain()), instance.outputs(), WITHIN)
    slow, fast = in_turns(
        lambda: batch(plain, 1) / _STEPS,
        lambda: batch(engine, _ENGINE_BATCHES) / _STEPS,
        rounds,
    )
    return Comparison("one 1 ms step", case, slow, fast, _LEAST_RATIO)
