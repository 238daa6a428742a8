"""Observers of a machine's run: energies of couplings, impacts, recorded signals, statistics."""

__all__ = ["bonds", "component_impacts", "record"]
