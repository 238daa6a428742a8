"""Former names of public modules are the modules of the new names, with a warning."""

import importlib
import re
import subprocess
import sys

import pytest

from harness._moved import MOVED


@pytest.mark.parametrize(("old", "new"), [(old, new) for old, new in MOVED.items() if new is not None])
def test_a_former_name_is_the_module_of_the_new_one(old: str, new: str) -> None:
    sys.modules.pop(f"harness.{old}", None)
    with pytest.warns(DeprecationWarning, match=re.escape(f"harness.{old} is now harness.{new};")):
        found = importlib.import_module(f"harness.{old}")
    assert found is importlib.import_module(f"harness.{new}")


def test_the_warning_names_the_line_that_imports() -> None:
    program = "\nfrom harness.machine.algorithms.jacobi import Jacobi\nprint(Jacobi.__module__)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "harness.machine.stepping\n"
    done = subprocess.run([sys.executable, "-W", "error", "-c", program], capture_output=True, text=True, check=False)
    assert 'File "<string>", line 2' in done.stderr


def test_what_never_was_there_is_not_found() -> None:
    with pytest.raises(ModuleNotFoundError, match=re.escape("harness.nothing")):
        importlib.import_module("harness.nothing")
