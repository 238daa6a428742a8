"""A mechanism as a structure: its elements, what of them is unknown, compatibility, flexibility, masses."""
