"""Implementation of the commands; each returns its exit code."""
