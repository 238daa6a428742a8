"""What a run means: its impacts, stress and fatigue that they leave, compliance of links; and fits of impact laws."""
