"""Every name in the glossary is where it says."""

import importlib
import re
from pathlib import Path

import pytest
import typer

import models
from harness.app import cli
from mechanism_fmu import elastodynamics, kinematics

PAGE = Path(__file__).parents[2] / "docs" / "explanation" / "glossary.md"
TEXT = PAGE.read_text(encoding="utf-8")
#: Name and file of each row that has both: "| symbol | `name`, `other` | unit | meaning | [..](../file) |".
ROWS = re.findall(r"^\|[^|]*\|([^|]*`[^|]*)\|[^|]*\|[^|]*\| \[[^]]*\]\(\.\./\.\./([^)]+)\) \|$", TEXT, re.MULTILINE)
ENTRIES = [(name, place) for names, place in ROWS for name in re.findall(r"`([^`]+)`", names)]


def ports(model):
    """Names of all variables of a model's FMU."""
    mechanism = model.mechanism(model.values())
    return {port.name for port in (*model.parameters, *mechanism.inputs, *mechanism.outputs, *mechanism.calculated)}


def has(owner, name):
    """Whether `owner` has an attribute, or its instances have a field, of this name."""
    return hasattr(owner, name) or any(name in vars(base).get("__annotations__", {}) for base in owner.__mro__)


@pytest.mark.parametrize(("name", "place"), ENTRIES)
def test_a_name_is_where_the_glossary_says(name, place):
    if place.startswith("models/"):
        assert name in ports(models.load(Path(place).parent.name).MODEL)
        return
    first, _, field = name.partition(".")
    owner = getattr(importlib.import_module(place.removesuffix(".py").replace("/", ".")), first)
    assert not field or has(owner, field)


#: The terms that Erdman, Sandor and Oakberg define, and the code and commands behind each.
DEFINED = (
    "Kinematic analysis",
    "Dynamic analysis",
    "Elastic analysis",
    "Elastodynamic analysis",
    "Kineto-elastodynamic analysis",
    "Kinematic synthesis",
    "Dynamic synthesis",
    "Dynamic balancing",
    "Kineto-elastostatic synthesis",
    "Kineto-elastodynamic synthesis",
    "Kineto-elastodynamics",
)
TERMS = {row[0]: row[2] for row in re.findall(r"^\| ([^|]*) \| ([^|]*) \| ([^|]*) \|$", TEXT, re.MULTILINE)}


def test_the_definitions_of_the_elastodynamics_paper_are_all_there():
    assert [term for term in TERMS if term in DEFINED] == list(DEFINED)


@pytest.mark.parametrize("term", DEFINED)
def test_a_definition_names_functions_and_commands_that_exist(term):
    names = re.findall(r"`([^`]+)`", TERMS[term])
    assert names
    commands = {command.name or command.callback.__name__ for command in cli.main.registered_commands}
    options = {name for option in typer.main.get_command(cli.main).commands["ked"].params for name in option.opts}
    for name in names:
        words = name.split()
        if words[0] == "mechanism-fmu":
            assert words[1] in commands
            assert {word for word in words[2:] if word.startswith("--")} <= options
        elif name != "mechanism_fmu.elastodynamics":
            owner, _, field = name.rpartition(".")
            assert public(owner, field), name


def public(owner, name):
    """Whether a name is in the library: of a module or class, or of one of those that analyse linkages."""
    if not owner:
        return hasattr(elastodynamics, name) or hasattr(kinematics, name)
    if hasattr(elastodynamics, owner):
        return has(getattr(elastodynamics, owner), name)
    return hasattr(importlib.import_module(f"mechanism_fmu.{owner}"), name)


def test_every_row_has_a_name_and_a_file():
    """But for those of the last table, which has neither."""
    rows = [line for line in TEXT.splitlines() if line.startswith("| ") and line.count("|") == 6]
    headings = [line for line in rows if line.endswith("| where |") or line.startswith("| ---")]
    assert len(ROWS) == len(rows) - len(headings) > 80


def test_what_it_links_to_is_there():
    targets = re.findall(r"\]\(([^)]+)\)", TEXT)
    assert [target for target in targets if not (PAGE.parent / target).exists()] == []
