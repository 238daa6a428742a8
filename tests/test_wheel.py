"""A wheel puts one name at the root of site-packages, and works beside a user's own `models` and `harness`."""

import os
import re
import runpy
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from mechanism_fmu.fmu.native.link import TARGETS, WEB
from mechanism_fmu.fmu.start import CACHE_VARIABLE

ROOT = Path(__file__).parents[1]
TRAVELS = ("mechanism_fmu", "harness", "models", "docs/examples", "docs/joints", "backend")
FILES = ("pyproject.toml", "setup.py", "MANIFEST.in", "README.md", "LICENSE", "build_fmu.py")
MINE = "WHO = 'mine'\n"
#: What a wheel carries of the compiled engine, each file with its digest.
LIBRARIES = {f"libraries/{target.name}{target.suffix}" for target in (*TARGETS, WEB)}
OBJECTS = {f"{target.name}.o" for target in TARGETS}
DIGESTED = LIBRARIES | OBJECTS | {"engine.h", "engine.bc"}
ENGINE = DIGESTED | {f"{path}.sha256" for path in DIGESTED} | {"sources"}
#: As if nothing were installed of what only extras bring.
WITHOUT_EXTRAS = """
import importlib.abc, importlib.util, sys
EXTRAS = ("scipy", "numba", "llvmlite", "ziglang", "pyarrow", "PIL", "plotly", "optuna", "distributed", "dask")
class Refuse(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in EXTRAS:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
sys.meta_path.insert(0, Refuse())
real = importlib.util.find_spec
importlib.util.find_spec = lambda name, *rest: None if name in EXTRAS else real(name, *rest)
"""
#: What everybody gets.
CORE = {"numpy", "deflate", "fmpy", "pythonfmu", "rainflow", "typer", "rich", "markdown-it-py", "pandas"}
COMMAND = "from mechanism_fmu.harness.app.cli import main\nmain(sys.argv[1:])\n"

#: Prints every module below a folder that is loaded under two names, or under a name that its path does not have.
ONE_NAME = """
import pkgutil, sys, importlib, harness, models
from pathlib import Path
import mechanism_fmu
root = Path(mechanism_fmu.__file__).parents[1]
for package in ("mechanism_fmu.harness", "mechanism_fmu.models"):
    package = importlib.import_module(package)
    for found in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        importlib.import_module(found.name)
print(root)
print(harness.WHO, models.WHO, sum(name.startswith("mechanism_fmu.harness.") for name in sys.modules))
files = {}
for name, module in list(sys.modules.items()):
    path = getattr(module, "__file__", None)
    if path and path.startswith(str(root / "mechanism_fmu")):
        files.setdefault(path, set()).add(module.__name__)
        wanted = ".".join(Path(path).relative_to(root).with_suffix("").parts).removesuffix(".__init__")
        if module.__name__ != wanted:
            print("named", module.__name__, "is", path)
print(*(f"{path} {names}" for path, names in files.items() if len(names) > 1))
"""


@pytest.fixture
def relocated() -> Callable[[str, str], str]:
    function: Callable[[str, str], str] = runpy.run_path(str(ROOT / "setup.py"), run_name="not main")["relocated"]
    return function


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("import build_fmu\n", "from mechanism_fmu import build_fmu\n"),
        ("def f():\n    import models\n", "def f():\n    from mechanism_fmu import models\n"),
        ("import models as m  # them\n", "from mechanism_fmu import models as m  # them\n"),
        ("from harness import fmu\n", "from mechanism_fmu.harness import fmu\n"),
        ("from harness.fmu import (\n    Fmu,\n)\n", "from mechanism_fmu.harness.fmu import (\n    Fmu,\n)\n"),
        ('"""Write: import models"""\nfrom . import models\n', None),
        ("import models_of_mine\nfrom harness_of_mine.models import harness\n", None),
        ("from mechanism_fmu.model import Model\n", None),
        ("text = '\x0c'\r\nimport numpy\n", None),
    ],
)
def test_imports_of_what_moves_are_written_anew_and_nothing_else(
    before: str, after: str | None, relocated: Callable[[str, str], str]
) -> None:
    assert relocated(before, "file.py") == (before if after is None else after)


@pytest.mark.parametrize("line", ["import harness.fmu", "import os, models", "from  harness import fmu"])
def test_an_import_that_cannot_be_written_anew_stops_the_build(line: str, relocated: Callable[[str, str], str]) -> None:
    from setuptools.errors import SetupError

    with pytest.raises(SetupError, match=r"file\.py, line 2: .*write 'from"):
        relocated(f"\n{line}\n", "file.py")


