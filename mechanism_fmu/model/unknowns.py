"""Names of the engine's unknowns for messages: which part limits the steps."""

from __future__ import annotations

from .mechanism import Mechanism


def unknown_names(mechanism: Mechanism) -> tuple[str, ...]:
    """What the user knows each unknown as, in the order of the engine: positions, rates, work, loss, contacts, own.

    A body is named with the force elements and contacts that act on it.
    """
    names = [
        f"the {what} of {body.name}{_acting_on(mechanism, body.name)}"
        for what in ("position", "speed")
        for body in mechanism.bodies
        for _ in range(3)
    ]
    names += ["the work done", "the energy lost"]
    names += [f"the contact point of {contact.name}" for contact in mechanism.contacts for _ in range(contact.alphas)]
    names += [f"the state of {force.name}" for force in mechanism.forces for _ in range(force.own)]
    return tuple(names)


def _acting_on(mechanism: Mechanism, body: str) -> str:
    forces = [force.name for force in mechanism.forces if body in (force.body, getattr(force, "reaction", None))]
    contacts = [c.name for c in mechanism.contacts if body in (c.body_i, c.body_j)]
    return f" ({', '.join((*forces, *contacts))} act on it)" if forces or contacts else ""
