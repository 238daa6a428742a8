"""An instance's memory: what stands where in its block, and views of it by subject (docs/decisions/001)."""
