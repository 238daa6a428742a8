"""An instance of the pythonfmu flavour: FMI calls on one side, a `MovingMechanism` on the other."""
