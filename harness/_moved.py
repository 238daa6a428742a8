"""Former names of public modules: they work for one version more, and warn.

What is imported by its old name is the module of the new name, never a second one.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType

_HARNESS = __name__.rpartition(".")[0]
#: Old and new names, below the package; None for a package that is no more.
MOVED = {
    "cli": "app.cli",
    "clock": "run.master",
    "experiment": "run.experiment",
    "machine.algorithms": None,
    "machine.algorithms.adaptive": "machine.stepping",
    "machine.algorithms.base": "machine.stepping",
    "machine.algorithms.event_aware": "machine.stepping",
    "machine.algorithms.gauss_seidel": "machine.stepping",
    "machine.algorithms.jacobi": "machine.stepping",
    "machine.component": "fmu.interface",
    "machine.extrapolation": "machine.part",
    "machine.remote": "fmu.remote",
    "machine.run": "machine.running",
    "master": "run.master",
    "observers": "run.master",
    "recorder": "run.master",
    "results": "run.results",
    "slave": "fmu.interface",
}


class Moved(MetaPathFinder, Loader):
    """Finds modules by their former names."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """What is asked for, if it has moved."""
        package, _, name = fullname.partition(".")
        if package != _HARNESS.partition(".")[0] or not fullname.startswith(f"{_HARNESS}."):
            return None
        name = fullname.removeprefix(f"{_HARNESS}.")
        return ModuleSpec(fullname, self, is_package=MOVED[name] is None) if name in MOVED else None

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        """An empty module, for the time being."""
        return None

    def exec_module(self, module: ModuleType) -> None:
        """Put the moved module in the place of the empty one, with a warning."""
        new = MOVED[module.__name__.removeprefix(f"{_HARNESS}.")]
        if new is None:
            return
        warnings.warn(
            f"{module.__name__} is now {_HARNESS}.{new}; the former name goes with the next version.",
            DeprecationWarning,
            stacklevel=2,
        )
        sys.modules[module.__name__] = import_module(f"{_HARNESS}.{new}")


def install() -> None:
    """Find modules by their former names, too."""
    if not any(isinstance(finder, Moved) for finder in sys.meta_path):
        sys.meta_path.insert(0, Moved())
