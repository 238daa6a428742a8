import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import settings

import models
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from tests import compiled_engine
from tests.once import once

# How long an example takes says nothing while other tests run beside it.
# Half the usual number of examples: they are others in each run, and there are many runs.
settings.register_profile("untimed", deadline=None, max_examples=50)
settings.load_profile("untimed")

compiled_engine.use_it()

# What is printed is the same whatever terminal the tests have; a console reads these when it is made.
os.environ.update(COLUMNS="200", LINES="50")
for _name in ("FORCE_COLOR", "PY_COLORS", "GITHUB_ACTIONS", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
    os.environ.pop(_name, None)


def pytest_configure(config: pytest.Config) -> None:
    """Files keep the order of their folders: those of FMUs then come when the engine is compiled (see below)."""
    config.option.loadscopereorder = False


@pytest.hookimpl(wrapper=True)
def pytest_runtestloop(session: pytest.Session) -> Iterator[object]:
    """Compile the engine of FMUs beside the first tests, when all tests run on several processors."""
    config = session.config
    everything = config.args_source is pytest.Config.ArgsSource.TESTPATHS
    if hasattr(config, "workerinput") or not config.getoption("numprocesses", None) or not everything:
        return (yield)
    program = "from mechanism_fmu.fmu.native.objects import compiled_engine; compiled_engine()"
    with subprocess.Popen([sys.executable, "-c", program]) as process:
        try:
            return (yield)
        finally:
            process.terminate()


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """A function that builds an FMU of a ready-made model, by its name, once for all processes of this run."""

    def build(model: str, by: Callable[..., Path], **how: int) -> Path:
        name = "_".join([by.__name__, model, *(f"{key}{value}" for key, value in how.items())])
        folder = once(tmp_path_factory, name, lambda folder: by(models.load(model), folder, **how))
        return next(folder.glob("*.fmu"))

    return build


def _path(model: str, by: Callable[..., Path]) -> object:
    """A session fixture: the path of a model's freshly built FMU."""

    @pytest.fixture(scope="session")
    def path(built: Callable[..., Path]) -> Path:
        return built(model, by)

    return path


# Of each model two fixtures: ratchet_fmu, native_ratchet_fmu, geneva_fmu, ...
for _model in models.available():
    globals()[f"{_model}_fmu"] = _path(_model, build_fmu)
    globals()[f"native_{_model}_fmu"] = _path(_model, build_native_fmu)
