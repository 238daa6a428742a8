"""fmi2DoStep of 1 ms by way of fmpy: a pythonfmu FMU with `solve_ivp` inside, and Ratchet.fmu."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from .host import Host
from .step import DRIVES, STEP, WITHIN
from .timing import Comparison, Timer, in_turns, require_agreement

#: Where the phases begin [s]; the impact comes between 0.8 s and 1 s, depending on the drive torques.
_PHASES = {"before impact": 0.0, "after impact": 1.0}
_LEAST_RATIO = 25.0
_STEPS = 20


def compare(plain: Path, ratchet: Path, folder: Path, rounds: int) -> list[Comparison]:
    """Compare the FMUs, unzipped into new folders in `folder`: both go the same way, through the impact."""
    found = []
    with Host(plain, folder / "plain") as slow, Host(ratchet, folder / "ratchet") as fast:
        fast_timers = _timers(fast)
        for phase, begin in _PHASES.items():
            slow.go_to(round(begin / STEP))
            fast.go_to(round(begin / STEP))
            for (subject, drive), timer in _timers(slow).items():
                times = in_turns(timer, fast_timers[subject, drive], rounds)
                require_agreement(f"{subject}, {drive}, {phase}", slow.outputs(), fast.outputs(), WITHIN)
                found.append(Comparison(subject, f"{drive}, {phase}", *times, _LEAST_RATIO))
    return found


def _timers(host: Host) -> dict[tuple[str, str], Timer]:
    """What is timed, by subject and drive."""
    timers: dict[tuple[str, str], Timer] = {
        ("fmi2DoStep of 1 ms", drive): partial(host.time_steps, torques, _STEPS) for drive, torques in DRIVES.items()
    }
    changing = next(iter(DRIVES))
    timers["set 1, fmi2DoStep, get 6", changing] = partial(host.time_exchanges, DRIVES[changing], _STEPS)
    return timers
