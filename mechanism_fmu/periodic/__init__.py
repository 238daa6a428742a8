"""Periodic motions with impacts: found by shooting, with Floquet multipliers.

The harness may import it, as it may `batch`: the state of a mechanism, which shooting changes, is not among the
variables of an FMU.
"""

from ..differences import Slopes as Slopes
from ..model import MechanismError as MechanismError
from ..model.quantities import quantity as quantity
from ..moving import SimulationError as SimulationError
from .cycle import Cycle as Cycle, find_cycle as find_cycle
from .passage import CycleError as CycleError, Direction as Direction, Passage as Passage, Section as Section
from .slopes import GrazingError as GrazingError
from .start import Problem as Problem, Unknown as Unknown
from .written import problem_of as problem_of, section_of as section_of
