"""Many designs of one model in one compiled call over threads: the numbers of its FMU, without an FMU's calls.

The one way in which the harness may reach the engine (docs/how-to/batch.md, docs/decisions/018-batch.md).
"""

from ..model import MechanismError as MechanismError
from .batch import Batch as Batch
from .numbers import BatchResult as BatchResult
from .origin import NoBatchError as NoBatchError
