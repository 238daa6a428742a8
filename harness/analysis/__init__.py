"""Post-processing of a run: its impacts, stress and fatigue damage that they leave, and compliance of links."""
