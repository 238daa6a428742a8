"""From forces and rows to accelerations and multipliers: eqs (2) and (3), by a minimum-norm solve."""
