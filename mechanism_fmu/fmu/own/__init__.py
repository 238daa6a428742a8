"""A mechanism in a file of the user's own: found, loaded, examined, and explained where it cannot be built.

Internal: it serves the commands `build` and `new`.
"""

__all__: list[str] = []
