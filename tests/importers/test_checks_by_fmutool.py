"""fmu-manipulation-toolbox checks FMUs: schema, and what the standards say of attributes and dependencies."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.importers.test_schemas import BUILT
from tests.importers.tool import package_missing

_MISSING = package_missing("fmu-manipulation-toolbox", "fmu_manipulation_toolbox")
_CHECK = "from fmu_manipulation_toolbox.cli.fmutool import fmutool; fmutool()"

pytestmark = pytest.mark.skipif(bool(_MISSING), reason=f"fmu-manipulation-toolbox is {_MISSING}")


@pytest.mark.parametrize(("form", "name"), BUILT)
def test_it_finds_no_fault(form, name: str, built: Callable[..., Path]) -> None:
    fmu = built(name, form.build, **form.options)
    command = [sys.executable, "-c", _CHECK, "-input", str(fmu), "-check"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=fmu.parent)
    said = done.stdout + done.stderr
    assert f"This FMU seems to be compliant with FMI-{form.fmi}.0." in said
    assert f"No semantic error against the FMI-{form.fmi} standard." in said
    assert "ERROR" not in said
