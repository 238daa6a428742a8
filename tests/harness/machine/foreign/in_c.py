"""FMUs of FMI 3.0 from C: `feedthrough.c` has every type, `pulse.c` clocks, `exchange.c` no steps."""

import re
import subprocess
import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, tostring

import fmpy
from fmpy.fmi3 import FMU3Slave

HERE = Path(__file__).parent

#: Type, name, value reference, start, sizes.
FEEDTHROUGH = (
    ("Float32", "single", 1, "0.1", ()),
    ("Float64", "doubles", 2, "0 2.5", (2,)),
    ("Int8", "int8", 3, "0", ()),
    ("UInt8", "uint8", 4, "0", ()),
    ("Int16", "int16", 5, "0", ()),
    ("UInt16", "uint16", 6, "0", ()),
    ("Int32", "int32", 7, "0 0 0", (3,)),
    ("UInt32", "uint32", 8, "0", ()),
    ("Int64", "int64", 9, "0", ()),
    ("UInt64", "uint64", 10, str(2**64 - 1), ()),
    ("Enumeration", "option", 11, "1", ()),
    ("Boolean", "booleans", 12, "false false", (2,)),
    ("String", "text", 13, "two words", ()),
    ("Binary", "bytes", 14, "00ff", ()),
)

#: Type, name, value reference, and what else it has.
PULSE = (
    ("Float64", "period", 1, {"causality": "parameter", "variability": "fixed", "start": "0.25"}),
    ("Clock", "tick", 2, {"causality": "output", "intervalVariability": "triggered"}),
    ("Int32", "number", 3, {"causality": "output", "clocks": "2"}),
    ("Int32", "strikes", 4, {"causality": "output"}),
    ("Clock", "poke", 5, {"causality": "input", "intervalVariability": "triggered"}),
    ("Int32", "weight", 6, {"causality": "input", "clocks": "5", "start": "0"}),
    ("Float64", "sum", 7, {"causality": "output", "variability": "discrete"}),
    ("Clock", "echo", 8, {"causality": "output", "intervalVariability": "triggered"}),
    ("Int32", "echoed", 9, {"causality": "output", "clocks": "8"}),
    ("Int32", "seen", 10, {"causality": "input", "start": "0"}),
    ("Int32", "seen_now", 11, {"causality": "output"}),
    ("Float64", "alarm", 12, {"causality": "parameter", "variability": "fixed", "start": "0"}),
    ("Int32", "alarms", 13, {"causality": "output"}),
)


def feedthrough(folder: Path) -> Path:
    """FMI 3.0 without event mode."""
    variables: list[Element] = []
    for kind, name, reference, start, sizes in FEEDTHROUGH:
        given = _variable(kind, f"{name}_in", reference, {"causality": "input", "start": start})
        told = _variable(kind, f"{name}_out", reference + 100, {"causality": "output"})
        for one in (given, told):
            for size in sizes:
                SubElement(one, "Dimension", start=str(size))
            if kind == "Enumeration":
                one.set("declaredType", "Option")
        variables += [given, told]
    types = Element("TypeDefinitions")
    option = SubElement(types, "EnumerationType", name="Option")
    for value in (1, 2):
        SubElement(option, "Item", name=f"option {value}", value=str(value))
    return _fmu(folder, "feedthrough", variables, {}, [types])


def pulse(folder: Path) -> Path:
    """FMI 3.0 with clocks, which asks for event mode."""
    variables = [_variable(kind, name, reference, dict(more)) for kind, name, reference, more in PULSE]
    flags = dict.fromkeys(("hasEventMode", "mightReturnEarlyFromDoStep", "canGetAndSetFMUState"), "true")
    return _fmu(folder, "pulse", variables, flags)


#: Type, name, value reference, and what else it has, by kind of `exchange.c`.
_MOVING = (
    ("Float64", "x0", 1, {"causality": "output"}),
    ("Float64", "x1", 2, {"causality": "output"}),
    ("Float64", "der(x0)", 3, {"causality": "local", "derivative": "1"}),
    ("Float64", "der(x1)", 4, {"causality": "local", "derivative": "2"}),
)
EXCHANGE = {
    "bouncing": (
        *_MOVING,
        ("Float64", "restitution", 5, {"causality": "parameter", "variability": "fixed", "start": "0.7"}),
        ("Int32", "count", 6, {"causality": "output"}),
        ("Float64", "indicator", 7, {"causality": "local"}),
    ),
    "van_der_pol": _MOVING,
    "stair": (("Int32", "count", 6, {"causality": "output"}),),
}


