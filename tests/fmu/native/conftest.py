from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from mechanism_fmu.fmu.native.package import build_native_fmu
from tests.fmu.native.host3 import Fmu3, Instance3


@pytest.fixture(scope="session")
def ratchet_fmi3(built: Callable[..., Path]) -> Path:
    """Path of a freshly built Ratchet.fmu of FMI 3.0."""
    return built("ratchet", build_native_fmu, fmi=3)


@pytest.fixture(scope="session")
def ratchet3(ratchet_fmi3: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu3:
    """The ratchet's FMU of FMI 3.0, unzipped."""
    return Fmu3.unzip(ratchet_fmi3, tmp_path_factory.mktemp("ratchet3"))


@pytest.fixture(scope="session")
def clocked_ratchet_fmi3(built: Callable[..., Path]) -> Path:
    """Path of a freshly built Ratchet.fmu of FMI 3.0 with a clock and arrays."""
    return built("ratchet", build_native_fmu, fmi=3, clocks=True)


@pytest.fixture(scope="session")
def clocked_ratchet3(clocked_ratchet_fmi3: Path, tmp_path_factory: pytest.TempPathFactory) -> Fmu3:
    """The ratchet's FMU of FMI 3.0 with a clock, unzipped."""
    return Fmu3.unzip(clocked_ratchet_fmi3, tmp_path_factory.mktemp("clocked_ratchet3"))


@pytest.fixture
def clocked3(clocked_ratchet3: Fmu3) -> Iterator[Callable[..., Instance3]]:
    """A function that makes instances of the ratchet with a clock; they are freed after the test."""
    with ExitStack() as stack:
        yield lambda **kwargs: stack.enter_context(Instance3(clocked_ratchet3, **kwargs))


@pytest.fixture
def instance3(ratchet3: Fmu3) -> Iterator[Callable[..., Instance3]]:
    """A function that makes instances of the ratchet; they are freed after the test."""
    with ExitStack() as stack:
        yield lambda **kwargs: stack.enter_context(Instance3(ratchet3, **kwargs))
