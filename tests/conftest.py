import os
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import settings

import models
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu

# How long an example takes says nothing while other tests run beside it.
settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")

# What is printed is the same whatever terminal the tests have; a console reads these when it is made.
os.environ.update(COLUMNS="200", LINES="50")
for _name in ("FORCE_COLOR", "PY_COLORS", "GITHUB_ACTIONS", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
    os.environ.pop(_name, None)


def _built(name: str, folder: str, build: Callable[[ModuleType, Path], Path]) -> object:
    """A session fixture: the path of a model's freshly built FMU."""

    @pytest.fixture(scope="session")
    def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
        return build(models.load(name), tmp_path_factory.mktemp(folder))

    return path


# Of each model two fixtures: ratchet_fmu, native_ratchet_fmu, geneva_fmu, ...
for _model in models.available():
    globals()[f"{_model}_fmu"] = _built(_model, "fmu", build_fmu)
    globals()[f"native_{_model}_fmu"] = _built(_model, "native", build_native_fmu)