def for_exchange(folder: Path, kind: str) -> Path:
    """FMI 3.0 for Model Exchange only: one of `EXCHANGE`."""
    variables = [_variable(type_, name, reference, dict(more)) for type_, name, reference, more in EXCHANGE[kind]]
    root = Element("fmiModelDescription", fmiVersion="3.0", modelName=kind, instantiationToken=kind)
    flags = {"needsCompletedIntegratorStep": "true", "canGetAndSetFMUState": "true"}
    SubElement(root, "ModelExchange", {"modelIdentifier": "exchange"} | flags)
    path = _described(root, folder, kind, variables)
    library = compiled(HERE / "exchange.c", folder)
    with zipfile.ZipFile(path, "w") as fmu:
        fmu.writestr("modelDescription.xml", tostring(root))
        fmu.write(library, f"binaries/{fmpy.platform_tuple}/{library.name}")
    return path


def renamed(fmu: Path, old: str, new: str) -> Path:
    """The same FMU whose files have other names: `old` in them becomes `new`."""
    path = fmu.with_name(f"{fmu.stem}_renamed.fmu")
    with zipfile.ZipFile(fmu) as given, zipfile.ZipFile(path, "w") as made:
        for name in given.namelist():
            made.writestr(name.replace(old, new), given.read(name))
    return path


def _variable(kind: str, name: str, reference: int, more: dict[str, str]) -> Element:
    start = more.pop("start", None)
    one = Element(kind, {"name": name, "valueReference": str(reference), **more})
    if start is not None and kind in ("String", "Binary"):
        SubElement(one, "Start", value=start)
    elif start is not None:
        one.set("start", start)
    return one


def _fmu(
    folder: Path, name: str, variables: Sequence[Element], flags: dict[str, str], more: Sequence[Element] = ()
) -> Path:
    model = name.capitalize()
    root = Element("fmiModelDescription", fmiVersion="3.0", modelName=model, instantiationToken=name)
    varies = {"canHandleVariableCommunicationStepSize": "true"}
    SubElement(root, "CoSimulation", {"modelIdentifier": name} | varies | flags)
    root.extend(more)
    path = _described(root, folder, model, variables)
    library = compiled(HERE / f"{name}.c", folder)
    with zipfile.ZipFile(path, "w") as fmu:
        fmu.writestr("modelDescription.xml", tostring(root))
        fmu.write(library, f"binaries/{fmpy.platform_tuple}/{library.name}")
    return path


def _described(root: Element, folder: Path, model: str, variables: Sequence[Element]) -> Path:
    """Append variables and model structure; where the FMU is to be."""
    SubElement(root, "DefaultExperiment", stopTime="1")
    declared = SubElement(root, "ModelVariables")
    time = Element("Float64", name="time", valueReference="0", causality="independent", variability="continuous")
    declared.extend([time, *variables])
    structure = SubElement(root, "ModelStructure")
    for one in variables:
        if one.get("causality") == "output":
            SubElement(structure, "Output", valueReference=one.attrib["valueReference"])
    for one in variables:
        if "derivative" in one.attrib:
            SubElement(structure, "ContinuousStateDerivative", valueReference=one.attrib["valueReference"])
    for one in variables:
        if one.get("causality") == "output" and "clocks" not in one.attrib:
            SubElement(structure, "InitialUnknown", valueReference=one.attrib["valueReference"])
    for one in variables:
        if one.get("name") == "indicator":
            SubElement(structure, "EventIndicator", valueReference=one.attrib["valueReference"])
    return folder / f"{model}.fmu"


def compiled(source: Path, folder: Path) -> Path:
    """The library of an FMU from C; functions that the source has not refuse."""
    text = source.read_text(encoding="utf-8")
    asked = {name for name in vars(FMU3Slave) | vars(FMU3Slave.__base__) if name.startswith("fmi3")}
    there = set(re.findall(r"\b(fmi3\w+)\(", text)) | {
        f"fmi3{way}{kind}" for kind in re.findall(r"^NUMBERS\((\w+)", text, re.M) for way in ("Get", "Set")
    }
    stubs = "".join(f"int {name}(void) {{ return 3; }}\n" for name in sorted(asked - there))
    (folder / source.name).write_text(text + stubs, encoding="utf-8")
    library = folder / f"{source.stem}{fmpy.sharedLibraryExtension}"
    compiler = [sys.executable, "-m", "ziglang", "cc", "-shared", "-fPIC", "-O1", "-w"]
    subprocess.run([*compiler, str(folder / source.name), "-o", str(library)], check=True, capture_output=True)
    return library
