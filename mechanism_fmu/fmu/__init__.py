"""The plug: ports, modelDescription.xml, the slave, and what travels in an FMU.

For users: `package.build_fmu` (FMI 2.0, by pythonfmu) and `native.package.build_native_fmu` (FMI 2.0 or 3.0, without
Python). They are not imported here, because this file travels in every FMU, and what builds FMUs does not.
"""

__all__ = ["native", "package"]
