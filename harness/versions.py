"""What made a result: the versions that another one needs to be the same."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from mechanism_fmu import __version__

from .description import Description

#: Packages that numbers, tables and pictures come from: the engine and the FMU, stresses, designs, files, charts.
_PACKAGES = (
    *("numpy", "numba", "llvmlite", "pythonfmu", "fmpy"),
    *("scipy", "rainflow", "optuna", "distributed", "dask"),
    *("pandas", "pyarrow", "plotly", "pillow"),
)


def versions(fmu: Path, description: Description) -> dict[str, str]:
    """What made a result, by name: the FMU, this harness, Python and the packages used."""
    return {
        "FMU": fmu.name,
        "model": description.model,
        "GUID of the FMU": description.guid,
        "generation tool of the FMU": description.generation_tool or "unknown",
        **software(),
    }


def software() -> dict[str, str]:
    """The versions of this harness, of Python and of the packages used, by name."""
    return {
        "mechanism_fmu": __version__,
        "Python": f"{platform.python_version()}, {platform.system()} {platform.machine()}",
        **{name: found for name in _PACKAGES if (found := _installed(name))},
    }


def _installed(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""
