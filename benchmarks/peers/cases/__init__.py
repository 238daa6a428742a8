"""The cases, one to a file, in the order of the page."""

from __future__ import annotations

from ..case import Case
from . import block, chain, clearance, ratchet

CASES: dict[str, Case] = {module.CASE.name: module.CASE for module in (ratchet, block, clearance, chain)}
