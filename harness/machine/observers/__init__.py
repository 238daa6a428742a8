"""Observers of a machine's run: energies of couplings, impacts, recorded signals, statistics."""
