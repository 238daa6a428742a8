import ast
import os
import subprocess
import sys
import textwrap
import tomllib
from pathlib import Path

import pytest
from start_resources import SOURCES, START, Load, contents, write_resources

import mechanism_fmu.fmu.start as original


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
