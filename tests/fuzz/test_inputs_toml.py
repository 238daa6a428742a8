"""Files of sweeps, optima and machines: whatever stands in them, they are read or refused with all their mistakes."""

from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from harness.designs.optimum_file import read_optimum
from harness.designs.sweep import read_sweep
from harness.designs.variation import source
from harness.errors import UsageError
from harness.machine.file.read_file import components, read_plan
from harness.toml_file import TomlFile
from tests.fuzz.input_bytes import CORPUS, damaged, fuzzed, nasty, read_or_refused
from tests.harness.fake_slave import fake_description

SWEEP = """\
title = "Teeth"
[fmu]
file = "Fake.fmu"
[run]
stop_time = "500 ms"
step = 0.1
material = "S355"
[set]
drive_torque = "2 N.m"
guided = false
[sweep]
method = "latin_hypercube"
count = 8
seed = 1
[vary.tooth_count]
from = 10
to = 25
[vary.tooth_slope_angle]
from = 85
to = 105
unit = "deg"
[vary.gear]
values = [1, 3]
[record]
end = ["wheel_angle"]
max = ["wheel_angle", "impact_count"]
parameter = ["tooth_pitch"]
"""
OPTIMUM = (
    SWEEP.replace('[sweep]\nmethod = "latin_hypercube"\ncount = 8\nseed = 1\n', "")
    + """\
[optimise]
minimise = "end.wheel_angle"
count = 30
seed = 1
[constraint."parameter.tooth_pitch"]
at_least = 6
at_most = 9.5
unit = "deg"
[sensitivity]
count = 64
width = 0.1
"""
)
MACHINE = """\
title = "Two"
[run]
stop_time = "1 s"
step = "1 ms"
algorithm = "adaptive"
tolerance = 1e-4
extrapolation = "constant"
material = "steel"
[component.one]
file = "Fake.fmu"
process = true
time_limit = 3.5
[component.two]
model = "ratchet"
flavour = "native"
fmi = 3
[component.two.set]
tooth_count = 12
tooth_slope_angle = "95 deg"
[[connect]]
from = "one.wheel_angle"
to = "two.drive_torque"
gain = 0.5
offset = "1 N.mm"
[[bond]]
name = "shaft"
flow = "two.drive_torque"
effort = "two.drive_torque"
reaction = true
[record]
signals = ["*.wheel_angle"]
every = 2
format = "csv"
"""


def read_machine(file: TomlFile) -> object:
    parts = components(file, ["ratchet"])
    return read_plan(file, parts, {part.name: fake_description() for part in parts})


def read_designs(read: Callable[..., object]) -> Callable[[TomlFile], object]:
    def read_file(file: TomlFile) -> object:
        source(file)
        return read(file, fake_description())

    return read_file


READERS = {
    "sweep": (SWEEP, read_designs(read_sweep)),
    "optimum": (OPTIMUM, read_designs(read_optimum)),
    "machine": (MACHINE, read_machine),
}
SEEDS = sorted(CORPUS.glob("toml/*"))
#: Values as TOML has them.
VALUES = st.one_of(
    nasty.map(lambda text: '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'),
    st.sampled_from(
        (
            *("0", "-1", "1e308", "-1e308", "1e400", "inf", "-inf", "nan", "9" * 30, "9" * 400, "1e-400", "true", "[]"),
            *("{}", "[[]]", "[1, 'a']", "[nan]", "[inf, -inf]", "{ a = 1 }", "1979-05-27", "07:32:00", "0x_1", "-0"),
            *("[" * 15 + "]" * 15, "['" + "a" * 5000 + "']", "0xffffffffffffffffffffff", "[true, 1]", "[1, 1]"),
            *("['']", '"""a\nb"""'),
        )
    ),
    st.integers().map(str),
    st.floats(allow_nan=False, allow_infinity=False).map(repr),
)


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("toml") / "file.toml"


def read(kind: str, path: Path) -> object:
    return read_or_refused(lambda: READERS[kind][1](TomlFile.read(path)), path)


@pytest.mark.parametrize("kind", READERS)
def test_what_is_damaged_was_known(kind: str, path: Path) -> None:
    """But for what the fake has not: nothing in it is unknown."""
    path.write_text(READERS[kind][0])
    file = TomlFile.read(path)
    if kind == "machine":  # its bond goes nowhere, and what is its components' is not the fake's
        with pytest.raises(UsageError) as refusal:
            READERS[kind][1](file)
        assert "is not known" not in str(refusal.value)
        assert len(str(refusal.value).splitlines()) <= 4
    else:
        READERS[kind][1](file)


def test_the_corpus_is_there() -> None:
    assert len(SEEDS) >= 6


