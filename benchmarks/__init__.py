"""Side-by-side timings, and the plain reference implementation that they are measured against."""
