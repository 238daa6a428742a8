"""Gaps and logical functions, impacts by eq (7), which contacts push, and what happens at an event."""
