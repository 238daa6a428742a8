"""From the start guess to a mechanism that is assembled and ready to begin."""
