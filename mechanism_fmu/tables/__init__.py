"""An instance's memory, declared once: what stands where in its block, for the model that writes it and the engine.

A table is a class, a column is a line of it (`declare`); the engine reads `Joints(block).data`, compiled or not. From
the declarations follow the sizes, the offsets and shapes in the block (`layout`), what a mechanism is written into
(`pack`), and the header of the C surface (`mechanism_fmu.fmu.native.objects`).

    parts      the mechanism: bodies, joints, forces, contacts, curves, ports, settings
    method     the Runge-Kutta method, from which two tables take their sizes
    motion     how far the motion has come, and the scratch of its calculation
    members    elastic members and the structure that they make
"""

from .members import (
    Beams as Beams,
    Couples as Couples,
    Lumps as Lumps,
    Members as Members,
    Nodes as Nodes,
    Structure as Structure,
    Ties as Ties,
)
from .parts import (
    Bodies as Bodies,
    Contacts as Contacts,
    Curves as Curves,
    Features as Features,
    Forces as Forces,
    Functions as Functions,
    Joints as Joints,
    Operations as Operations,
    Options as Options,
    Outlines as Outlines,
    Patterns as Patterns,
    Ports as Ports,
    Thresholds as Thresholds,
)
