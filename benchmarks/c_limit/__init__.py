"""The engine's algorithm written by hand in C, for the guided ratchet: the limit of what compiling can reach."""
