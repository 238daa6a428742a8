"""Who looks on while a machine runs: energies of couplings, impacts, chosen signals, statistics."""
