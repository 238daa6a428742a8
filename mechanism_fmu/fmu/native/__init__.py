"""FMUs that need no Python where they run."""
