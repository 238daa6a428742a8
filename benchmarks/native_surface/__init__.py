"""The native FMU against the bare engine, from C: what the FMI surface costs."""
