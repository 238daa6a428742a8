"""Every type of FMI 3.0 in a foreign FMU: told, set, run by the command line, and connected."""

import json
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from harness.errors import FmuError, UsageError
from harness.fmu import Fmu, open_fmu
from harness.fmu.description import Value
from harness.fmu.description_file import read_description
from harness.fmu.remote import in_own_process
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.running import run_machine
from harness.machine.stepping import Jacobi
from harness.run.experiment import start_values
from harness.run.master import TimeGrid
from harness.run.validate import validate
from tests.harness.machine.foreign import in_c
from tests.once import once

#: What is set of each type, at its limits.
GIVEN: dict[str, Value] = {
    "single": 0.5,
    "doubles[1]": -1.0 / 3.0,
    "int8": -128,
    "uint8": 255,
    "int16": -(2**15),
    "uint16": 2**16 - 1,
    "int32[1]": -(2**31),
    "int32[3]": 2**31 - 1,
    "uint32": 2**32 - 1,
    "int64": 2**63 - 1,
    "uint64": 2**64 - 2,
    "option": 2,
    "booleans[2]": True,
    "text": "a ü and 雪",
    "bytes": "00ff0a",
}


def port(name: str, way: str) -> str:
    """The variable of a name, "in" or "out": int32[3] is int32_in[3]."""
    stem, bracket, place = name.partition("[")
    return f"{stem}_{way}{bracket}{place}"


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("ziglang")
    return once(tmp_path_factory, "foreign_feedthrough", in_c.feedthrough) / "Feedthrough.fmu"


@pytest.fixture(scope="module")
def fmu(path: Path) -> Iterator[Fmu]:
    with open_fmu(path) as opened:
        yield opened


def given() -> dict[str, Value]:
    return {port(name, "in"): value for name, value in GIVEN.items()}


def told() -> list[str]:
    return [port(name, "out") for name in GIVEN]


def test_what_is_set_comes_out_again(fmu: Fmu) -> None:
    with fmu.instantiate("one") as one:
        one.set(given())
        one.initialize(0.0, 1.0)
        assert one.get(told()) == list(GIVEN.values())
        assert one.get(["doubles_out[2]", "int32_out[2]", "booleans_out[1]"]) == [2.5, 0, False]
        one.set({"bytes_in": "", "text_in": ""})
        assert one.get(["bytes_out", "text_out"]) == ["", ""]


def test_starts_are_those_of_the_description(fmu: Fmu) -> None:
    checks = list(validate(fmu))
    assert [check for check in checks if not check.passed] == []
    assert checks[1].evidence == "18 inputs and parameters"


def test_single_numbers_and_arrays_are_bound(fmu: Fmu) -> None:
    with fmu.instantiate("one") as one:
        one.initialize(0.0, 1.0)
        inputs, outputs = one.reals(["single_in", "doubles_in[2]"]), one.reals(["doubles_out[2]", "single_out"])
        inputs.values[:] = [0.25, 7.0]
        inputs.write()
        outputs.read()
        assert list(outputs.values) == [7.0, 0.25]


@pytest.mark.parametrize(("name", "value"), [("int8_in", 128), ("uint8_in", -1), ("uint64_in", 2**64)])
def test_a_number_that_does_not_fit_is_refused(fmu: Fmu, name: str, value: int) -> None:
    """C would make another number of it, without a word."""
    with fmu.instantiate("one") as one, pytest.raises(FmuError, match=rf"{value} does not fit, from -?\d+ to \d+"):
        one.set({name: value})


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("uint8_in=256", r"'256' does not fit its type \(UInt8, from 0 to 255\)"),
        ("int64_in=9223372036854775808", r"does not fit its type \(Int64"),
        ("bytes_in=0af", "is not Binary; give its bytes in hexadecimal"),
        ("int32_in[2]=0.5", "is not a whole number"),
    ],
)
def test_settings_that_cannot_be(path: Path, setting: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        start_values([setting], read_description(path))


@pytest.mark.parametrize("more", [[], ["--in-process"]])
def test_a_run_keeps_all_digits(path: Path, tmp_path: Path, more: list[str]) -> None:
    """Of 64 bits, which a double does not hold; also in a process of its own."""
    settings = [word for name, value in given().items() for word in ("--set", f"{name}={value}")]
    command = ["run", str(path), "-o", str(tmp_path / "out"), *settings, *more]
    done = CliRunner().invoke(main, command)
    assert done.exit_code == 0, done.output
    assert "Feedthrough.fmu says no step size; 0.001 s is taken. --step" in " ".join(done.output.split())
    table = pd.read_csv(tmp_path / "out" / "results.csv", dtype={"uint64_out": "uint64"})
    assert len(table) == 1001
    for name in ("single", "int8", "uint8", "int16", "uint16", "uint32", "int64", "uint64", "option"):
        assert (table[port(name, "out")] == GIVEN[name]).all(), name
    assert json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))["ending"] == "completed"


@pytest.mark.parametrize("process", [False, True])
def test_all_types_are_connected(fmu: Fmu, process: bool) -> None:
    links = [Connection(f"one.{port(name, 'out')}", f"other.{port(name, 'in')}") for name in GIVEN]
    with ExitStack() as stack:
        names = ("other", "one")
        parts = {
            name: stack.enter_context(in_own_process(fmu, name) if process else fmu.instantiate(name)) for name in names
        }
        machine = Machine(parts, links)
        start = {f"one.{name}": value for name, value in given().items()}
        outcome = run_machine(machine, Jacobi(), TimeGrid.of(0.2, 0.1), start)
        assert outcome.error is None
        assert machine.get([f"other.{name}" for name in told()]) == list(GIVEN.values())


def test_a_machine_records_integers_of_64_bits_as_doubles(path: Path, tmp_path: Path) -> None:
    """Exact to 2^53, as docs/how-to/machines-running.md says; the largest of them is no reason for a warning."""
    file = tmp_path / "one.toml"
    text = f"""[run]
stop_time = 0.2
step = 0.1
[component.one]
file = '{path}'
[component.one.set]
int64_in = 9007199254740991
"""
    file.write_text(text, encoding="utf-8")
    done = CliRunner().invoke(main, ["machine", "run", str(file), "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    table = pd.read_parquet(tmp_path / "out" / "results.parquet")
    assert table["one.int64_out"].tolist() == [2.0**53 - 1] * 3
    assert table["one.uint64_out"].tolist() == [2.0**64] * 3
    assert table["one.uint32_out"].dtype == np.int64


def test_columns_have_the_types_of_the_variables(fmu: Fmu) -> None:
    from harness.run.experiment import Experiment, perform

    run = perform(fmu, Experiment(0.1, 0.1, {"uint64_in": 2**64 - 1, "int64_in": -(2**63)}))
    assert run.results["uint64_out"].dtype == np.uint64
    assert run.results["uint64_out"].tolist() == [2**64 - 1] * 2
    assert run.results["int64_out"].tolist() == [-(2**63)] * 2
