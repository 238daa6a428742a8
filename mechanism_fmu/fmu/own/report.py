"""Report on a user's model file without building its FMU: what is in it, how it starts, and what is wrong with it."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...model import Calculated, Input, Mechanism, MechanismError, Model, Output, Parameter, compile_mechanism
from ...model.errors import picture_of
from ...moving import MovingMechanism
from ..instance.self_check import start_explained
from ..native.objects import has_libraries, library_of
from .examine import examine
from .find import find
from .freedoms import freedoms
from .mistakes import explained
from .prepare import load


@dataclass(frozen=True)
class BodyReport:
    """A body: what it weighs, and where it stands once the mechanism is assembled.

    Attributes:
        name: of it.
        mass: [kg].
        inertia: about its centre of mass [kg.m2].
        guess: (x, y, angle) where assembly begins [m, m, rad].
        pose: (x, y, angle) where it ends; None where it fails.
    """

    name: str
    mass: float
    inertia: float
    guess: tuple[float, ...]
    pose: tuple[float, ...] | None


@dataclass(frozen=True)
class FileReport:
    """What is known of a file.

    Attributes:
        file: as it was given.
        name, description: of the model; "" where the file cannot be read so far.
        parameters, calculated, inputs, outputs: ports; outputs are the default ones where the file declares none.
        own_outputs: whether it declares outputs.
        bodies: with the start pose.
        joints, forces, contacts: names and kinds.
        closed: contacts that are closed at the start.
        degrees_of_freedom: None where they cannot be found.
        redundant: joints with rows that follow from those of others.
        singular: whether the motion can branch at the start.
        warnings: what looks like a mistake.
        mistakes: what has to be changed before the FMU can be built, with the line where it is known.
        picture: of bodies that overlap at the start, an SVG file as text; "" where none do.
    """

    file: str
    name: str = ""
    description: str = ""
    parameters: tuple[Parameter, ...] = ()
    calculated: tuple[Calculated, ...] = ()
    inputs: tuple[Input, ...] = ()
    outputs: tuple[Output, ...] = ()
    own_outputs: bool = False
    bodies: tuple[BodyReport, ...] = ()
    joints: tuple[tuple[str, str], ...] = ()
    forces: tuple[tuple[str, str], ...] = ()
    contacts: tuple[tuple[str, str], ...] = ()
    closed: tuple[str, ...] = ()
    degrees_of_freedom: int | None = None
    redundant: tuple[str, ...] = ()
    singular: bool = False
    warnings: tuple[str, ...] = ()
    mistakes: tuple[str, ...] = ()
    picture: str = ""


def report_on(text: str) -> FileReport:
    """The report on a file, with the default values of its parameters.

    Args:
        text: its path, as it was written.

    Raises:
        WrongUseError: there is no such file, or one that can be no mechanism's.
    """
    path = find(text)
    try:
        module = load(path)
    except MechanismError as error:
        return FileReport(text, mistakes=(str(error),))
    model: Model = module.MODEL
    mistakes, warnings = [], list[str]()
    try:
        warnings = examine(module, path, native=False)
    except MechanismError as error:
        mistakes.append(str(error))
    found: dict[str, Any] = {"name": str(model.name), "description": str(model.description)}
    with suppress(Exception):  # a mistake that has been said
        found |= _facts(model)
        if not mistakes:
            started, refused, doubts = _started(model, path)
            found |= started
            mistakes += refused
            warnings += doubts
    return FileReport(text, **found, warnings=tuple(warnings), mistakes=tuple(mistakes))


def _facts(model: Model) -> dict[str, Any]:
    """What the description says."""
    mechanism = model.build(model.values())
    compile_mechanism(mechanism)
    return {
        "parameters": model.parameters,
        "calculated": mechanism.calculated,
        "inputs": mechanism.inputs,
        "outputs": mechanism.outputs,
        "own_outputs": model.declares_outputs,
        "bodies": _bodies(mechanism, {}),
        "joints": _kinds(mechanism.joints),
        "forces": _kinds(mechanism.forces),
        "contacts": _kinds(mechanism.contacts),
    }


#: What the laws of friction leave open at the start, by the end of the event's name.
_DOUBTS = {
    "undetermined": "the motion depends on how redundant rows share the normal force of '{}', which nothing "
    "determines: the shares of least norm are taken. Leave out a row that another one repeats, or give equal "
    "coefficients to what shares the force.",
    "several": "several motions agree with the friction of '{}' at the start, of which one is taken: "
    "mechanism_fmu.simulation.friction_solutions shows all.",
}


def _started(model: Model, path: Path) -> tuple[dict[str, Any], list[str], list[str]]:
    """What assembly makes of it, why it cannot start, and what is open about the motion that begins."""
    mechanism = model.build(model.values())
    try:
        with explained(path), start_explained():
            moving = MovingMechanism(mechanism)
            free = freedoms(mechanism, library_of() if has_libraries() else None)
    except MechanismError as error:
        return {"picture": picture_of(error)}, [str(error)], []
    q = moving.field("y_end")[: 3 * len(mechanism.bodies)].reshape(-1, 3)
    poses = {body.name: row for body, row in zip(mechanism.bodies, q, strict=True)}
    found = {
        "bodies": _bodies(mechanism, poses),
        "closed": moving.mode(),
        "degrees_of_freedom": free.coordinates - free.rank,
        "redundant": free.redundant,
        "singular": free.singular,
    }
    guards = (event.guard.rpartition(".") for event in moving.events_in_step())
    return found, [], [_DOUBTS[what].format(part) for part, _, what in guards if what in _DOUBTS]


def _bodies(mechanism: Mechanism, poses: Mapping[str, np.ndarray[Any, np.dtype[Any]]]) -> tuple[BodyReport, ...]:
    return tuple(
        BodyReport(
            body.name,
            float(body.mass),
            float(body.inertia),
            tuple(map(float, body.start)),
            tuple(poses[body.name].tolist()) if body.name in poses else None,
        )
        for body in mechanism.bodies
    )


def _kinds(parts: tuple[Any, ...]) -> tuple[tuple[str, str], ...]:
    return tuple((part.name, type(part).__name__) for part in parts)
