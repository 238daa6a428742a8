from collections.abc import Callable, Iterator
from contextlib import ExitStack

import pytest

import models
from tests.fmu.conformance.host import Fmu, Instance


def _unzipped(name: str) -> object:
    """A session fixture: a model's FMU, unzipped."""

    @pytest.fixture(scope="session")
    def fmu(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
        return Fmu.unzip(request.getfixturevalue(f"{name}_fmu"), tmp_path_factory.mktemp(name))

    return fmu


# Of each model two fixtures: ratchet, native_ratchet, geneva, ...
for _model in models.available():
    globals()[_model] = _unzipped(_model)
    globals()[f"native_{_model}"] = _unzipped(f"native_{_model}")


@pytest.fixture
def instance(ratchet: Fmu) -> Iterator[Callable[..., Instance]]:
    """A function that makes instances of the ratchet; they are freed after the test."""
    with ExitStack() as stack:
        yield lambda *args, **kwargs: stack.enter_context(Instance(ratchet, *args, **kwargs))
