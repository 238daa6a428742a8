"""Model Exchange: what the importer's own integrator asks for, and the events that it has located."""
