"""Libraries of FMUs loaded by fmpy: the signatures of its functions are read once, and not for each instance."""

from __future__ import annotations

from typing import Any, ClassVar

from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave


class _KnownSignatures:
    """What stands before a class of fmpy, which reads them anew each time: 2 ms, most of a short run."""

    #: Names and types of the arguments and type of the result of each function; None before the first instance.
    _signatures: ClassVar[dict[str, tuple[Any, Any, Any]] | None]
    _functions: dict[str, Any]
    dll: Any

    def _loadFunctions(self) -> None:  # noqa: N802 - fmpy's name
        """Find the functions in the library; one that is missing is an error, as in fmpy."""
        kind = type(self)
        if kind._signatures is None:
            super()._loadFunctions()  # type: ignore[misc]
            kind._signatures = {name: (f.argnames, f.argtypes, f.restype) for name, f in self._functions.items()}
            return
        for name, (names, types, result) in kind._signatures.items():
            function = getattr(self.dll, name)
            function.argnames, function.argtypes, function.restype = names, types, result
            self._functions[name] = function


# fmpy knows the version of FMI by the beginning of the name.


class FMU2SlaveLoaded(_KnownSignatures, FMU2Slave):  # type: ignore[misc]
    """A co-simulation FMU of FMI 2.0."""

    _signatures = None


class FMU3SlaveLoaded(_KnownSignatures, FMU3Slave):  # type: ignore[misc]
    """A co-simulation FMU of FMI 3.0."""

    _signatures = None


class FMU2ModelLoaded(_KnownSignatures, FMU2Model):  # type: ignore[misc]
    """A Model Exchange FMU of FMI 2.0."""

    _signatures = None


class FMU3ModelLoaded(_KnownSignatures, FMU3Model):  # type: ignore[misc]
    """A Model Exchange FMU of FMI 3.0."""

    _signatures = None
