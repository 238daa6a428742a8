"""Graham's dead-beat escapement: an anchor with a pendulum on whose dead arcs a tooth rests without turning it."""
