"""The native flavour: the engine compiled ahead of time, and an FMI surface in C around it."""
