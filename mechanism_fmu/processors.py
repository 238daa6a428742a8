"""How many processors this process may use."""

from __future__ import annotations

import math
import os
from pathlib import Path

#: Where Linux says how much processor time a container gets: so many microseconds of each period, or "max".
_QUOTA = Path("/sys/fs/cgroup/cpu.max")


def processors(quota: Path = _QUOTA) -> int:
    """Those that this process may use: of the machine, those it is not kept from, and no more than its container gets.

    Threads or processes beyond that would only take turns. A container's share is known where Linux tells it by
    control groups of version 2; older ones and other systems count the processors alone.

    Args:
        quota: file with the quota of processor time and its period [us], as Linux writes it.

    Returns:
        At least 1.

    Source: Linux, Documentation/admin-guide/cgroup-v2.rst, cpu.max.
    """
    allowed = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    try:
        time, period = quota.read_text(encoding="ascii").split()
        granted = allowed if time == "max" else math.ceil(int(time) / int(period))
    except (OSError, ValueError, ZeroDivisionError):
        granted = allowed
    return max(1, min(allowed, granted))
