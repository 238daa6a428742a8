"""Every XML file of every FMU by the official schemas, which the package fmpy brings along (those of SSP, too).

It has none for the manifest of FMI-LS-REF but for the attributes of all manifests; what the schema of 1.0.0-beta.1
wants is asked here one by one.
"""

import re
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import fmpy
import pytest
from lxml import etree

import build_fmu
import models
from harness.fmu.description_file import read_description
from harness.machine.file.read_file import components, read_plan
from harness.machine.formats.ssp_export import write_ssp
from harness.toml_file import TomlFile
from mechanism_fmu.fmu.native.package import build_native_fmu
from tests.importers.forms import FORMS, Form

_FMI = Path(fmpy.__file__).with_name("schema")
_SSP = Path(fmpy.__file__).with_name("ssp") / "schema"
_REFERENCE = "extra/org.fmi-standard.fmi-ls-ref"
_ROLES = {"document", "model", "parameter", "experiment", "result", "report", "meta-data", "other"}

FILES = list({form.file: form for form in FORMS.values()}.values())
BUILT = [
    pytest.param(form, name, marks=() if name in ("ratchet", "four_bar") else pytest.mark.slow, id=f"{form.key}-{name}")
    for form in FILES
    for name in models.available()
    if form.fits(name)
]


def schema(path: Path) -> etree.XMLSchema:
    return etree.XMLSchema(file=str(path))


def remarks(found: etree.XMLSchema, contents: bytes) -> list[str]:
    found.validate(etree.fromstring(contents))
    return [f"line {entry.line}: {entry.message}" for entry in found.error_log]


@pytest.mark.parametrize(("form", "name"), BUILT)
def test_no_remark(form: Form, name: str, built: Callable[..., Path]) -> None:
    with zipfile.ZipFile(built(name, form.build, **form.options)) as archive:
        files = {path: archive.read(path) for path in archive.namelist() if path.endswith((".xml", ".ssv"))}
    fmi = f"fmi{form.fmi}"
    schemas = {
        "modelDescription.xml": _FMI / fmi / f"{fmi}ModelDescription.xsd",
        "terminalsAndIcons/terminalsAndIcons.xml": _FMI / "fmi3" / "fmi3TerminalsAndIcons.xsd",
        "sources/buildDescription.xml": _FMI / "fmi3" / "fmi3BuildDescription.xsd",
    }
    for path, contents in files.items():
        if path.endswith(".ssv"):
            found = remarks(schema(_SSP / "SystemStructureParameterValues.xsd"), contents)
        elif path == f"{_REFERENCE}/fmi-ls-manifest.xml":
            found = remarks_about_the_manifest(contents, files)
        else:
            # In FMI 2.0 the version is its own; the schema, to which FMI 2.0.4 refers, is that of FMI 3.0.
            text = contents.replace(b'Icons fmiVersion="2.0"', b'Icons fmiVersion="3.0"')
            found = remarks(schema(schemas.pop(path)), text)
        assert found == [], path
    assert set(schemas) <= {"terminalsAndIcons/terminalsAndIcons.xml", "sources/buildDescription.xml"}
    description = etree.fromstring(files["modelDescription.xml"])
    assert set(runs_everywhere(description, form)) == set()


def remarks_about_the_manifest(contents: bytes, files: dict[str, bytes]) -> list[str]:
    """The attributes by the schema of manifests, what is related by the words of FMI-LS-REF 1.0.0-beta.1."""
    root = etree.fromstring(contents)
    space = f"{{{root.nsmap['fmi-ls']}}}"
    attributes = {name.removeprefix(space) for name in root.attrib if name.startswith(space)}
    found = [] if root.tag == "fmiReferences" else [f"root {root.tag}"]
    if attributes != {"fmi-ls-name", "fmi-ls-version", "fmi-ls-description"}:
        found.append(f"attributes {sorted(attributes)}")
    if root.get(f"{space}fmi-ls-name") != "org.fmi-standard.fmi-ls-ref":
        found.append("name")
    if root.get(f"{space}fmi-ls-description") != (
        "Layered Standard providing information on related files included in an FMU."
    ):
        found.append("description")
    for related in root:
        if related.tag != "Related" or set(related.attrib) - {"type", "source", "role", "description"}:
            found.append(f"element {related.tag} {dict(related.attrib)}")
        if related.get("role") not in _ROLES:
            found.append(f"role {related.get('role')}")
        source = related.get("source", "")
        if source.endswith(".ssv") and f"{_REFERENCE}/{source}" not in files:
            found.append(f"there is no {source}")
    return found


def runs_everywhere(root: etree._Element, form: Form) -> list[str]:
    """What OMSimulator 3.0 does not take in a built file: value reference 0, arrays, clocks, unknown dependencies."""
    variables = root.find("ModelVariables")
    references = {int(v.get("valueReference")) for v in variables}
    found = [] if 0 not in references else ["value reference 0"]
    if form.options.get("clocks"):
        return found
    if root.findall(".//Dimension") or [v for v in variables if v.get("clocks") or v.tag == "Clock"]:
        found.append("arrays or clocks")
    if form.fmi == 3:
        unknowns = root.find("ModelStructure")
        named = [int(k) for u in unknowns for k in (u.get("valueReference"), *u.get("dependencies", "").split())]
        if set(named) - references:
            found.append("dependencies on unknown variables")
    identifiers = [root.find("CoSimulation").get("modelIdentifier")]
    found += [name for name in identifiers if not re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII)]
    return found + [v.get("name") for v in variables if " " in v.get("name")]


@pytest.mark.parametrize("name", build_fmu.machines())
def test_no_remark_about_an_exported_machine(name: str, built: Callable[..., Path], tmp_path: Path) -> None:
    text = TomlFile.read(build_fmu.machines()[name])
    parts = components(text, build_fmu.model_names())
    fmus = {part.name: built(part.source.model, build_native_fmu) for part in parts}
    descriptions = {part: read_description(path) for part, path in fmus.items()}
    plan = replace(read_plan(text, parts, descriptions), inputs=None)
    ssp = write_ssp(plan, {part: (fmus[part], descriptions[part]) for part in fmus}, tmp_path / "machine.ssp")
    schemas = {".ssd": "SystemStructureDescription.xsd", ".ssv": "SystemStructureParameterValues.xsd"}
    with zipfile.ZipFile(ssp) as archive:
        found = {path: Path(path).suffix for path in archive.namelist() if Path(path).suffix in schemas}
        assert set(found.values()) == set(schemas)
        for path, suffix in found.items():
            assert remarks(schema(_SSP / schemas[suffix]), archive.read(path)) == [], path