def test_entry_points_lead_to_where_a_wheel_has_what_moves() -> None:
    moved = runpy.run_path(str(ROOT / "setup.py"), run_name="not main")["moved_entries"]
    text = "[console_scripts]\na = mechanism_fmu.__main__:main\n[x]\nb = harness.page.shown:show\nc = harnesses:d\n"
    assert moved(text) == text.replace("b = harness.", "b = mechanism_fmu.harness.")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built of a source distribution, in whose place an earlier version has left modules."""
    folder = tmp_path_factory.mktemp("wheel")
    source = folder / "source"
    for name in TRAVELS:
        shutil.copytree(ROOT / name, source / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name in FILES:
        shutil.copy(ROOT / name, source / name)
    program = "from setuptools.build_meta import build_sdist; print(build_sdist('dist'))"
    called([sys.executable, "-c", program], source)
    shutil.unpack_archive(next((source / "dist").glob("*.tar.gz")), folder, filter="data")
    unpacked = next(folder.glob("mechanism_fmu-*"))
    for left in ("harness/old.py", "mechanism_fmu/models/old.py"):
        (unpacked / "build" / "lib" / left).parent.mkdir(parents=True)
        (unpacked / "build" / "lib" / left).touch()
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check"]
    called([*pip, "wheel", ".", "--no-deps", "--no-build-isolation", "-w", "dist"], unpacked)
    return next((unpacked / "dist").glob("*.whl"))


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("installed")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check"]
    called([*pip, "install", "--no-deps", "--no-compile", "--target", str(folder), str(wheel)], folder)
    return folder


@pytest.fixture
def python(installed: Path, tmp_path: Path) -> Callable[..., str]:
    """Runs Python in a folder with a user's own packages, with the installed wheel and without the checkout.

    `-S` leaves out the .pth files, among which an editable install is; what is installed otherwise is on the path. Not
    so all of `sys.path`: FMUs that other tests have run in this process have put their folders there.
    """
    for name in ("harness", "models"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text(MINE)
    (tmp_path / "build_fmu.py").write_text(MINE)
    others = dict.fromkeys(sysconfig.get_path(kind) for kind in ("purelib", "platlib"))
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(installed), *others])}

    def run(*arguments: str | Path) -> str:
        return called([sys.executable, "-S", *map(str, arguments)], tmp_path, environment)

    return run


def called(command: list[str], folder: Path, environment: dict[str, str] | None = None) -> str:
    done = subprocess.run(
        command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


def tree(folder: Path) -> set[str]:
    paths = (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    return {path.as_posix() for path in paths if "__pycache__" not in path.parts}


@pytest.mark.slow
def test_the_wheel_has_one_name_at_its_root_and_everything_below_it(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if not name.endswith("/")}
        facts = {Path(name).name: archive.read(name).decode() for name in names if ".dist-info/" in name}
    assert facts["top_level.txt"] == "mechanism_fmu\n"
    assert "mechanism-fmu = mechanism_fmu.__main__:main" in facts["entry_points.txt"]
    assert "show = mechanism_fmu.harness.page.shown:show" in facts["entry_points.txt"]
    below = {name.removeprefix("mechanism_fmu/") for name in names if name.startswith("mechanism_fmu/")}
    assert {name.partition("/")[0] for name in names} == {"mechanism_fmu", wheel.name.rsplit("-", 3)[0] + ".dist-info"}
    expected = tree(ROOT / "mechanism_fmu") | {"build_fmu.py"}
    expected |= {f"{name}/{path}" for name in ("harness", "models", "docs/examples") for path in tree(ROOT / name)}
    expected |= {f"docs/joints/{path.name}" for path in (ROOT / "docs" / "joints").glob("*.svg")}
    expected |= {f"fmu/native/compiled/{path}" for path in ENGINE}
    assert below == expected


@pytest.mark.slow
def test_no_module_has_two_names_and_the_users_own_are_not_hidden(python: Callable[..., str], installed: Path) -> None:
    root, counted, *lines = python("-c", ONE_NAME).splitlines()
    assert Path(root) == installed
    mine, also_mine, count = counted.split()
    assert (mine, also_mine) == ("mine", "mine")
    assert int(count) > 50
    assert "".join(lines) == ""


@pytest.mark.slow
def test_the_command_builds_the_fmu_of_the_tree_and_runs_it(
    python: Callable[..., str], tmp_path: Path, ratchet_fmu: Path
) -> None:
    assert python("-m", "mechanism_fmu", "--version").startswith("mechanism-fmu ")
    python("-m", "mechanism_fmu", "build", "ratchet")
    assert (tmp_path / "build" / "Ratchet.fmu").read_bytes() == ratchet_fmu.read_bytes()
    said = python("-m", "mechanism_fmu", "run", "build/Ratchet.fmu", "--stop-time", "1", "--step", "0.01")
    assert "report.html" in said
    impacts = (tmp_path / "result" / "impacts.csv").read_text().splitlines()
    assert len(impacts) == 2
    first = dict(zip(impacts[0].split(","), impacts[1].split(","), strict=True))
    assert float(first["time"]) == pytest.approx(0.9399211769, abs=1e-9)
    assert float(first["stress_max"]) == pytest.approx(16080.32337, rel=1e-7)


@pytest.mark.slow
def test_nothing_is_compiled_where_it_is_installed(
    python: Callable[..., str], tmp_path: Path, ratchet_fmu: Path
) -> None:
    """Commands, an FMU that carries the engine, a run without an FMU: with an empty cache, without any extra."""
    bare = f"import os\nos.environ[{CACHE_VARIABLE!r}] = {str(tmp_path / 'cache')!r}\n" + WITHOUT_EXTRAS

    def command(*words: str) -> str:
        return python("-c", bare + COMMAND, *words)

    command("demo", "-o", "demo")
    assert (tmp_path / "demo" / "Ratchet.fmu").read_bytes() == ratchet_fmu.read_bytes()
    assert (tmp_path / "demo" / "report.html").is_file()
    command("new", "linkage", "--like", "four_bar")
    assert "No mistakes" in command("check", "linkage.py")
    command("build", "linkage.py", "-o", "own")
    command("run", next((tmp_path / "own").glob("*.fmu")).as_posix(), "-o", "own")
    assert (tmp_path / "own" / "results.csv").is_file()
    command("validate", "demo/Ratchet.fmu")
    assert "Transitions" in command("modes", "demo/Ratchet.fmu")
    command("examples", "--copy")
    machine = (tmp_path / "examples" / "geared_cam.toml").read_text()
    (tmp_path / "geared_cam.toml").write_text(re.sub("(model = .*)", r'\1\nflavour = "pythonfmu"', machine))
    command("machine", "run", "geared_cam.toml", "-o", "machine")
    assert {"results.csv", "report.html"} <= tree(tmp_path / "machine")
    command("doctor")
    run = """
