"""Whether two revisions of this project calculate the same, to the bit."""
