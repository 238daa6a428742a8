"""Planar mechanisms with exact impacts, packaged as FMUs.

Packages: `model` (what a mechanism is), `engine` (how it moves), `simulation` (both together, in Python), `kinematics`
(what is known without forces), `fmu` (the FMI adapter), `statechart` (modes and transitions as data), `stress` (what an
impact means), `slides` (the worked examples of the ME451 slides). The machine around an FMU lives in the package
`harness`, ready-made mechanisms in `models`. What of all this is for users: docs/reference/public-interface.md.
"""

#: Version of the library, which every FMU states as its own.
__version__ = "0.1.0"
