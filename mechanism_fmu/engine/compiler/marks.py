"""Marks that functions of the engine set for the compiler; called, they do nothing."""

from __future__ import annotations


def keep_small() -> None:
    """Compile the calling function for size.

    The compiler would otherwise unroll loops over a handful of entries, which costs compilation time. Functions without
    this mark are those that each acceleration and each stage of a step call: there it gains a tenth of the time.
    """


def keep_apart() -> None:
    """Compile the calling function for size and never into its callers.

    For what runs once or twice a step and has few arguments: compiled into functions that are made for speed, its loops
    became copies for two and four entries at a time, which were kilobytes and gained nothing.
    """
