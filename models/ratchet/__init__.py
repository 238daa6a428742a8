"""The ratchet of Pennestrì, Valentini and Vita: a pawl on a crank indexes a toothed wheel."""
