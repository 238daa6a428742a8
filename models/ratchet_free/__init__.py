"""The ratchet with teeth that end: a pawl with a round nose on an outline of the wheel."""
