"""The command `mechanism-fmu`: its options (`cli` and those beside it), and what it does (`commands`)."""
