"""The figures that the page shows, drawn anew."""
