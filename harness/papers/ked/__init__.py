"""A linkage that bends over a turn of its crank: deviation, stresses, frequencies, critical speeds, input torque.

Internal, for the command `ked` (docs/decisions/023-ked.md).
"""

__all__: list[str] = []
