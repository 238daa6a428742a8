"""What is for users stands in the packages and in docs/reference/public-interface.md alike, each name explained."""

import importlib
import inspect
import pkgutil
import re
from pathlib import Path

import pytest

import harness
import mechanism_fmu
from tests.public import listed_by

PAGE = (Path(__file__).parents[2] / "docs" / "reference" / "public-interface.md").read_text(encoding="utf-8")
NAME = re.compile(r"`([\w.]+)`")
#: By module, all names in its rows.
LISTED: dict[str, list[str]] = {}
for row in re.findall(r"^\| (`.*) \|$", PAGE, re.MULTILINE):
    module, names, _ = row.split(" | ", 2)
    LISTED.setdefault(module.strip("`"), []).extend(NAME.findall(names))
PUBLIC = [(module, name) for module, names in LISTED.items() for name in names]
INTERNAL = NAME.findall(PAGE[PAGE.index("## What is not for users") :])
PACKAGES = ["models"] + [
    name
    for root in (mechanism_fmu, harness)
    for name in (root.__name__, *(m.name for m in pkgutil.walk_packages(root.__path__, f"{root.__name__}.") if m.ispkg))
]


def constant_is_explained(module: str, name: str) -> bool:
    """Whether a comment that begins with #: stands above what is no class and no function, where it is defined."""
    package = importlib.import_module(module)
    folder = Path(package.__file__).parent
    files = [Path(package.__file__), *folder.rglob("*.py"), folder.parent / "codes.py"]
    above = re.compile(rf"^#: .*\n(#.*\n)*{name} = ", re.MULTILINE)
    return any(above.search(file.read_text(encoding="utf-8")) for file in files if file.is_file())


@pytest.mark.parametrize(("module", "name"), PUBLIC, ids=lambda text: text)
def test_a_public_name_is_there_and_explained(module: str, name: str) -> None:
    found = getattr(importlib.import_module(module), name)
    if not (inspect.isclass(found) or inspect.isfunction(found)):
        assert constant_is_explained(module, name)
        return
    assert found.__doc__
    assert not found.__doc__.startswith(f"{name}(")  # which a record without a docstring is given


@pytest.mark.parametrize("module", LISTED)
def test_the_page_lists_what_the_module_lists_and_each_name_once(module: str) -> None:
    listed = listed_by(importlib.import_module(module))
    assert len(LISTED[module]) == len(set(LISTED[module]))
    if listed is not None:
        assert sorted(LISTED[module]) == sorted(listed)
        assert len(listed) == len(set(listed))


@pytest.mark.parametrize("module", [module for module in LISTED if module.startswith("harness.")])
def test_a_module_of_the_page_is_listed_by_its_package(module: str) -> None:
    package, _, name = module.rpartition(".")
    assert package in LISTED or name in importlib.import_module(package).__all__


@pytest.mark.parametrize("name", PACKAGES)
def test_a_package_says_what_lives_there_and_what_is_for_users(name: str) -> None:
    package = importlib.import_module(name)
    assert package.__doc__
    if name in LISTED or any(f"{name}.".startswith(f"{internal}.") for internal in INTERNAL):
        return
    assert package.__all__  # names of modules, each with its rows
    for module in package.__all__:
        inside = f"{name}.{module}"
        assert any(listed == inside or listed.startswith(f"{inside}.") for listed in LISTED), inside
