import gc
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

import models
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from tests import compiled_engine, distribution
from tests.once import once

# How long an example takes says nothing while other tests run beside it.
# Half the usual number of examples: they are others in each run, and there are many runs.
settings.register_profile("untimed", deadline=None, max_examples=50)
settings.load_profile("untimed")

compiled_engine.use_it()

# Processes that run tests side by side leave each other a processor: a linear algebra of many threads, which wait for
# each other by spinning, takes ten times as long then.
os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", MKL_NUM_THREADS="1")

# What is printed is the same whatever terminal the tests have; a console reads these when it is made.
os.environ.update(COLUMNS="200", LINES="50")
for _name in ("FORCE_COLOR", "PY_COLORS", "GITHUB_ACTIONS", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
    os.environ.pop(_name, None)


def pytest_configure(config: pytest.Config) -> None:
    """Files keep the order that `distribution` gives them, however many tests they have."""
    config.option.loadscopereorder = False


def everything_on_several(config: pytest.Config) -> bool:
    """Whether this process hands out all tests to others."""
    everything = config.args_source is pytest.Config.ArgsSource.TESTPATHS
    return everything and not hasattr(config, "workerinput") and bool(config.getoption("numprocesses", None))


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node: Any) -> None:
    """Tell a process that gets tests whether these are all."""
    node.workerinput["everything"] = everything_on_several(node.config)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """How all tests are handed out."""
    by_file = everything_on_several(config) and config.getoption("dist") == "loadfile"
    return distribution.scheduler(config, log) if by_file else None


def one_of_several(config: pytest.Config) -> bool:
    """Whether this process gets some of all tests from another."""
    return bool(getattr(config, "workerinput", {}).get("everything"))


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """The order in which all tests are handed out."""
    if one_of_several(config):
        items[:] = distribution.ordered(items)


def pytest_collection_finish() -> None:
    """What has been collected stays: the search for garbage, which compilers cause often, need not see it."""
    gc.collect()
    gc.freeze()


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Wait for the compiled engine, unless this process has to compile just in time anyway."""
    if one_of_several(item.config):
        compiled_engine.wait_for_it(not distribution.compiles_just_in_time(item.nodeid))


@pytest.hookimpl(wrapper=True)
def pytest_runtestloop(session: pytest.Session) -> Iterator[object]:
    """Compile the engine of FMUs beside the first tests, when all tests run on several processors."""
    if not everything_on_several(session.config):
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
