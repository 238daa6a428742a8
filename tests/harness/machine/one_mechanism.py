"""Several mechanisms as one, joined by the shafts that couple their FMUs otherwise: what a machine should do."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from mechanism_fmu.model import GROUND, CompliantShaft, Damper, Input, Mechanism, Output, Settings, TorsionSpring


@dataclass(frozen=True)
class Join:
    """A `CompliantShaft` whose driven end follows a body of another part.

    Attributes:
        body: "<part>.<body>", what drives.
        shaft: "<part>.<force>", the shaft, which acts on the driven body.
        offset: of the end's angle from the body's [rad].
    """

    body: str
    shaft: str
    offset: float = 0.0


def one_mechanism(parts: Mapping[str, Mechanism], joins: Sequence[Join], tolerance: float = 1e-11) -> Mechanism:
    """The parts as one mechanism; their parts and ports have the part's name before theirs: "ratchet_wheel".

    Outputs are those of bodies and forces.
    """
    made: dict[str, list[Any]] = {kind: [] for kind in ("bodies", "joints", "forces", "contacts", "patterns")}
    inputs: list[Input] = []
    outputs: list[Output] = []
    held: list[str] = []
    shafts = {join.shaft.replace(".", "_"): join for join in joins}
    for part, mechanism in parts.items():
        for kind, entries in made.items():
            entries += [_renamed(entry, part) for entry in getattr(mechanism, kind)]
        known = {p.name for p in (*mechanism.bodies, *mechanism.forces)}
        joined = {name.removeprefix(f"{part}_") for name in shafts}
        known -= joined
        inputs += [
            replace(port, name=f"{part}_{port.name}", target=f"{part}_{port.target}")
            for port in mechanism.inputs
            if port.target.partition(".")[0] not in joined
        ]
        outputs += [
            replace(port, name=f"{part}_{port.name}", source=f"{part}_{port.source}", feedthrough=())
            for port in mechanism.outputs
            if port.source.partition(".")[0] in known
        ]
        held += [f"{part}_{name}" for name in mechanism.held]
    made["forces"] = [force for each in made["forces"] for force in _joined(each, shafts)]
    return Mechanism(
        **{kind: tuple(entries) for kind, entries in made.items()},
        inputs=tuple(inputs),
        outputs=tuple(outputs),
        held=tuple(held),
        settings=Settings(relative_tolerance=tolerance),
    )


def _renamed(entry: Any, part: str) -> Any:
    """A part of a mechanism with the names in it made unique."""
    names = ("name", "body", "reaction", "body_i", "body_j", "pattern")
    fields = {name: getattr(entry, name) for name in names if name in entry.__dataclass_fields__}
    return replace(entry, **{key: f"{part}_{name}" for key, name in fields.items() if name not in (GROUND, None)})


def _joined(force: Any, shafts: Mapping[str, Join]) -> tuple[Any, ...]:
    """A force; of a shaft that is joined, its spring and its damper between the two bodies."""
    join = shafts.get(force.name)
    if join is None:
        return (force,)
    assert isinstance(force, CompliantShaft)
    driver = join.body.replace(".", "_")
    return (
        TorsionSpring(force.name, force.body, driver, force.stiffness, join.offset),
        Damper(f"{force.name}_damper", force.body, driver, force.damping),
    )
