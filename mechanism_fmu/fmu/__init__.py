"""FMI adapter: ports, modelDescription.xml, the slave, and what travels in an FMU.

For users: `package.build_fmu` (FMI 2.0, by pythonfmu) and `native.package.build_native_fmu` (FMI 2.0 or 3.0, without
Python). They are not imported here, because this file travels in every FMU, and what builds FMUs does not.

`instance`: what runs in an FMU of the pythonfmu flavour (`start` comes first); `parts`: what travels in every flavour;
`native`: the flavour without Python; `own`: a mechanism in a file of the user's own; `disk`: archives, cache, folders.
"""

__all__ = ["native", "package"]
