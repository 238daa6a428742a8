"""How far numbers are off each other."""

from __future__ import annotations

from typing import Any

import numpy as np


def off_by(found: Any, wanted: Any) -> float:
    """The largest deviation, relative to the largest number wanted."""
    return float(np.abs(np.asarray(found) - np.asarray(wanted)).max() / np.abs(np.asarray(wanted)).max())
