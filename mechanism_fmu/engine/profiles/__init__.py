"""Curves, and the geometry of two cam profiles: where they are nearest, how far apart (docs/decisions/009)."""
