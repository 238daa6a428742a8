"""A direct-current motor with a PI controller of its speed, whose voltage is limited."""
