"""What travels in an FMU of every flavour: variables, descriptions, documentation, drawing, logic."""
