"""Real and fake parts of a machine have all that its interfaces ask for."""

import inspect

import pytest
from fake_slave import FakeSlave

from harness.analysis.impacts import ImpactCollector
from harness.app.terminal import RunDisplay
from harness.fmu.instances.fmi2 import Fmi2Slave
from harness.fmu.instances.fmi3 import Fmi3Slave
from harness.fmu.instances.reals import ElementReals, RawReals
from harness.fmu.interface import Component, Reals, Slave
from harness.fmu.remote.near_side import RemoteComponent, RemoteReals
from harness.machine.observers import record
from harness.machine.observers.bonds import Bonds
from harness.machine.observers.component_impacts import Impacts
from harness.machine.observers.watched import Watched
from harness.run.logic import EventCollector
from harness.run.master import Observer, Recorder
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
