"""Pennestrì, Valentini, Vita: the ratchet and its tooth, section by section."""