from mechanism_fmu.models.ratchet.model import MODEL
from mechanism_fmu.simulation import Simulation
simulation = Simulation(MODEL.build(MODEL.values()))
simulation.advance(2.0)
print(simulation.read()["impact_count"])
"""
    assert float(python("-c", bare + run)) >= 1
    show = "from mechanism_fmu.models.ratchet.model import MODEL\nprint(len(MODEL.show().html))\n"
    assert int(python("-c", bare + show)) > 100_000
    command("new", "lever")
    command("page", "lever.py")
    assert 100_000 < (tmp_path / "lever.html").stat().st_size < 1_000_000
    assert not list((tmp_path / "cache").rglob("native_*"))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "extra"),
    [
        (["sweep", "examples/teeth.toml"], "designs"),
        (["optimise", "examples/best_tooth.toml"], "designs"),
        (["ked", "four_bar_path_generator"], "analysis"),
        (["reproduce"], "analysis"),
    ],
    ids=["sweep", "optimise", "ked", "reproduce"],
)
def test_a_command_that_needs_an_extra_says_which(
    words: list[str], extra: str, python: Callable[..., str], tmp_path: Path
) -> None:
    python("-m", "mechanism_fmu", "examples", "--copy")
    code = "try:\n    main(sys.argv[1:])\nexcept SystemExit as end:\n    print('exit', end.code)\n"
    program = WITHOUT_EXTRAS + COMMAND.replace("main(sys.argv[1:])\n", code)
    said = python("-c", program, *words).splitlines()
    assert f'Install it: python -m pip install "mechanism_fmu[{extra}]"' in said[0]
    assert said[1:] == ["exit 2"]


@pytest.mark.slow
def test_what_is_installed_without_extras_is_little(wheel: Path) -> None:
    """What weighs much and few need is in extras only (docs/install.md has the sizes)."""
    with zipfile.ZipFile(wheel) as archive:
        name = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        lines = archive.read(name).decode().partition("\n\n")[0].splitlines()
    stated = [line.removeprefix("Requires-Dist: ") for line in lines if line.startswith("Requires-Dist: ")]
    core = {re.split(r"[^\w-]", text)[0] for text in stated if "extra ==" not in text}
    assert core == CORE


@pytest.mark.slow
def test_an_engine_of_other_sources_is_not_used(python: Callable[..., str], installed: Path, tmp_path: Path) -> None:
    asked = "from mechanism_fmu.fmu.native.objects import is_bundled; print(is_bundled())"
    assert python("-c", asked).split() == ["True"]
    source = installed / "mechanism_fmu" / "engine" / "vectors.py"
    before = source.read_text()
    try:
        source.write_text(before + "# changed\n")
        assert python("-c", asked).split() == ["False"]
    finally:
        source.write_text(before)


@pytest.mark.slow
def test_the_examples_are_inside_and_begin_with_the_names_of_the_wheel(
    python: Callable[..., str], tmp_path: Path
) -> None:
    python("-m", "mechanism_fmu", "examples", "--copy")
    assert tree(tmp_path / "examples") == tree(ROOT / "docs" / "examples")
    machine = (tmp_path / "examples" / "indexing_machine.py").read_text()
    assert "\nfrom mechanism_fmu.build_fmu import Flavour, build\n" in machine
    python("-c", "import runpy; runpy.run_path('examples/indexing_machine.py', run_name='not main')")
