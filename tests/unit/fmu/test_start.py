import ast
import importlib.util
import marshal
import os
import shutil
import subprocess
import sys
import textwrap
import tomllib
from collections.abc import Callable, Iterator
from importlib.machinery import EXTENSION_SUFFIXES, SourceFileLoader
from pathlib import Path
from types import ModuleType

import pytest

import mechanism_fmu.fmu.start as original

START = Path(original.__file__)

#: A package as an FMU carries it, reduced to what the start module touches.
SOURCES = {
    "__init__.py": "",
    "fmu/__init__.py": "",
    "fmu/instance/slave.py": "def make_slave_class(model):\n    return type(model, (), {'made_in': __file__})\n",
    "models/tiny.py": "MODEL = 'Tiny'\n",
}


def write_resources(folder: Path, digest: str, sources: dict[str, str] = SOURCES) -> Path:
    """The resources folder of an FMU."""
    for name, text in sources.items():
        path = folder / f"mechanism_fmu_{digest}" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    shutil.copy(START, folder / f"start_{digest}.py")
    (folder / "requirements.txt").write_text("numba>=0.68,<0.69\nnumpy>=2.0\n")
    return folder


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("MECHANISM_FMU_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "mechanism_fmu"


@pytest.fixture
def load() -> Iterator[Callable[[Path, str], ModuleType]]:
    """Import the start module of a resources folder, as in a new process."""
    before, path = set(sys.modules), sys.path[:]

    def forget() -> None:
        for name in set(sys.modules) - before:
            if name.startswith(("mechanism_fmu_", "start_")):
                del sys.modules[name]

    def load(resources: Path, digest: str) -> ModuleType:
        forget()
        spec = importlib.util.spec_from_file_location(f"start_{digest}", resources / f"start_{digest}.py")
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    yield load
    forget()
    sys.path[:] = path


Load = Callable[[Path, str], ModuleType]


def contents(folder: Path) -> dict[str, str]:
    return {
        p.relative_to(folder).as_posix(): p.read_text() for p in folder.rglob("*") if p.suffix != ".pyc" and p.is_file()
    }


def test_the_package_is_imported_from_the_cache(tmp_path: Path, cache: Path, load: Load) -> None:
    slave = load(write_resources(tmp_path / "unzipped", "aaa"), "aaa").slave_class("mechanism_fmu_aaa", "models.tiny")
    assert slave.__name__ == "Tiny"
    assert Path(slave.made_in) == cache / "mechanism_fmu_aaa" / "fmu" / "instance" / "slave.py"
    assert contents(cache / "mechanism_fmu_aaa") == SOURCES


def test_the_same_class_comes_back(tmp_path: Path, cache: Path, load: Load) -> None:
    start = load(write_resources(tmp_path, "aaa"), "aaa")
    first = start.slave_class("mechanism_fmu_aaa", "models.tiny")
    assert start.slave_class("mechanism_fmu_aaa", "models.tiny") is first


def test_importing_leaves_the_module_search_path_alone(tmp_path: Path, cache: Path, load: Load) -> None:
    before = sys.path[:]
    load(write_resources(tmp_path, "aaa"), "aaa").slave_class("mechanism_fmu_aaa", "models.tiny")
    assert sys.path == before


def test_the_second_start_from_another_folder_writes_nothing(tmp_path: Path, cache: Path, load: Load) -> None:
    for unzipped in ("one", "two"):
        start = load(write_resources(tmp_path / unzipped, "aaa"), "aaa")
        start.slave_class("mechanism_fmu_aaa", "models.tiny")
        inodes = {p: p.stat().st_ino for p in cache.rglob("*.py")}
        if unzipped == "one":
            first = inodes
    assert inodes == first
    assert len(inodes) == len(SOURCES)


#: Deletes the package that it stands in, the first time that it is imported.
VANISHING = """
import shutil
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


@pytest.mark.parametrize("name", [f"tiny{EXTENSION_SUFFIXES[0]}", f"tiny{EXTENSION_SUFFIXES[-1]}"])
def test_no_library_stands_in_for_a_source(name: str, tmp_path: Path, cache: Path, load: Load) -> None:
    """Python looks for libraries first."""
    resources = write_resources(tmp_path / "unzipped", "aaa")
    load(resources, "aaa").slave_class("mechanism_fmu_aaa", "models.tiny")
    planted = cache / "mechanism_fmu_aaa" / "models" / name
    planted.write_text("MODEL = 1")
    assert load(resources, "aaa").slave_class("mechanism_fmu_aaa", "models.tiny").__name__ == "Tiny"


def test_leftovers_of_a_killed_process_do_no_harm(tmp_path: Path, cache: Path, load: Load) -> None:
    (cache / "mechanism_fmu_aaa" / "fmu").mkdir(parents=True)
    (cache / "mechanism_fmu_aaa" / "fmu" / "tmpabc").write_text("def make_sl")
    start = load(write_resources(tmp_path / "unzipped", "aaa"), "aaa")
    assert start.slave_class("mechanism_fmu_aaa", "models.tiny").__name__ == "Tiny"


def test_a_cache_that_cannot_be_written_costs_a_warning(tmp_path: Path, cache: Path, load: Load) -> None:
    cache.parent.write_text("a file where the cache should be")
    start = load(write_resources(tmp_path / "unzipped", "aaa"), "aaa")
    with pytest.warns(RuntimeWarning, match="MECHANISM_FMU_CACHE"):
        slave = start.slave_class("mechanism_fmu_aaa", "models.tiny")
    assert slave.__name__ == "Tiny"
    assert not Path(slave.made_in).is_relative_to(tmp_path)


def test_the_fallback_folder_goes_with_its_process(tmp_path: Path) -> None:
    (tmp_path / "cache").write_text("a file where the cache should be")
    made_in = run(write_resources(tmp_path / "unzipped", "aaa"), tmp_path / "cache")
    assert made_in.name == "slave.py"
    assert not made_in.parents[2].exists()


def test_processes_that_start_at_once_all_succeed(tmp_path: Path) -> None:
    many = SOURCES | {f"engine/part_{i}.py": f"# {'x' * 20000}\nVALUE = {i}\n" for i in range(30)}
    resources = write_resources(tmp_path / "unzipped", "aaa", many)
    processes = [spawn(resources, tmp_path / "cache") for _ in range(6)]
    assert [(p.wait(), p.stderr.read() if p.stderr else "") for p in processes] == [(0, "")] * 6
    assert contents(tmp_path / "cache" / "mechanism_fmu" / "mechanism_fmu_aaa") == many
    for process in processes:
        process.communicate()


def spawn(resources: Path, cache: Path) -> subprocess.Popen[str]:
    code = "import start_aaa as s; print(s.slave_class('mechanism_fmu_aaa', 'models.tiny').made_in)"
    return subprocess.Popen(
        [sys.executable, "-W", "ignore", "-c", code],
        env=os.environ | {"PYTHONPATH": str(resources), "MECHANISM_FMU_CACHE": str(cache)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def run(resources: Path, cache: Path) -> Path:
    output, errors = spawn(resources, cache).communicate()
    assert errors == ""
    return Path(output.strip())


def test_two_fmus_in_one_process_each_run_their_own_code(tmp_path: Path, cache: Path) -> None:
    for digest in ("aaa", "bbb"):
        write_resources(tmp_path, digest, SOURCES | {"models/tiny.py": f"MODEL = 'Tiny_{digest}'\n"})
    code = textwrap.dedent(
        """
        import start_aaa, start_bbb
        print(start_aaa.slave_class("mechanism_fmu_aaa", "models.tiny").__name__)
        print(start_bbb.slave_class("mechanism_fmu_bbb", "models.tiny").__name__)
        """
    )
    env = os.environ | {"PYTHONPATH": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["Tiny_aaa", "Tiny_bbb"]


def test_a_missing_package_is_named_with_what_to_install(
    tmp_path: Path, cache: Path, load: Load, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = SOURCES | {"fmu/instance/slave.py": "import no_such_numba\n"}
    start = load(write_resources(tmp_path, "aaa", broken), "aaa")
    with pytest.raises(ImportError, match="there is no no_such_numba") as caught:
        start.slave_class("mechanism_fmu_aaa", "models.tiny")
    assert "python -m pip install 'numba>=0.68,<0.69' 'numpy>=2.0'" in str(caught.value)
    assert str(caught.value) in capsys.readouterr().err


def test_a_failed_start_can_be_repeated(tmp_path: Path, cache: Path, load: Load) -> None:
    broken = SOURCES | {"models/tiny.py": "import os\nMODEL = os.environ['NAME_OF_MODEL']\n"}
    start = load(write_resources(tmp_path, "aaa", broken), "aaa")
    with pytest.raises(KeyError):
        start.slave_class("mechanism_fmu_aaa", "models.tiny")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("NAME_OF_MODEL", "Late")
        assert start.slave_class("mechanism_fmu_aaa", "models.tiny").__name__ == "Late"


def test_an_old_python_is_refused(tmp_path: Path, cache: Path, load: Load, monkeypatch: pytest.MonkeyPatch) -> None:
    start = load(write_resources(tmp_path, "aaa"), "aaa")
    monkeypatch.setattr(sys, "version_info", (3, 10, 9))
    with pytest.raises(ImportError, match=r"needs Python 3\.11 or later"):
        start.slave_class("mechanism_fmu_aaa", "models.tiny")


def test_the_oldest_python_is_the_projects() -> None:
    project = START.parents[2] / "pyproject.toml"
    required = tomllib.loads(project.read_text())["project"]["requires-python"]
    assert required == f">={'.'.join(map(str, original._PYTHON))}"


def test_the_start_module_needs_the_standard_library_only() -> None:
    imported = {
        alias.name if isinstance(node, ast.Import) else node.module
        for node in ast.walk(ast.parse(START.read_text()))
        if isinstance(node, ast.Import | ast.ImportFrom)
        for alias in node.names
    }
    assert {str(name).partition(".")[0] for name in imported} <= sys.stdlib_module_names


@pytest.mark.parametrize(
    ("platform", "variables", "expected"),
    [
        ("linux", {"XDG_CACHE_HOME": "/xdg"}, "/xdg"),
        ("linux", {"HOME": "/home/me"}, "/home/me/.cache"),
        ("darwin", {"HOME": "/Users/me"}, "/Users/me/Library/Caches"),
        ("win32", {"LOCALAPPDATA": "/local"}, "/local"),
        ("linux", {"MECHANISM_FMU_CACHE": "/chosen", "XDG_CACHE_HOME": "/xdg"}, "/chosen"),
    ],
)
def test_the_cache_directory_is_the_systems(
    platform: str, variables: dict[str, str], expected: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("MECHANISM_FMU_CACHE", "XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(sys, "platform", platform)
    assert original.cache_directory() == Path(expected)


def test_tidying_up_keeps_one_entry_and_returns_the_borrowed_reference(
    tmp_path: Path, load: Load, monkeypatch: pytest.MonkeyPatch
) -> None:
    start = load(write_resources(tmp_path, "aaa"), "aaa")
    monkeypatch.setattr(sys, "path", ["elsewhere"])
    slave_globals: dict[str, object] = {"__name__": "Tiny_aaa"}
    references = sys.getrefcount(slave_globals)
    for unzipped in ("one", "one", "two", "three"):
        folder = tmp_path / unzipped
        folder.mkdir(exist_ok=True)
        (folder / "Tiny_aaa.py").touch()
        sys.path.insert(0, str(folder))
        start.tidy_up(slave_globals)
        assert sys.path == [str(folder), "elsewhere"]
    assert sys.getrefcount(slave_globals) == references + 4


def test_tidying_up_leaves_entries_of_others_alone(tmp_path: Path, load: Load, monkeypatch: pytest.MonkeyPatch) -> None:
    start = load(write_resources(tmp_path, "aaa"), "aaa")
    monkeypatch.setattr(sys, "path", ["elsewhere", "elsewhere"])
    start.tidy_up({"__name__": "Tiny_aaa"})
    assert sys.path == ["elsewhere", "elsewhere"]
