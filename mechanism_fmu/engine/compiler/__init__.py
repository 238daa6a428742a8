"""The part of Python that the engine is written in, and how it becomes machine code (docs/decisions/001)."""
