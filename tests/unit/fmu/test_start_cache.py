"""What becomes of a cache that is damaged, and of compiled code in it."""

import marshal
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from importlib.machinery import EXTENSION_SUFFIXES, SourceFileLoader
from pathlib import Path
from typing import Any

import pytest
from start_resources import SOURCES, Load, contents, write_resources

from mechanism_fmu.fmu.parts.bytecode import bytecode

#: Deletes the package that it stands in, the first time that it is imported.
VANISHING = """
import shutil
import subprocess
from pathlib import Path

package = Path(__file__).parents[1]
if not package.with_name("gone").exists():
    package.with_name("gone").touch()
    shutil.rmtree(package)
"""


def test_a_cache_that_is_deleted_while_it_is_read_is_written_anew(tmp_path: Path, cache: Path, load: Load) -> None:
    sources = SOURCES | {"fmu/__init__.py": VANISHING}
    start = load(write_resources(tmp_path / "unzipped", "aaa", sources), "aaa")
    assert start.slave_class("mechanism_fmu_aaa", "models.tiny").__name__ == "Tiny"
    assert (cache / "gone").is_file()
    assert contents(cache / "mechanism_fmu_aaa") == sources


def test_a_cache_that_goes_each_time_is_done_without(tmp_path: Path, cache: Path, load: Load) -> None:
    """The FMU runs from where it was unzipped."""
    always = VANISHING.replace(
        'if not package.with_name("gone").exists():', f"if package.is_relative_to({str(cache)!r}):"
    )
    resources = write_resources(tmp_path / "unzipped", "aaa", SOURCES | {"fmu/__init__.py": always})
    made = load(resources, "aaa").slave_class("mechanism_fmu_aaa", "models.tiny")
    assert made.__name__ == "Tiny"
    assert Path(sys.modules["mechanism_fmu_aaa"].__file__ or "").is_relative_to(resources)
    assert not (cache / "mechanism_fmu_aaa").exists()


def test_an_engine_that_has_gone_before_it_is_loaded_is_written_anew(tmp_path: Path, cache: Path, load: Load) -> None:
    """Else it would be compiled, by a package that need not be there, from sources that have gone, too."""
    vanishing = VANISHING.replace(
        "shutil.rmtree(package)", '(package / "engine/compiled/some.so").unlink()\n    import nil'
    )
    sources = SOURCES | {"fmu/__init__.py": vanishing, "engine/compiled/some.so": "engine"}
    start = load(write_resources(tmp_path / "unzipped", "aaa", sources), "aaa")
    assert start.slave_class("mechanism_fmu_aaa", "models.tiny").__name__ == "Tiny"
    assert (cache / "gone").is_file()
    assert (cache / "mechanism_fmu_aaa" / "engine/compiled/some.so").is_file()


@pytest.mark.parametrize("damage", ["truncated", "changed", "missing", "folder gone", "all gone"])
def test_a_damaged_cache_is_repaired(damage: str, tmp_path: Path, cache: Path, load: Load) -> None:
    resources = write_resources(tmp_path / "unzipped", "aaa")
    load(resources, "aaa").slave_class("mechanism_fmu_aaa", "models.tiny")
    victim = cache / "mechanism_fmu_aaa" / "models" / "tiny.py"
    if damage == "truncated":
        victim.write_text("MODEL = ")
    elif damage == "changed":
        victim.write_text("MODEL = 'Evil'\n")
    elif damage == "missing":
        victim.unlink()
    elif damage == "folder gone":
        shutil.rmtree(victim.parent)
    else:
        shutil.rmtree(cache)
        (cache / "mechanism_fmu_aaa").mkdir(parents=True)
    assert load(resources, "aaa").slave_class("mechanism_fmu_aaa", "models.tiny").__name__ == "Tiny"
    assert contents(cache / "mechanism_fmu_aaa") == SOURCES


def compiled(cache: Path, name: str) -> Path:
    """What Python keeps of a module."""
    (path,) = (cache / "mechanism_fmu_aaa" / "models" / "__pycache__").glob(f"{name}.*.pyc")
    return path


def other_code(path: Path) -> bytes:
    """Compiled code that Python would take for that of the source, but that does something else."""
    forged = compile("import pathlib; pathlib.Path(__file__).with_name('was_here').touch(); MODEL = 1", "x", "exec")
    return path.read_bytes()[:16] + marshal.dumps(forged)


#: What becomes of compiled code.
CODE_DAMAGES: dict[str, Callable[[Path], object]] = {
    "cut off": lambda path: os.truncate(path, path.stat().st_size - 40),
    "cut off in its digest": lambda path: os.truncate(path, path.stat().st_size - 1),
    "emptied": lambda path: path.write_bytes(b""),
    "one bit": lambda path: path.write_bytes(path.read_bytes()[:30] + b"\xff" + path.read_bytes()[31:]),
    "replaced": lambda path: path.write_bytes(other_code(path)),
    "gone": lambda path: path.unlink(),
    "a folder": lambda path: (path.unlink(), path.mkdir()),
}


