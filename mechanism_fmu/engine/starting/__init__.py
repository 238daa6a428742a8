"""Assembly and initialization: from the start guess to a mechanism that is ready to begin."""
