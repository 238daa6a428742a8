"""FMU files that are damaged or made to harm, each by one change of a sound one; no library is ever loaded."""

from __future__ import annotations

import stat
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Sound" guid="{1}">
  <CoSimulation modelIdentifier="Sound" canHandleVariableCommunicationStepSize="true"/>
  <UnitDefinitions><Unit name="K"><BaseUnit K="1"/><DisplayUnit name="degC" factor="1" offset="-273.15"/></Unit>
  </UnitDefinitions>
  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.1"/>
  <ModelVariables>
    <ScalarVariable name="y" valueReference="0" causality="output"><Real unit="K"/></ScalarVariable>
    <ScalarVariable name="p" valueReference="1" causality="parameter" variability="fixed">
      <Real start="2" min="0" max="9" nominal="3"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure><Outputs><Unknown index="1"/></Outputs></ModelStructure>
</fmiModelDescription>
"""
LIBRARIES = ("linux64/Sound.so", "win64/Sound.dll", "darwin64/Sound.dylib")


def sound(path: Path, description: str = DESCRIPTION) -> Path:
    """An FMU whose file is sound; its libraries are none."""
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", description)
        for library in LIBRARIES:
            archive.writestr(f"binaries/{library}", "no library")
    return path


def with_entry(name: str, kind: int = stat.S_IFREG) -> Callable[[Path], Path]:
    def make(path: Path) -> Path:
        with zipfile.ZipFile(sound(path), "a") as archive:
            info = zipfile.ZipInfo(name)
            info.external_attr = (kind | 0o644) << 16
            archive.writestr(info, "outside")
        return path

    return make


def described(before: str, after: str) -> Callable[[Path], Path]:
    """With another description."""
    assert DESCRIPTION.count(before) >= 1
    return lambda path: sound(path, DESCRIPTION.replace(before, after, 1))


def with_bytes(before: bytes, after: bytes) -> Callable[[Path], Path]:
    def make(path: Path) -> Path:
        data = sound(path).read_bytes()
        assert before in data
        path.write_bytes(data.replace(before, after, 1))
        return path

    return make


def cut(share: float) -> Callable[[Path], Path]:
    def make(path: Path) -> Path:
        data = sound(path).read_bytes()
        path.write_bytes(data[: int(len(data) * share)])
        return path

    return make


def without_description(path: Path) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("resources/a.txt", "")
    return path


class Damage(NamedTuple):
    """What is done to a file, and what the message must say."""

    make: Callable[[Path], Path]
    says: str


_START = '<Real start="2" min="0" max="9" nominal="3"/>'

DAMAGES = {
    "traversal": Damage(with_entry("../../out.txt"), "its entry '../../out.txt' leads out of its folder"),
    "absolute": Damage(with_entry("/tmp/out.txt"), "has an absolute path"),
    "backslash": Damage(with_entry("..\\out.txt"), "backslash"),
    "symbolic link": Damage(with_entry("resources/link", stat.S_IFLNK), "'resources/link' is a symbolic link"),
    "over-long name": Damage(with_entry("resources/" + "a" * 300), "is too long"),
    "file and folder": Damage(with_entry("modelDescription.xml/a"), "is a file and a folder at once"),
    "checksum": Damage(with_bytes(b"no library", b"NO library"), "Bad CRC-32 for file 'binaries/linux64/Sound.so'"),
    "checksum of the description": Damage(with_bytes(b"2.0", b"3.0"), "Bad CRC-32"),
    "cut off": Damage(cut(0.5), "not a zip file"),
    "empty": Damage(cut(0.0), "not a zip file"),
    "no description": Damage(without_description, "There is no item named 'modelDescription.xml'"),
    "no XML": Damage(described("<fmiModelDescription", "fmiModelDescription"), "Start tag expected"),
    "deep XML": Damage(described("<UnitDefinitions>", "<a>" * 100_000 + "<UnitDefinitions>"), "depth"),
    "no version": Damage(described('fmiVersion="2.0"', ""), "cannot be read as an FMU"),
    "no variables": Damage(
        lambda path: sound(path, DESCRIPTION.replace("ModelVariables", "Variables")), "cannot be read as an FMU"
    ),
    "step size": Damage(described('stepSize="0.1"', 'stepSize="abc"'), "stepSize of its DefaultExperiment is 'abc'"),
    "stop time": Damage(described('stopTime="1"', 'stopTime="nan"'), "stopTime of its DefaultExperiment is 'nan'"),
    "reference beyond 32 bits": Damage(
        described('valueReference="0"', 'valueReference="4294967296"'), "the valueReference of y is 4294967296"
    ),
    "negative reference": Damage(
        described('valueReference="0"', 'valueReference="-1"'), "must be from 0 to 4294967295"
    ),
    "reference without a number": Damage(described('valueReference="0"', 'valueReference="y"'), "'y'"),
    "unknown output": Damage(described('index="1"', 'index="99"'), "out of range"),
    "start": Damage(described(_START, '<Real start="two"/>'), "the start value of p is 'two', which is no Real"),
    "whole start": Damage(described(_START, '<Integer start="2.5"/>'), "is '2.5', which is no Integer"),
    "logical start": Damage(described(_START, '<Boolean start="maybe"/>'), "is 'maybe', which is no Boolean"),
    "minimum": Damage(described('min="0"', 'min="low"'), "min of p is 'low'"),
    "nominal": Damage(described('nominal="3"', 'nominal="nan"'), "nominal of p is 'nan'"),
    "unit of nothing": Damage(described('factor="1"', 'factor="0"'), "the unit K has a factor of 0"),
    "unit without a number": Damage(described('factor="1"', 'factor="one"'), "'one'"),
    "exponent": Damage(described('K="1"', 'K="one"'), "'one'"),
    "library elsewhere": Damage(
        described('modelIdentifier="Sound"', 'modelIdentifier="../../Sound"'), "modelIdentifier is '../../Sound'"
    ),
}