@pytest.mark.parametrize("damage", CODE_DAMAGES)
def test_compiled_code_is_read_as_it_was_written_or_not_at_all(
    damage: str, tmp_path: Path, cache: Path, load: Load, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    monkeypatch.setattr(sys, "pycache_prefix", None)
    resources = write_resources(tmp_path / "unzipped", "aaa")
    load(resources, "aaa").slave_class("mechanism_fmu_aaa", "models.tiny")
    path = compiled(cache, "tiny")
    whole = path.read_bytes()
    CODE_DAMAGES[damage](path)
    assert load(resources, "aaa").slave_class("mechanism_fmu_aaa", "models.tiny").__name__ == "Tiny"
    assert not list(cache.rglob("was_here"))
    if damage != "a folder":
        assert path.read_bytes() == whole


def test_whole_compiled_code_is_used(tmp_path: Path, cache: Path, load: Load, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    monkeypatch.setattr(sys, "pycache_prefix", None)
    resources = write_resources(tmp_path / "unzipped", "aaa")
    for _ in range(2):
        start = load(resources, "aaa")
        compilations: list[object] = []
        count = compilations.append
        monkeypatch.setattr(
            start.CheckedLoader,
            "source_to_code",
            lambda self, *a, count=count, **k: (count(a), SourceFileLoader.source_to_code(self, *a, **k))[1],
        )
        start.slave_class("mechanism_fmu_aaa", "models.tiny")
    assert compilations == []


def with_bytecode(resources: Path) -> None:
    """As the FMU is built: compiled code beside the sources."""
    package = resources / "mechanism_fmu_aaa"
    sources = {path.relative_to(package).as_posix(): path.read_bytes() for path in package.rglob("*.py")}
    for name, code in bytecode(sources).items():
        (package / name).parent.mkdir(exist_ok=True)
        (package / name).write_bytes(code)


@pytest.mark.parametrize("change", ["none", "source", "digest", "python"])
def test_the_first_start_takes_what_was_compiled_for_this_python_and_these_sources(
    change: str, tmp_path: Path, cache: Path, load: Load, monkeypatch: pytest.MonkeyPatch
) -> None:
    resources = write_resources(tmp_path / "unzipped", "aaa")
    with_bytecode(resources)
    tiny = resources / "mechanism_fmu_aaa" / "models" / "tiny.py"
    kept = tiny.parent / "__pycache__" / f"tiny.{sys.implementation.cache_tag}.pyc"
    if change == "source":
        tiny.write_text(tiny.read_text(encoding="utf-8") + "\n# another line\n", encoding="utf-8")
    elif change == "digest":
        kept.write_bytes(other_code(kept))
    elif change == "python":
        kept.rename(kept.with_name("tiny.cpython-310.pyc"))
    start = load(resources, "aaa")
    compilations: list[str] = []
    monkeypatch.setattr(
        start.CheckedLoader,
        "source_to_code",
        lambda self, data, path, **k: (
            compilations.append(path),
            SourceFileLoader.source_to_code(self, data, path, **k),
        )[1],
    )
    assert start.slave_class("mechanism_fmu_aaa", "models.tiny").__name__ == "Tiny"
    assert [Path(path).name for path in compilations] == ([] if change == "none" else ["tiny.py"])
    assert not list(cache.rglob("was_here"))
    assert {path.suffix for path in cache.rglob("*") if path.is_file()} <= {".py", ".pyc"}


def test_compiled_sources_lie_beside_them_wherever_python_keeps_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    tag = sys.implementation.cache_tag
    monkeypatch.setattr(sys, "pycache_prefix", "/somewhere/else")
    assert set(bytecode({"a/b.py": b"", "c.py": b""})) == {f"a/__pycache__/b.{tag}.pyc", f"__pycache__/c.{tag}.pyc"}


def test_a_source_that_cannot_be_written_compiled_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """As one with a constant that only later forms of marshal know."""
    usual = marshal.dumps

    def dumps(code: Any, version: int) -> bytes:
        if "NEW" in code.co_names:
            raise ValueError("unmarshallable object")
        return usual(code, version)

    monkeypatch.setattr(marshal, "dumps", dumps)
    assert [name.partition(".")[0] for name in bytecode({"a.py": b"NEW = 1", "b.py": b"OLD = 1"})] == ["__pycache__/b"]


def test_compiled_sources_are_the_same_bytes_whatever_else_is_loaded() -> None:
    program = (
        "import sys; names = [sys.intern(f'name_{k}') for k in range(3)]; from mechanism_fmu.fmu.parts.bytecode import "
        'bytecode; sys.stdout.buffer.write(b\'\'.join(bytecode({\'a.py\': b\'name_1 = {"x", "y", "z"}; '
        'print(name_1 in (1, 2)) if name_1 in {"p", "q"} else 0\'}).values()))'
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    found = {
        subprocess.run(
            [sys.executable, "-c", f"{more}{program}"],
            env={**environment, "PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        ).stdout
        for seed, more in (("1", ""), ("2", ""), ("3", "import numpy, decimal; "))
    }
    assert len(found) == 1


@pytest.mark.parametrize("name", [f"tiny{EXTENSION_SUFFIXES[0]}", f"tiny{EXTENSION_SUFFIXES[-1]}"])
def test_no_library_stands_in_for_a_source(name: str, tmp_path: Path, cache: Path, load: Load) -> None:
    """Python looks for libraries first."""
    resources = write_resources(tmp_path / "unzipped", "aaa")
    load(resources, "aaa").slave_class("mechanism_fmu_aaa", "models.tiny")
    planted = cache / "mechanism_fmu_aaa" / "models" / name
    planted.write_text("MODEL = 1")
    assert load(resources, "aaa").slave_class("mechanism_fmu_aaa", "models.tiny").__name__ == "Tiny"
