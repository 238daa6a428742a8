"""`doctor` says what is here, what is missing, and how to get it."""

import importlib.metadata
import sys

import pytest

from harness.app import output
from harness.app.commands import doctor
from mechanism_fmu.fmu.native.link import INSTALL
from mechanism_fmu.fmu.start import CACHE_VARIABLE


@pytest.fixture
def said(monkeypatch):
    """What it finds, by name."""
    lines = {}
    monkeypatch.setattr(output, "give", lambda result: lines.update({one["what"]: one for one in result["found"]}))
    return lines


def without(monkeypatch, package, version=None):
    """As if a package were not installed, or in another version."""
    real = importlib.metadata.version

    def asked(name):
        if name != package:
            return real(name)
        if version is None:
            raise importlib.metadata.PackageNotFoundError(name)
        return version

    monkeypatch.setattr(importlib.metadata, "version", asked)


def test_here_everything_is_well(said):
    assert doctor.examine() == 0
    assert said["numpy"]["found"] == importlib.metadata.version("numpy")
    assert all(line["well"] for line in said.values() if line["needed"])


@pytest.mark.parametrize("version", [None, "0.16.0"])
def test_a_linker_that_is_missing_or_another_is_named_with_the_way_to_get_it(said, monkeypatch, version):
    without(monkeypatch, "ziglang", version)
    assert doctor.examine() == 0
    assert not said["ziglang"]["well"]
    assert INSTALL in said["ziglang"]["follows"]


def test_what_everything_needs_and_is_missing_is_a_failure(said, monkeypatch, capsys):
    without(monkeypatch, "pandas")
    assert doctor.examine() == 1
    assert not said["pandas"]["well"]
    assert "missing" in capsys.readouterr().out


@pytest.mark.parametrize(("package", "extra"), [("pyarrow", "designs"), ("plotly", "plot"), ("numba", "dev")])
def test_what_an_extra_brings_is_not_needed_and_named_with_the_extra(said, monkeypatch, package, extra):
    real = importlib.metadata.requires
    monkeypatch.setattr(
        importlib.metadata, "requires", lambda name: [text for text in real(name) if not text.startswith(package)]
    )
    without(monkeypatch, package)
    assert doctor.examine() == 0
    assert not said[package]["well"]
    assert said[package]["follows"].endswith(f'python -m pip install -e ".[{extra}]"')


def test_a_cache_that_cannot_be_used_is_a_failure(said, monkeypatch, tmp_path):
    (tmp_path / "mechanism_fmu").mkdir(mode=0o777)
    (tmp_path / "mechanism_fmu").chmod(0o777)
    monkeypatch.setenv(CACHE_VARIABLE, str(tmp_path))
    assert doctor.examine() == 1
    assert "can be written by others" in said["Cache"]["found"]


def test_it_says_so_itself_where_a_package_that_commands_import_cannot_be_loaded(monkeypatch, capsys):
    """In words, although nothing can draw a table."""
    without(monkeypatch, "rich")
    for name in [name for name in sys.modules if name.startswith("harness.app.") and name != doctor.__name__]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "rich", None)
    monkeypatch.setitem(sys.modules, "rich.console", None)
    assert doctor.examine() == 1
    said = capsys.readouterr().out
    assert "rich: missing; get it: python -m pip install rich" in said
