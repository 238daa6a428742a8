import os
from pathlib import Path

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


@pytest.fixture(scope="session")
def ratchet_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built Ratchet.fmu."""
    return build_fmu(models.load("ratchet"), tmp_path_factory.mktemp("fmu"))


@pytest.fixture(scope="session")
def geneva_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built Geneva.fmu."""
    return build_fmu(models.load("geneva"), tmp_path_factory.mktemp("fmu"))


@pytest.fixture(scope="session")
def slider_crank_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built SliderCrank.fmu."""
    return build_fmu(models.load("slider_crank"), tmp_path_factory.mktemp("fmu"))


@pytest.fixture(scope="session")
def four_bar_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built FourBar.fmu."""
    return build_fmu(models.load("four_bar"), tmp_path_factory.mktemp("fmu"))


@pytest.fixture(scope="session")
def gear_train_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built GearTrain.fmu."""
    return build_fmu(models.load("gear_train"), tmp_path_factory.mktemp("fmu"))


@pytest.fixture(scope="session")
def cam_drive_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built CamDrive.fmu."""
    return build_fmu(models.load("cam_drive"), tmp_path_factory.mktemp("fmu"))


@pytest.fixture(scope="session")
def native_ratchet_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built native Ratchet.fmu."""
    return build_native_fmu(models.load("ratchet"), tmp_path_factory.mktemp("native"))


@pytest.fixture(scope="session")
def native_geneva_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built native Geneva.fmu."""
    return build_native_fmu(models.load("geneva"), tmp_path_factory.mktemp("native"))


@pytest.fixture(scope="session")
def native_slider_crank_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built native SliderCrank.fmu."""
    return build_native_fmu(models.load("slider_crank"), tmp_path_factory.mktemp("native"))


@pytest.fixture(scope="session")
def native_four_bar_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built native FourBar.fmu."""
    return build_native_fmu(models.load("four_bar"), tmp_path_factory.mktemp("native"))


@pytest.fixture(scope="session")
def native_gear_train_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built native GearTrain.fmu."""
    return build_native_fmu(models.load("gear_train"), tmp_path_factory.mktemp("native"))


@pytest.fixture(scope="session")
def native_cam_drive_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of a freshly built native CamDrive.fmu."""
    return build_native_fmu(models.load("cam_drive"), tmp_path_factory.mktemp("native"))
