"""Machines for other tools, and from them: SSP 1.0, containers, and FMUs with numbers baked in."""
