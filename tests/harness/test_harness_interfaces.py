"""Real and fake parts of a machine have all that its interfaces ask for."""

import inspect

import pytest
from fake_slave import FakeSlave

from harness.events import EventCollector
from harness.fmu.element_reals import ElementReals
from harness.fmu.fmi2 import Fmi2Slave
from harness.fmu.fmi3 import Fmi3Slave
from harness.fmu.raw_reals import RawReals
from harness.impacts import ImpactCollector
from harness.machine import record
from harness.machine.bonds import Bonds
from harness.machine.component import Component, Reals
from harness.machine.impacts import Impacts
from harness.machine.remote.component import RemoteComponent
from harness.machine.remote.reals import RemoteReals
from harness.machine.watched import Watched
from harness.observers import Observer
from harness.recorder import Recorder
from harness.slave import Slave
from harness.terminal import RunDisplay
from tests.harness.machine.fakes import Wheel, WheelReals
from tests.harness.machine.mass import Mass, MassReals

UNITS = (Fmi2Slave, Fmi3Slave, FakeSlave)
COMPONENTS = (Fmi2Slave, Fmi3Slave, RemoteComponent, Watched, Wheel, Mass)
REALS = (RawReals, ElementReals, RemoteReals, WheelReals, MassReals)
OBSERVERS = (Recorder, ImpactCollector, EventCollector, RunDisplay, record.Recorder, Impacts, Bonds)
CLAIMS = [
    *((Slave, unit) for unit in UNITS),
    *((Component, component) for component in COMPONENTS),
    *((Reals, reals) for reals in REALS),
    *((Observer, observer) for observer in OBSERVERS),
]


def calls(interface: type) -> dict[str, list[str]]:
    """Names of the arguments of each method."""
    methods = inspect.getmembers(interface, inspect.isfunction)
    return {name: list(inspect.signature(method).parameters) for name, method in methods if name[0] != "_"}


@pytest.mark.parametrize(("interface", "part"), CLAIMS, ids=lambda part: part.__name__)
def test_a_part_has_every_method_of_its_interface(interface: type, part: type) -> None:
    asked, has = calls(interface), calls(part)
    assert asked
    assert {name: has.get(name) for name in asked} == asked
