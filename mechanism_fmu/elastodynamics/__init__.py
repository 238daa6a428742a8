"""Kineto-elastodynamics: a linkage whose links bend."""
