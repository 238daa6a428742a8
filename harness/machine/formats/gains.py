"""The FMU of gains and offsets, linked for all platforms."""

from __future__ import annotations

import uuid
from functools import cache
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

import fmpy

from mechanism_fmu.fmu.disk.archive import content_hash
from mechanism_fmu.fmu.disk.folders import temporary_folder
from mechanism_fmu.fmu.native.link import INSTALL, TARGETS, has_linker, link, universal
from mechanism_fmu.fmu.parts.model_description import to_bytes

from ...errors import UsageError

NAME = "Gains"

#: As in gains.c.
CHANNELS = 256
_IN, _OUT, _FACTOR, _OFFSET = range(4)

#: Factors and offsets.
Given = tuple[tuple[float, float], ...]

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


def guid(given: Given = ()) -> str:
    """The GUID of the FMU with these factors and offsets."""
    kind = "".join(f" {factor!r} {offset!r}" for factor, offset in given)
    return f"{{{uuid.UUID(content_hash({'gains.c': _SOURCE.read_bytes(), 'given': kind.encode()})[:32])}}}"


def gains_entries(channels: int, given: Given = ()) -> dict[str, bytes]:
    """The files of the FMU, by name.

    Args:
        channels: how many it shows.
        given: factors and offsets that the first of them have before anybody sets them; 1 and 0 of others.

    Raises:
        UsageError: there is no linker.
    """
    if not has_linker():
        raise UsageError(
            "Gains, offsets and conversions of units between FMUs of other tools need the linker of the package "
            f"ziglang, which is not installed. Install it: {INSTALL}"
        )
    return {**_binaries(given), "modelDescription.xml": to_bytes(_description(channels, given))}


@cache
def _binaries(given: Given) -> dict[str, bytes]:
    """The libraries, by name."""
    libraries: dict[str, list[bytes]] = {}
    with temporary_folder() as temporary:
        (temporary / "given.h").write_text(_header(given), encoding="ascii")
        for target in TARGETS:
            place = temporary / target.name
            place.mkdir()
            library = place / f"{NAME}{target.suffix}"
            link(target, [_SOURCE], [temporary, _STANDARD], library)
            libraries.setdefault(f"binaries/{target.fmi2}/{library.name}", []).append(library.read_bytes())
    return {name: found[0] if len(found) == 1 else universal(found) for name, found in libraries.items()}


def _header(given: Given) -> str:
    """Text of given.h; C has no arrays of length 0."""
    numbers = ", ".join(f"{{{float(factor)!r}, {float(offset)!r}}}" for factor, offset in given or ((1.0, 0.0),))
    return (
        f'#define GUID "{guid(given)}"\n#define GIVEN {len(given)}\nstatic const double given[][2] = {{{numbers}}};\n'
    )


def _description(channels: int, given: Given) -> Element:
    root = Element("fmiModelDescription", fmiVersion="2.0", modelName=NAME, guid=guid(given))
    root.set("description", "Outputs that are factor * input + offset at every instant")
    SubElement(root, "CoSimulation", modelIdentifier=NAME, canHandleVariableCommunicationStepSize="true")
    variables = SubElement(root, "ModelVariables")
    structure = SubElement(root, "ModelStructure")
    outputs, unknowns = SubElement(structure, "Outputs"), SubElement(structure, "InitialUnknowns")
    for channel in range(channels):
        factor, offset = given[channel] if channel < len(given) else (1.0, 0.0)
        for name, reference, causality, start in (
            (f"in[{channel + 1}]", in_reference(channel), "input", "0"),
            (f"out[{channel + 1}]", out_reference(channel), "output", None),
            (f"factor[{channel + 1}]", factor_reference(channel), "parameter", repr(float(factor))),
            (f"offset[{channel + 1}]", offset_reference(channel), "parameter", repr(float(offset))),
        ):
            variability = "fixed" if causality == "parameter" else "continuous"
            variable = SubElement(variables, "ScalarVariable", name=name, valueReference=str(reference))
            variable.attrib.update(causality=causality, variability=variability)
            SubElement(variable, "Real", {} if start is None else {"start": start})
        index = 4 * channel
        SubElement(outputs, "Unknown", index=str(index + 2), dependencies=f"{index + 1} {index + 3} {index + 4}")
        SubElement(unknowns, "Unknown", index=str(index + 2), dependencies=f"{index + 1} {index + 3} {index + 4}")
    return root
