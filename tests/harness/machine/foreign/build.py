"""FMUs that are not this project's: by pythonfmu, pythonfmu3, fmpy's container and a C compiler."""

import subprocess
import sys
import zipfile
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, tostring

import fmpy
from attrs import evolve
from fmpy.container_fmu import Configuration
from fmpy.container_fmu.cli import create_container_fmu
from fmpy.container_fmu.config import Component, Connection
from fmpy.model_description import CoSimulation, DefaultExperiment, ModelDescription, ModelVariable, Unknown

from tests.harness.machine.foreign.in_c import compiled

HERE = Path(__file__).parent


def by_pythonfmu(source: str, folder: Path) -> Path:
    """FMI 2.0."""
    return _python("pythonfmu", source, folder)


def by_pythonfmu3(source: str, folder: Path) -> Path:
    """FMI 3.0."""
    return _python("pythonfmu3", source, folder)


def _python(package: str, source: str, folder: Path) -> Path:
    command = [sys.executable, "-m", package, "build", "-f", str(HERE / source), "-d", str(folder), "--handle-state"]
    subprocess.run(command, check=True, capture_output=True)
    return folder / f"{Path(source).stem.capitalize()}.fmu"


def ball(folder: Path) -> Path:
    """FMI 3.0, from `ball.c`."""
    library = compiled(HERE / "ball.c", folder)
    path = folder / "Ball.fmu"
    with zipfile.ZipFile(path, "w") as fmu:
        fmu.writestr("modelDescription.xml", tostring(_ball_description()))
        fmu.write(library, f"binaries/{fmpy.platform_tuple}/{library.name}")
    return path


def _ball_description() -> Element:
    root = Element("fmiModelDescription", fmiVersion="3.0", modelName="Ball", instantiationToken="ball")
    flags = (
        "canGetAndSetFMUState",
        "canHandleVariableCommunicationStepSize",
        "mightReturnEarlyFromDoStep",
        "hasEventMode",
    )
    SubElement(root, "CoSimulation", {"modelIdentifier": "ball"} | dict.fromkeys(flags, "true"))
    SubElement(root, "DefaultExperiment", stopTime="1", stepSize="0.01")
    variables = SubElement(root, "ModelVariables")
    for reference, (kind, name, causality, start) in enumerate(
        [
            ("Float64", "height", "output", ""),
            ("Float64", "speed", "output", ""),
            ("Float64", "restitution", "parameter", "0.5"),
            ("Int32", "bounces", "output", ""),
            ("Int32", "kicks", "input", "0"),
        ]
    ):
        one = SubElement(variables, kind, name=name, valueReference=str(reference), causality=causality)
        if start:
            one.set("start", start)
    SubElement(variables, "Float64", name="time", valueReference="5", causality="independent", variability="continuous")
    structure = SubElement(root, "ModelStructure")
    for element in ("Output", "InitialUnknown"):
        for reference in ("0", "1", "3"):
            SubElement(structure, element, valueReference=reference)
    return root


def oscillator(mass: Path, folder: Path) -> Path:
    """A container of two masses, of FMI 2.0: the place of one is the force on the other."""
    parts = [Component(name, mass, fmpy.read_model_description(str(mass))) for name in ("one", "two")]
    known = [{v.name: v for v in part.modelDescription.modelVariables} for part in parts]
    outputs = [ModelVariable(name=f"{part.name}_x", type="Real", causality="output") for part in parts]
    for variable in outputs:
        variable.variability, variable.initial = "continuous", "calculated"
    force = ModelVariable(name="force", type="Real", causality="input", start="0", variability="continuous")
    time = ModelVariable(name="time", type="Real", causality="independent", variability="continuous")
    description = ModelDescription(
        fmiVersion="2.0",
        modelName="Oscillator",
        instantiationToken="{container}",
        coSimulation=CoSimulation(modelIdentifier="container_fmu", fixedInternalStepSize=0.01),
        defaultExperiment=DefaultExperiment(stopTime="1", stepSize="0.01"),
        modelVariables=[time, *outputs, force],  # the container counts its own variables from 1
        outputs=[Unknown(variable=v) for v in outputs],
        initialUnknowns=[Unknown(variable=v) for v in outputs],
    )
    mappings = {variable: [(part, own["x"])] for variable, part, own in zip(outputs, parts, known, strict=True)}
    mappings[force] = [(parts[0], known[0]["force"])]
    # The container reads the types of FMI 3.0 only.
    place, push = (evolve(variable, type="Float64") for variable in (known[0]["x"], known[1]["force"]))
    connections = [Connection(parts[0], [place], parts[1], [push])]
    unpacked = folder / "container"
    unpacked.mkdir()
    path = folder / "Oscillator.fmu"
    create_container_fmu(Configuration(False, description, parts, connections, mappings), unpacked, path)
    return path
