"""What of a mechanism's inputs and outputs turns its crank, and tells how its members bend."""

from __future__ import annotations

from dataclasses import dataclass

from ..model import GROUND, CompliantShaft, Mechanism, Torque
from .turn import crank_of


@dataclass(frozen=True)
class ElasticPorts:
    """Names of inputs and outputs; "" where there is none.

    Attributes:
        crank: the body that turns the mechanism.
        torque: input of the torque on it.
        shaft_speed, shaft_angle: inputs of the shaft that turns it, [rad/s] and [rad].
        outputs: names of outputs that read members, by their sources, e.g. "arm.end.x_bent" or "arm.stress".
    """

    crank: str
    torque: str
    shaft_speed: str
    shaft_angle: str
    outputs: dict[str, str]

    @property
    def places(self) -> tuple[str, ...]:
        """Ends of members, e.g. "arm.end", whose deviation is an output."""
        return tuple(s.removesuffix(".deviation") for s in self.outputs if s.endswith(".deviation"))


def elastic_ports(mechanism: Mechanism) -> ElasticPorts:
    """The ports of a mechanism with members.

    Raises:
        LinkageError: as of `crank_of`.
    """
    crank = crank_of(mechanism)
    turning = {f.name: f for f in mechanism.forces if getattr(f, "body", "") == crank and f.reaction == GROUND}
    targets = {port.target: port.name for port in mechanism.inputs}

    def of(kind: type, column: str) -> str:
        found = (targets.get(f"{name}.{column}", "") for name, force in turning.items() if isinstance(force, kind))
        return next(filter(None, found), "")

    members = {member.name for member in mechanism.members}
    outputs = {port.source: port.name for port in mechanism.outputs if port.source.partition(".")[0] in members}
    return ElasticPorts(crank, of(Torque, "torque"), of(CompliantShaft, "speed"), of(CompliantShaft, "angle"), outputs)