@pytest.mark.parametrize("kind", READERS)
@pytest.mark.parametrize("seed", SEEDS, ids=lambda seed: seed.name)
def test_the_corpus_is_refused(seed: Path, kind: str) -> None:
    assert read(kind, seed) is None


@pytest.mark.parametrize("kind", READERS)
@fuzzed
@given(data=st.data())
def test_any_value_is_taken_or_refused(path: Path, kind: str, data: st.DataObject) -> None:
    lines = READERS[kind][0].splitlines()
    assignments = [place for place, line in enumerate(lines) if "=" in line]
    assert assignments
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.sampled_from(assignments))
        lines[place] = f"{lines[place].partition('=')[0]}= {data.draw(VALUES)}"
    path.write_text("\n".join(lines), encoding="utf-8")
    read(kind, path)


@pytest.mark.parametrize("kind", READERS)
@fuzzed
@given(data=st.data())
def test_lines_that_go_or_come_twice_are_taken_or_refused(path: Path, kind: str, data: st.DataObject) -> None:
    lines = READERS[kind][0].splitlines()
    chosen = data.draw(st.lists(st.sampled_from(range(len(lines))), min_size=1, max_size=4, unique=True))
    kept = [
        line for place, line in enumerate(lines) for _ in range(data.draw(st.integers(0, 2)) if place in chosen else 1)
    ]
    path.write_text("\n".join(kept), encoding="utf-8")
    read(kind, path)


@pytest.mark.parametrize("kind", READERS)
@fuzzed
@given(data=st.data())
def test_any_bytes_are_read_or_refused(path: Path, kind: str, data: st.DataObject) -> None:
    path.write_bytes(data.draw(damaged(READERS[kind][0].encode()) | st.binary(max_size=100)))
    read(kind, path)


@pytest.mark.parametrize("depth", [21, 100, 400, 10_000, 200_000])
@pytest.mark.parametrize("form", ["a = {}{}", "[set]\na = {}{}", "a = [1, {}{}]"])
@pytest.mark.parametrize("kind", READERS)
def test_deep_nesting_is_refused_in_one_line(path: Path, kind: str, form: str, depth: int) -> None:
    path.write_text(form.format("[" * depth, "]" * depth))
    with pytest.raises(UsageError, match="stand within one another") as refusal:
        READERS[kind][1](TomlFile.read(path))
    assert len(str(refusal.value).splitlines()) == 1
    assert "at most 20 may" in str(refusal.value)


@pytest.mark.parametrize("open_and_close", ["[]", "{}"])
def test_twenty_may_stand_within_one_another(path: Path, open_and_close: str) -> None:
    first, last = ("[", "]") if open_and_close == "[]" else ("{ b = ", " }")
    path.write_text(f"a = {first * 19}{open_and_close}{last * 19}")
    assert TomlFile.read(path).data["a"]
    path.write_text(f"a = {first * 20}{open_and_close}{last * 20}")
    with pytest.raises(UsageError, match="stand within one another"):
        TomlFile.read(path)


def test_deep_tables_are_refused_too(path: Path) -> None:
    for text in (
        "a = " + "{ b = " * 2000 + "1" + "}" * 2000,
        "[" + ".".join("a" * 500) + "]",
        ".".join("a" * 500) + " = 1",
    ):
        path.write_text(text)
        with pytest.raises(UsageError, match="stand within one another"):
            TomlFile.read(path)


@pytest.mark.parametrize("kind", READERS)
@pytest.mark.parametrize("step", ["1e300", "1e-12", "0"])
def test_a_step_that_cannot_be_is_told_where_it_stands(path: Path, kind: str, step: str) -> None:
    text = READERS[kind][0].replace("step = 0.1", f"step = {step}").replace('step = "1 ms"', f"step = {step}")
    path.write_text(text)
    with pytest.raises(UsageError, match=r"run\.step: The step is (1e\+300|1e-12|0) s"):
        READERS[kind][1](TomlFile.read(path))


@pytest.mark.parametrize("kind", READERS)
def test_mistakes_do_not_quote_thousands_of_letters(path: Path, kind: str) -> None:
    text = READERS[kind][0]
    for name in ("minimise", "from", "to", "max", "signals", "model"):
        text = "\n".join(
            f'{name} = "{"9" * 5000}"' if line.startswith(f"{name} = ") else line for line in text.splitlines()
        )
    path.write_text(text)
    with pytest.raises(UsageError) as refusal:
        READERS[kind][1](TomlFile.read(path))
    assert "9" * 50 in str(refusal.value)
    assert "9" * 301 not in str(refusal.value)


def test_a_long_line_takes_no_time(path: Path) -> None:
    """Names of keys are looked for in lines; one of a million blanks once took minutes."""
    path.write_text('a = """\n' + " " * 1_000_000 + '\n"""\n')
    assert len(TomlFile.read(path).data["a"]) == 1_000_001
