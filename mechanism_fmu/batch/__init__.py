"""Many designs of one model in one compiled call over threads: the numbers of its FMU, without an FMU's calls.

The one way in which the harness may reach the engine (docs/batch.md, docs/decisions/018-batch.md).
"""

from ..model import MechanismError
from .batch import Batch
from .origin import NoBatchError
from .result import BatchResult

__all__ = ["Batch", "BatchResult", "MechanismError", "NoBatchError"]
