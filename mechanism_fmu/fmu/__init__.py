"""The plug: ports, modelDescription.xml, the slave, and what travels in an FMU."""
