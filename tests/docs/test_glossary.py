"""Every name in the glossary is where it says."""

import importlib
import re
from pathlib import Path

import pytest

import models

PAGE = Path(__file__).parents[2] / "docs" / "glossary.md"
TEXT = PAGE.read_text(encoding="utf-8")
#: Name and file of each row that has both: "| symbol | `name`, `other` | unit | meaning | [..](../file) |".
ROWS = re.findall(r"^\|[^|]*\|([^|]*`[^|]*)\|[^|]*\|[^|]*\| \[[^]]*\]\(\.\./([^)]+)\) \|$", TEXT, re.MULTILINE)
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


def test_every_row_has_a_name_and_a_file():
    """But for those of the last table, which has neither."""
    rows = [line for line in TEXT.splitlines() if line.startswith("| ") and line.count("|") == 6]
    headings = [line for line in rows if line.endswith("| where |") or line.startswith("| ---")]
    assert len(ROWS) == len(rows) - len(headings) > 80


def test_what_it_links_to_is_there():
    targets = re.findall(r"\]\(([^)]+)\)", TEXT)
    assert [target for target in targets if not (PAGE.parent / target).exists()] == []
