"""The three documents, row by row: what they say, what this project finds, and whether the two agree.

Internal, for the command `reproduce` (docs/decisions/024-papers-reproduced.md).
"""

__all__: list[str] = []
