"""Planar mechanisms with exact impacts, packaged as FMUs.

Rooms: `model` (what a mechanism is), `engine` (how it moves), `fmu` (the plug), `stress` (what an impact means).
The machine around an FMU lives in the package `harness`, ready-made mechanisms in `models`.
"""

__version__ = "0.1.0"
