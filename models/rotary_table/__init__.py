"""A rotary table with a friction brake, turned through a compliant shaft."""
