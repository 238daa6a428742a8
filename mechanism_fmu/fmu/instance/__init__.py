"""An instance of the pythonfmu flavour: FMI calls on one side, a `Simulation` on the other."""
