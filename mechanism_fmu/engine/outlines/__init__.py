"""Outlines of segments and arcs: their features, how far they are apart, and what touches."""
