"""FMUs by way of fmpy: extracted, instantiated, and always cleaned up.

- `extracted`: an FMU's file, and instances of it (`workspace`: the folders)
- `slave`: what instances have in common; `fmi2` and `fmi3`: what they have not; `event_mode`: that of FMI 3.0
- `binaries`: the libraries that an FMU has
- variables: `batches` (one call for each type), `raw_reals` (many numbers, often), `element_reals` (one by one)
"""

from .extracted import Fmu, open_fmu

__all__ = ["Fmu", "open_fmu"]
