from pathlib import Path

import pytest

from mechanism_fmu.fmu.parts.contents import Closure, Home, closure
from mechanism_fmu.model import MechanismError


@pytest.fixture
def homes(tmp_path: Path) -> tuple[Home, Home]:
    library, model = tmp_path / "library", tmp_path / "zoo" / "ratchet"
    for folder in (library / "engine", model):
        folder.mkdir(parents=True)
    for folder in (library, library / "engine", model):
        (folder / "__init__.py").write_text("")
    return Home("library", library, ""), Home("zoo.ratchet", model, "models.ratchet")


def write(home: Home, name: str, text: str) -> None:
    (home.folder / name).write_text(text, encoding="utf-8")


def names(found: Closure) -> set[str]:
    return {name for name in found.files if not name.endswith("__init__.py")}


def test_only_what_is_reachable_is_found(homes: tuple[Home, Home]) -> None:
    write(homes[0], "start.py", "from .engine.stepper import step\nfrom . import codes\n")
    write(homes[0], "codes.py", "")
    write(homes[0], "plots.py", "import matplotlib\n")
    write(homes[0], "engine/stepper.py", "import math\nimport numpy as np\nfrom .. import codes\nstep = 1\n")
    found = closure(homes, ("start",))
    assert set(found.files) == {"__init__.py", "start.py", "codes.py", "engine/__init__.py", "engine/stepper.py"}
    assert found.external == {"numpy"}


def test_the_init_files_on_the_way_are_followed(homes: tuple[Home, Home]) -> None:
    write(homes[0], "engine/__init__.py", "from .stepper import step\n")
    write(homes[0], "engine/stepper.py", "step = 1\n")
    write(homes[0], "engine/views.py", "")
    assert names(closure(homes, ("engine.views",))) == {"engine/stepper.py", "engine/views.py"}


def test_imports_inside_functions_count_and_those_for_type_checkers_do_not(homes: tuple[Home, Home]) -> None:
    write(
        homes[0],
        "start.py",
        "from typing import TYPE_CHECKING\n"
        "if TYPE_CHECKING:\n    from .types import T\n"
        "else:\n    from .real import T\n"
        "def f():\n    from .late import g\n",
    )
    for name in ("types", "late", "real"):
        write(homes[0], f"{name}.py", "")
    assert names(closure(homes, ("start",))) == {"start.py", "late.py", "real.py"}


def test_the_librarys_own_models_do_not_travel_with_a_model(homes: tuple[Home, Home]) -> None:
    """A wheel has the ready-made models inside the library: an FMU of one is the same from there as from the tree."""
    folder = homes[0].folder / "models" / "ratchet"
    folder.mkdir(parents=True)
    for path in (folder.parent / "__init__.py", folder / "__init__.py", folder / "teeth.py"):
        path.write_text("import somebody\n")
    write(homes[1], "model.py", "from . import teeth\n")
    assert closure(homes, ("models.ratchet.model",)).files.keys() == {
        "__init__.py", "models/ratchet/__init__.py", "models/ratchet/model.py"
    }  # fmt: skip
    own = Home("own_mechanism_1", homes[1].folder, "models.ratchet", is_package=False)
    found = closure((homes[0], own), ("models.ratchet.model",))
    assert found.files.keys() == {"__init__.py", "models/ratchet/model.py"}
    assert not found.external


def test_two_modules_that_import_each_other_are_found_once(homes: tuple[Home, Home]) -> None:
    write(homes[0], "a.py", "from . import b\n")
    write(homes[0], "b.py", "from . import a\n")
    assert names(closure(homes, ("a",))) == {"a.py", "b.py"}


def test_a_models_imports_become_relative(homes: tuple[Home, Home]) -> None:
    write(homes[0], "codes.py", "")
    write(homes[1], "teeth.py", "")
    text = (
        "# ψ\nfrom library import codes\nfrom library.engine import (\n    x,\n)\nfrom zoo.ratchet.teeth import tooth\n"
    )
    write(homes[1], "model.py", text)
    found = closure(homes, ("models.ratchet.model",))
    assert found.files["models/ratchet/model.py"] == (
        "# ψ\nfrom ... import codes\nfrom ...engine import (\n    x,\n)\nfrom ...models.ratchet.teeth import tooth\n"
    )
    assert names(found) == {"codes.py", "models/ratchet/model.py", "models/ratchet/teeth.py"}


def test_a_name_that_merely_begins_alike_is_somebody_elses(homes: tuple[Home, Home]) -> None:
    write(homes[1], "model.py", "from library_of_congress import book\n")
    found = closure(homes, ("models.ratchet.model",))
    assert found.external == {"library_of_congress"}
    assert found.files["models/ratchet/model.py"] == "from library_of_congress import book\n"


def test_a_plain_import_of_the_library_is_refused_with_the_line(homes: tuple[Home, Home]) -> None:
    write(homes[1], "model.py", "\nimport library.engine\n")
    with pytest.raises(MechanismError, match=r"model\.py, line 2: write 'from library\.engine import"):
        closure(homes, ("models.ratchet.model",))


def test_an_import_that_is_broken_over_lines_is_refused(homes: tuple[Home, Home]) -> None:
    write(homes[1], "model.py", "from \\\n    library import codes\n")
    with pytest.raises(MechanismError, match="line 1: write 'from library import"):
        closure(homes, ("models.ratchet.model",))
