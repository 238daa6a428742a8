"""Every tool that is installed on every form: the paper's numbers, and those of FMPy to the last digits."""

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import models
from tests.importers.asked import asked
from tests.importers.forms import FORMS, Form
from tests.importers.matrix import deviation, end_values, tolerance_of, wrong_about_the_ratchet
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
#: In pythonfmu's form, in event mode or with clocks, other models say nothing more of a tool; FMPy's own FMI 3.0 and
#: Model Exchange of every model are tests/fmu/native/test_every_model.py and test_model_exchange.py.
OTHERS = [
    pair for pair in PAIRS if pair.values[0] != "fmpy" and pair.values[1] in ("fmi2", "fmi3", "exchange2", "exchange3")
]


@pytest.fixture(scope="session")
def by_fmpy(built: Callable[..., Path], tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, float], Values]:
    """Outputs of a model at the end by FMPy, FMI 2.0, or at a time [s]."""
    known: dict[tuple[str, float], Values] = {}

    def run(name: str, until: float) -> Values:
        if (name, until) not in known:
            form = FORMS["fmi2"]
            folder = tmp_path_factory.mktemp(f"by_fmpy_{name}")
            known[name, until] = end_values("fmpy", form, built(name, form.build, **form.options), folder, until)
        return known[name, until]

    return run


def compared(
    key: str, form: Form, name: str, fmu: Path, by_fmpy: Callable[[str, float], Values], folder: Path
) -> Values:
    """The values that a tool gives at the end, which must be those of FMPy."""
    until = form.until(name)
    found = end_values(key, form, fmu, folder, until)
    assert deviation(found, by_fmpy(name, until)) < tolerance_of(TOOLS[key], form)
    return found


@pytest.mark.parametrize(("key", "form"), PAIRS)
def test_the_ratchet(
    key: str, form: str, built: Callable[..., Path], by_fmpy: Callable[[str, float], Values], tmp_path: Path
) -> None:
    how = FORMS[form]
    found = compared(key, how, "ratchet", built("ratchet", how.build, **how.options), by_fmpy, tmp_path)
    assert how.exchange or wrong_about_the_ratchet(found) == []


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(set(models.available()) - {"ratchet"}))
@pytest.mark.parametrize(("key", "form"), OTHERS)
def test_every_other_model(
    key: str, form: str, name: str, built: Callable[..., Path], by_fmpy: Callable[[str, float], Values], tmp_path: Path
) -> None:
    how = FORMS[form]
    compared(key, how, name, built(name, how.build, **how.options), by_fmpy, tmp_path)


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
