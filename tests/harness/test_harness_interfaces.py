"""Real and fake parts of a machine have all that its interfaces ask for."""

import inspect

import pytest
from fake_slave import FakeSlave

from harness.coupling import Coupling
from harness.events import EventCollector
from harness.fmu import FmuSlave
from harness.impacts import ImpactCollector
from harness.observers import Observer
from harness.recorder import Recorder
from harness.slave import Slave
from harness.terminal import RunDisplay
from tests.harness.test_harness_coupling import Mass

UNITS = (FmuSlave, Coupling, FakeSlave, Mass)
OBSERVERS = (Recorder, ImpactCollector, EventCollector, RunDisplay)
CLAIMS = [*((Slave, unit) for unit in UNITS), *((Observer, observer) for observer in OBSERVERS)]


def calls(interface: type) -> dict[str, list[str]]:
    """Names of the arguments of each method."""
    methods = inspect.getmembers(interface, inspect.isfunction)
    return {name: list(inspect.signature(method).parameters) for name, method in methods if name[0] != "_"}


@pytest.mark.parametrize(("interface", "part"), CLAIMS, ids=lambda part: part.__name__)
def test_a_part_has_every_method_of_its_interface(interface: type, part: type) -> None:
    asked, has = calls(interface), calls(part)
    assert asked
    assert {name: has.get(name) for name in asked} == asked
