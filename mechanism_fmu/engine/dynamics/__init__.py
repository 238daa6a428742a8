"""Equations of motion: accelerations and multipliers from forces and rows, eqs (2) and (3), by minimum norm."""
