"""What a run means: its impacts, the stress and the damage that they leave, and how far parts give way."""
