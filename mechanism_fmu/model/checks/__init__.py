"""Validation of a mechanism: its structure (`check`), and all of its numbers as findings (`check_numbers`)."""
