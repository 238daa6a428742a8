"""Terminals: every shaft, valid XML, and torques whose sign is that of what acts on this FMU."""

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import pytest
from lxml import etree

import models
from mechanism_fmu.fmu.parts.resources import SHAFT, TERMINALS, shafts, terminals
from mechanism_fmu.fmu.parts.variables import variables_of
from mechanism_fmu.model import Body, CompliantShaft, Input, Mechanism, Model, Output, Torque
from mechanism_fmu.simulation import Simulation

SCHEMA = Path(fmpy.__file__).with_name("schema") / "fmi3" / "fmi3TerminalsAndIcons.xsd"
NAMES = list(models.available())


def mechanism_of(name):
    model = models.load(name).MODEL
    return model.build(model.values())


def test_the_ratchet_has_three():
    found = {shaft.name: (shaft.angle, shaft.speed, shaft.torque) for shaft in shafts(mechanism_of("ratchet"))}
    assert found == {
        "drive_shaft": ("drive_angle", "drive_speed", "drive_shaft_torque"),
        "crank_shaft": ("crank_angle", "crank_speed", "drive_torque"),
        "wheel_shaft": ("wheel_angle", "wheel_speed", "load_torque"),
    }


@pytest.mark.parametrize("name", NAMES)
def test_the_file_is_by_the_schema_and_names_variables(name):
    model = models.load(name).MODEL
    (contents,) = terminals(model, fmi=3).values()
    assert terminals(model, fmi=2) == {TERMINALS: contents.replace(b'fmiVersion="3.0"', b'fmiVersion="2.0"')}
    etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(etree.fromstring(contents))
    root = ElementTree.fromstring(contents)
    known = {variable.name: variable for variable in variables_of(model)}
    found = root.findall("Terminals/Terminal")
    assert len({terminal.get("name") for terminal in found}) == len(found) > 0
    for terminal in found:
        assert (terminal.get("matchingRule"), terminal.get("terminalKind")) == ("plug", SHAFT)
        members = {m.get("memberName"): m for m in terminal}
        assert {name: m.get("variableKind") for name, m in members.items()} == {
            "angle": "signal",
            "speed": "signal",
            "torque": "inflow",
        }
        causalities = {name: known[m.get("variableName")].causality for name, m in members.items()}
        units = {name: known[m.get("variableName")].unit for name, m in members.items()}
        assert units == {"angle": "rad", "speed": "rad/s", "torque": "N.m"}
        assert causalities["angle"] == causalities["speed"] != causalities["torque"]
        assert set(causalities.values()) == {"input", "output"}


@pytest.mark.parametrize("name", NAMES)
def test_a_positive_torque_acts_on_this_fmu_counter_clockwise(name):
    """What an input turns gets faster; what is turned ahead from outside is pushed ahead."""
    mechanism = mechanism_of(name)
    inputs = {port.name for port in mechanism.inputs}
    assert shafts(mechanism)
    for shaft in shafts(mechanism):
        gains = []
        for push in (1e-3, -1e-3):
            simulation = Simulation(mechanism)
            if shaft.torque in inputs:
                simulation.set_input(shaft.torque, push)
                simulation.advance(2e-3)
                gains.append(simulation.read()[shaft.speed])
            else:
                simulation.set_input(shaft.angle, simulation.inputs[mechanism_input(mechanism, shaft.angle)] + push)
                simulation.set_input(shaft.speed, simulation.inputs[mechanism_input(mechanism, shaft.speed)] + push)
                simulation.advance(1e-6)
                gains.append(simulation.read()[shaft.torque])
        stiff = any(isinstance(f, CompliantShaft) and (f.stiffness or f.damping) for f in mechanism.forces)
        if shaft.torque in inputs or not stiff:
            assert gains[0] >= gains[1]
        else:
            assert gains[0] > gains[1]


def mechanism_input(mechanism, name):
    return [port.name for port in mechanism.inputs].index(name)


def test_a_free_rotor_gets_faster_by_a_positive_torque():
    rotor = Mechanism(
        (Body("rotor", 1.0, 2.0),),
        forces=(Torque("load", "rotor"), Torque("drive", "rotor")),
        inputs=(
            Input("load_torque", "load.torque", 0.0, "", "N.m"),
            Input("drive_torque", "drive.torque", 0.0, "", "N.m"),
        ),
        outputs=(Output("angle", "rotor.angle", "", "rad"), Output("speed", "rotor.speed", "", "rad/s")),
    )
    assert [shaft.name for shaft in shafts(rotor)] == ["rotor_shaft", "rotor_drive_shaft"]
    simulation = Simulation(rotor)
    simulation.set_input("load_torque", 0.5)
    simulation.advance(1.0)
    assert simulation.read()["speed"] == pytest.approx(0.25, rel=1e-12)


def test_a_shaft_without_one_of_its_variables_is_none():
    rotor = Mechanism(
        (Body("rotor", 1.0, 2.0),),
        forces=(Torque("load", "rotor"), CompliantShaft("shaft", "rotor", stiffness=1.0)),
        inputs=(Input("load_torque", "load.torque", 0.0, "", "N.m"), Input("a_angle", "shaft.angle", 0.0, "", "rad")),
        outputs=(Output("angle", "rotor.angle", "", "rad"),),
    )
    assert shafts(rotor) == ()
    assert terminals(Model("Rotor", "", (), lambda _: rotor)) == {}
    with_speed = replace(rotor, outputs=(*rotor.outputs, Output("speed", "rotor.speed", "", "rad/s")))
    assert list(terminals(Model("Rotor", "", (), lambda _: with_speed))) == [TERMINALS]
