"""Every tool that is installed on every form: the paper's numbers, and those of FMPy to the last digits."""

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import models
from tests.importers.asked import asked
from tests.importers.forms import FORMS
from tests.importers.matrix import deviation, end_values, wrong_about_the_ratchet
from tests.importers.tool import ToolError, Values, values_of
from tests.importers.tools import TOOLS

PAIRS = [
    pytest.param(
        key,
        form,
        id=f"{key}-{form}",
        marks=pytest.mark.skipif(bool(tool.missing()), reason=f"{tool.name} {tool.missing()}"),
    )
    for key, tool in TOOLS.items()
    for form in tool.forms
]
#: In pythonfmu's form, in event mode or with clocks, other models say nothing more of a tool; FMPy's own FMI 3.0 of
#: every model is tests/fmu/native/test_every_model.py.
OTHERS = [pair for pair in PAIRS if pair.values[0] != "fmpy" and pair.values[1] in ("fmi2", "fmi3")]


@pytest.fixture(scope="session")
def by_fmpy(built: Callable[..., Path], tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Values]:
    """Outputs of a model at the end by FMPy, FMI 2.0."""
    known: dict[str, Values] = {}

    def run(name: str) -> Values:
        if name not in known:
            form = FORMS["fmi2"]
            folder = tmp_path_factory.mktemp(f"by_fmpy_{name}")
            known[name] = end_values("fmpy", form, built(name, form.build, **form.options), folder)
        return known[name]

    return run


@pytest.mark.parametrize(("key", "form"), PAIRS)
def test_the_ratchet(
    key: str, form: str, built: Callable[..., Path], by_fmpy: Callable[[str], Values], tmp_path: Path
) -> None:
    how = FORMS[form]
    found = end_values(key, how, built("ratchet", how.build, **how.options), tmp_path)
    assert wrong_about_the_ratchet(found) == []
    assert deviation(found, by_fmpy("ratchet")) < TOOLS[key].tolerance


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(set(models.available()) - {"ratchet"}))
@pytest.mark.parametrize(("key", "form"), OTHERS)
def test_every_other_model(
    key: str, form: str, name: str, built: Callable[..., Path], by_fmpy: Callable[[str], Values], tmp_path: Path
) -> None:
    how = FORMS[form]
    found = end_values(key, how, built(name, how.build, **how.options), tmp_path)
    assert deviation(found, by_fmpy(name)) < TOOLS[key].tolerance


@pytest.mark.parametrize(
    ("program", "message"),
    [
        ("import os; os.abort()", "ended on the way with exit code -6"),
        ("import os, sys; open(sys.argv[1], 'w').close(); os.abort()", "ended after its last step with exit code -6"),
        ("print('nothing')", "gave no values: nothing"),
    ],
)
def test_what_a_tool_does_wrong_is_said(program: str, message: str, ratchet_fmu: Path, tmp_path: Path) -> None:
    """Also a crash at its very end, where it has given all values."""
    with pytest.raises(ToolError, match=message):
        values_of([sys.executable, "-c", program], asked(ratchet_fmu, tmp_path))
