"""Erdman, Sandor and Oakberg: linkages that bend, equation by equation."""
