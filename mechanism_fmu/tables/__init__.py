"""An instance's memory, declared once: what stands where in its block, for the model that writes it and the engine.

A table is a class, a column is a line of it (`declare`); the engine reads `Joints(block).data`, compiled or not. From
the declarations follow the sizes, the offsets and shapes in the block (`layout`), what a mechanism is written into
(`pack`), and the header of the C surface (`mechanism_fmu.fmu.native.headers`).

    parts      the mechanism: bodies, joints, forces, contacts, curves, ports, settings
    method     the Runge-Kutta method, from which two tables take their sizes
    motion     how far the motion has come, and the scratch of its calculation
    members    elastic members and the structure that they make
"""

from .members import Beams as Beams
from .members import Couples as Couples
from .members import Lumps as Lumps
from .members import Members as Members
from .members import Nodes as Nodes
from .members import Structure as Structure
from .members import Ties as Ties
from .parts import Bodies as Bodies
from .parts import Contacts as Contacts
from .parts import Curves as Curves
from .parts import Forces as Forces
from .parts import Functions as Functions
from .parts import Joints as Joints
from .parts import Options as Options
from .parts import Patterns as Patterns
from .parts import Ports as Ports
