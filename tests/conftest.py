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
from tests.once import once

# How long an example takes says nothing while other tests run beside it.
settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")

# What is printed is the same whatever terminal the tests have; a console reads these when it is made.
os.environ.update(COLUMNS="200", LINES="50")
for _name in ("FORCE_COLOR", "PY_COLORS", "GITHUB_ACTIONS", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
    os.environ.pop(_name, None)


#: Builds an FMU of a ready-made model, by the model's name; one process does it for all.
Built = Callable[..., Path]


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
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    """A function that builds an FMU of a ready-made model once for all processes of this run."""

    def build(model: str, by: Callable[..., Path] = build_fmu, **how: int) -> Path:
        name = "_".join([by.__name__, model, *(f"{key}{value}" for key, value in how.items())])
        folder = once(tmp_path_factory, name, lambda folder: by(models.load(model), folder, **how))
        return next(folder.glob("*.fmu"))

    return build


@pytest.fixture(scope="session")
def ratchet_fmu(built: Built) -> Path:
    """Path of a freshly built Ratchet.fmu."""
    return built("ratchet")


@pytest.fixture(scope="session")
def geneva_fmu(built: Built) -> Path:
    """Path of a freshly built Geneva.fmu."""
    return built("geneva")


@pytest.fixture(scope="session")
def slider_crank_fmu(built: Built) -> Path:
    """Path of a freshly built SliderCrank.fmu."""
    return built("slider_crank")


@pytest.fixture(scope="session")
def four_bar_fmu(built: Built) -> Path:
    """Path of a freshly built FourBar.fmu."""
    return built("four_bar")


@pytest.fixture(scope="session")
def gear_train_fmu(built: Built) -> Path:
    """Path of a freshly built GearTrain.fmu."""
    return built("gear_train")


@pytest.fixture(scope="session")
def cam_drive_fmu(built: Built) -> Path:
    """Path of a freshly built CamDrive.fmu."""
    return built("cam_drive")


@pytest.fixture(scope="session")
def native_ratchet_fmu(built: Built) -> Path:
    """Path of a freshly built native Ratchet.fmu."""
    return built("ratchet", build_native_fmu)


@pytest.fixture(scope="session")
def native_geneva_fmu(built: Built) -> Path:
    """Path of a freshly built native Geneva.fmu."""
    return built("geneva", build_native_fmu)


@pytest.fixture(scope="session")
def native_slider_crank_fmu(built: Built) -> Path:
    """Path of a freshly built native SliderCrank.fmu."""
    return built("slider_crank", build_native_fmu)


@pytest.fixture(scope="session")
def native_four_bar_fmu(built: Built) -> Path:
    """Path of a freshly built native FourBar.fmu."""
    return built("four_bar", build_native_fmu)


@pytest.fixture(scope="session")
def native_gear_train_fmu(built: Built) -> Path:
    """Path of a freshly built native GearTrain.fmu."""
    return built("gear_train", build_native_fmu)


@pytest.fixture(scope="session")
def native_cam_drive_fmu(built: Built) -> Path:
    """Path of a freshly built native CamDrive.fmu."""
    return built("cam_drive", build_native_fmu)
