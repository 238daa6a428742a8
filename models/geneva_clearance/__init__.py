"""A Geneva drive with play: a pin in a wider slot, and a locking disc in a wider arc."""
