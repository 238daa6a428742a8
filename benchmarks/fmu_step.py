"""fmi2DoStep of 1 ms by way of fmpy: a pythonfmu FMU with `solve_ivp` inside, and Ratchet.fmu."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from .host import Host
from .instance import INSTANTS
from .step import DRIVES, STEP, WITHIN
from .timing import Comparison, in_turns, require_agreement

_LEAST_RATIO = 25.0
_STEPS = 20

_Work = Callable[[Host], float]


def compare(plain: Path, ratchet: Path, folder: Path, rounds: int) -> list[Comparison]:
    """Compare the FMUs, unzipped into new folders in `folder`: both go through the impact in lockstep."""
    with Host(plain, folder / "plain") as slow, Host(ratchet, folder / "ratchet") as fast:
        return [
            _compare(subject, f"{case}, {when}", work, (slow, fast), rounds)
            for when, time in INSTANTS.items()
            for subject, case, work in _works(slow, fast, time)
        ]


def _works(slow: Host, fast: Host, time: float) -> list[tuple[str, str, _Work]]:
    for host in (slow, fast):
        host.go_to(round(time / STEP))
    require_agreement(f"FMUs at {time:g} s", slow.outputs(), fast.outputs(), WITHIN)
    changing = "input changes at every step"
    return [
        *(
            ("fmi2DoStep of 1 ms", case, lambda host, torques=torques: host.time_steps(torques, _STEPS))
            for case, torques in DRIVES.items()
        ),
        ("set 1, fmi2DoStep, get 6", changing, lambda host: host.time_exchanges(DRIVES[changing], _STEPS)),
    ]
