"""Which of the two solutions is asked."""

from __future__ import annotations

from enum import StrEnum


class JudgedBy(StrEnum):
    """The solution that must keep to the limits."""

    ELASTODYNAMIC = "elastodynamic"
    QUASI_STATIC = "quasi-static"
