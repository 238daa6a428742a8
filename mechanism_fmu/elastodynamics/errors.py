"""What the room refuses."""

from __future__ import annotations


class LinkageError(ValueError):
    """The mechanism cannot be analysed as a structure; the message names the part, and says why and what to do."""
