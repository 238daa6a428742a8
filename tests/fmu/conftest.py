from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.fmu.conformance.host import Fmu, Instance


@pytest.fixture(scope="session")
def ratchet(ratchet_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The ratchet's FMU, unzipped."""
    return Fmu.unzip(ratchet_fmu, tmp_path_factory.mktemp("ratchet"))


@pytest.fixture(scope="session")
def geneva(geneva_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The Geneva drive's FMU, unzipped."""
    return Fmu.unzip(geneva_fmu, tmp_path_factory.mktemp("geneva"))


@pytest.fixture(scope="session")
def native_ratchet(native_ratchet_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The native ratchet's FMU, unzipped."""
    return Fmu.unzip(native_ratchet_fmu, tmp_path_factory.mktemp("native_ratchet"))


@pytest.fixture(scope="session")
def native_geneva(native_geneva_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The native Geneva drive's FMU, unzipped."""
    return Fmu.unzip(native_geneva_fmu, tmp_path_factory.mktemp("native_geneva"))


@pytest.fixture(scope="session")
def slider_crank(slider_crank_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The slider-crank's FMU, unzipped."""
    return Fmu.unzip(slider_crank_fmu, tmp_path_factory.mktemp("slider_crank"))


@pytest.fixture(scope="session")
def four_bar(four_bar_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The four-bar linkage's FMU, unzipped."""
    return Fmu.unzip(four_bar_fmu, tmp_path_factory.mktemp("four_bar"))


@pytest.fixture(scope="session")
def native_slider_crank(native_slider_crank_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The native slider-crank's FMU, unzipped."""
    return Fmu.unzip(native_slider_crank_fmu, tmp_path_factory.mktemp("native_slider_crank"))


@pytest.fixture(scope="session")
def native_four_bar(native_four_bar_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The native four-bar linkage's FMU, unzipped."""
    return Fmu.unzip(native_four_bar_fmu, tmp_path_factory.mktemp("native_four_bar"))


@pytest.fixture(scope="session")
def gear_train(gear_train_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The gear train's FMU, unzipped."""
    return Fmu.unzip(gear_train_fmu, tmp_path_factory.mktemp("gear_train"))


@pytest.fixture(scope="session")
def cam_drive(cam_drive_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The cam drive's FMU, unzipped."""
    return Fmu.unzip(cam_drive_fmu, tmp_path_factory.mktemp("cam_drive"))


@pytest.fixture(scope="session")
def native_gear_train(native_gear_train_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The native gear train's FMU, unzipped."""
    return Fmu.unzip(native_gear_train_fmu, tmp_path_factory.mktemp("native_gear_train"))


@pytest.fixture(scope="session")
def native_cam_drive(native_cam_drive_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    """The native cam drive's FMU, unzipped."""
    return Fmu.unzip(native_cam_drive_fmu, tmp_path_factory.mktemp("native_cam_drive"))


@pytest.fixture
def instance(ratchet: Fmu) -> Iterator[Callable[..., Instance]]:
    """A function that makes instances of the ratchet; they are freed after the test."""
    with ExitStack() as stack:
        yield lambda *args, **kwargs: stack.enter_context(Instance(ratchet, *args, **kwargs))
