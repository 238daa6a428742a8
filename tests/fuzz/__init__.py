"""Random calls and forged data, deterministic: a short form with the other tests, a long one by one command."""
