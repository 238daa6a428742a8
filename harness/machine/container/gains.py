"""The FMU of gains and offsets, linked for all platforms."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

import fmpy

from mechanism_fmu.fmu.model_description import to_bytes
from mechanism_fmu.fmu.native.link import INSTALL, has_linker, link
from mechanism_fmu.fmu.native.targets import TARGETS
from mechanism_fmu.fmu.native.universal import universal
from mechanism_fmu.fmu.temporary import temporary_folder

from ...errors import UsageError

NAME, GUID = "Gains", "{mechanism_fmu gains 1}"

#: As in gains.c.
CHANNELS = 256
_IN, _OUT, _FACTOR, _OFFSET = range(4)

_SOURCE = Path(__file__).with_name("gains.c")
_STANDARD = Path(fmpy.__file__).with_name("c-code")


def in_reference(channel: int) -> int:
    """Value reference of a channel's input."""
    return 4 * channel + _IN


def out_reference(channel: int) -> int:
    """Value reference of a channel's output."""
    return 4 * channel + _OUT


def factor_reference(channel: int) -> int:
    """Value reference of a channel's factor."""
    return 4 * channel + _FACTOR


def offset_reference(channel: int) -> int:
    """Value reference of a channel's offset."""
    return 4 * channel + _OFFSET


def gains_entries(channels: int) -> dict[str, bytes]:
    """The files of the FMU, by name.

    Raises:
        UsageError: there is no linker.
    """
    if not has_linker():
        raise UsageError(
            "A container with gains, offsets or conversions of units needs the linker of the package ziglang, which is "
            f"not installed. Install it: {INSTALL}"
        )
    return {**_binaries(), "modelDescription.xml": to_bytes(_description(channels))}


@cache
def _binaries() -> dict[str, bytes]:
    """The libraries, by name."""
    libraries: dict[str, list[bytes]] = {}
    with temporary_folder() as temporary:
        for target in TARGETS:
            place = temporary / target.name
            place.mkdir()
            library = place / f"{NAME}{target.suffix}"
            link(target, [_SOURCE], [_STANDARD], library)
            libraries.setdefault(f"binaries/{target.fmi2}/{library.name}", []).append(library.read_bytes())
    return {name: found[0] if len(found) == 1 else universal(found) for name, found in libraries.items()}


def _description(channels: int) -> Element:
    root = Element("fmiModelDescription", fmiVersion="2.0", modelName=NAME, guid=GUID)
    root.set("description", "Outputs that are factor * input + offset at every instant")
    SubElement(root, "CoSimulation", modelIdentifier=NAME, canHandleVariableCommunicationStepSize="true")
    variables = SubElement(root, "ModelVariables")
    structure = SubElement(root, "ModelStructure")
    outputs, unknowns = SubElement(structure, "Outputs"), SubElement(structure, "InitialUnknowns")
    for channel in range(channels):
        for name, reference, causality, start in (
            (f"in[{channel + 1}]", in_reference(channel), "input", "0"),
            (f"out[{channel + 1}]", out_reference(channel), "output", None),
            (f"factor[{channel + 1}]", factor_reference(channel), "parameter", "1"),
            (f"offset[{channel + 1}]", offset_reference(channel), "parameter", "0"),
        ):
            variability = "fixed" if causality == "parameter" else "continuous"
            variable = SubElement(variables, "ScalarVariable", name=name, valueReference=str(reference))
            variable.attrib.update(causality=causality, variability=variability)
            SubElement(variable, "Real", {} if start is None else {"start": start})
        index = 4 * channel
        SubElement(outputs, "Unknown", index=str(index + 2), dependencies=f"{index + 1} {index + 3} {index + 4}")
        SubElement(unknowns, "Unknown", index=str(index + 2), dependencies=f"{index + 1} {index + 3} {index + 4}")
    return root
