"""Contents of a model's FMU in every flavour, and the source files that it needs."""

from __future__ import annotations

import ast
import inspect
import keyword
import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from xml.etree.ElementTree import Element, SubElement

from ...model import MechanismError, Model
from ...model.baked import NOTHING_BAKED, Baked, baked_model
from .documentation import documentation
from .model_description import NO_SOURCES, to_bytes
from .resources import analysis, drawing, logic, terminals

# Which source files an FMU needs: what is reachable by imports, and nothing else.


@dataclass(frozen=True)
class Home:
    """A source folder and the place of its files in the package that travels.

    Attributes:
        name: absolute name by which others import it, e.g. "mechanism_fmu" or "models.ratchet".
        folder: the source folder.
        place: dotted path within the package that travels; "" is its root.
        is_package: whether the folder's own `__init__.py` travels, if there is one.
    """

    name: str
    folder: Path
    place: str
    is_package: bool = True


@dataclass
class Closure:
    """What is reachable.

    Attributes:
        files: source text of each file, by its path in the package that travels ("model/body.py").
        external: top-level packages that must be installed.
        importers: of each of them, a file and line that import it.
    """

    files: dict[str, str] = field(default_factory=dict)
    external: set[str] = field(default_factory=set)
    importers: dict[str, str] = field(default_factory=dict)


def closure(homes: tuple[Home, ...], modules: tuple[str, ...]) -> Closure:
    """Collect the files that `modules` need, with imports of the homes made relative.

    Imports inside functions count; those under `if TYPE_CHECKING:` do not, because they never run.

    Args:
        homes: the source folders.
        modules: dotted paths within the package that travels, e.g. "fmu.instance.slave".

    Raises:
        MechanismError: a home is imported in a way that cannot be made relative.
    """
    found = Closure()
    waiting = list(modules)
    seen: set[str] = set()
    while waiting:
        module = waiting.pop()
        if module in seen:
            continue
        seen.add(module)
        # Python runs the __init__ of every package on the way.
        if module:
            waiting.append(module.rpartition(".")[0])
        path = _locate(homes, module)
        if path is None:
            continue
        source = path.read_text(encoding="utf-8-sig")  # some editors of Windows put a mark in front
        package = module if path.name == "__init__.py" else module.rpartition(".")[0]
        relative = "/".join(filter(None, (*package.split("."), path.name)))
        tree = ast.parse(source, str(path))
        found.files[relative] = _with_relative_imports(source, tree, path, package, homes)
        for imported in _imports(tree):
            inside = _inside(imported, package, homes)
            if inside is None:
                name = imported.module.partition(".")[0]
                found.external.add(name)
                found.importers.setdefault(name, f"{path}, line {imported.line}")
            else:
                waiting += [inside, *(f"{inside}.{name}".lstrip(".") for name in imported.names)]
    found.external -= sys.stdlib_module_names
    return found


@dataclass(frozen=True)
class _Import:
    """`from <level dots><module> import <names>`; `import <module>` has no names."""

    module: str
    level: int
    names: tuple[str, ...]
    line: int


def _imports(node: ast.AST, run: bool = True) -> Iterator[_Import]:
    """Imports of a tree; with `run` only those that can run."""
    yield from _imports_of(node)
    # An import is a statement, and only these parts of a statement hold others.
    parts: tuple[str, ...] = ("body", "orelse", "finalbody", "handlers", "cases")
    if run and isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
        parts = ("orelse",)
    for part in parts:
        for child in getattr(node, part, ()):
            yield from _imports(child, run)


def _imports_of(statement: ast.AST) -> Iterator[_Import]:
    if isinstance(statement, ast.Import):
        yield from (_Import(alias.name, 0, (), statement.lineno) for alias in statement.names)
    elif isinstance(statement, ast.ImportFrom):
        names = tuple(alias.name for alias in statement.names)
        yield _Import(statement.module or "", statement.level, names, statement.lineno)


def _inside(imported: _Import, package: str, homes: tuple[Home, ...]) -> str | None:
    """Dotted path of an imported module within the package that travels; None if it is not in there."""
    if imported.level:
        parents = package.split(".") if package else []
        base = parents[: len(parents) + 1 - imported.level]
        return ".".join([*base, *filter(None, [imported.module])])
    for home in homes:
        if imported.module == home.name or imported.module.startswith(f"{home.name}."):
            return (home.place + imported.module[len(home.name) :]).lstrip(".")
    return None


def _locate(homes: tuple[Home, ...], module: str) -> Path | None:
    """The file of a module: in the innermost home of its place, and nowhere else."""
    if any(home.place.startswith(f"{module}.") for home in homes):
        return None  # it leads to a home; in a wheel, the library has files there that are not the model's
    around = [home for home in homes if home.place in ("", module) or module.startswith(f"{home.place}.")]
    home = max(around, key=lambda home: len(home.place), default=None)
    if home is None or (home.place == module and not home.is_package):
        return None
    inner = module[len(home.place) :].strip(".").replace(".", "/")
    paths = (home.folder / inner / "__init__.py", home.folder / f"{inner}.py")
    return next((path for path in paths if path.is_file()), None)


def _with_relative_imports(source: str, tree: ast.Module, path: Path, package: str, homes: tuple[Home, ...]) -> str:
    """The source with absolute imports of the homes written relative: the package travels under another name."""
    lines = source.splitlines(keepends=True)
    to_root = "." * (len(package.split(".")) + 1 if package else 1)
    for imported in _imports(tree, run=False):
        inside = None if imported.level else _inside(imported, package, homes)
        if inside is None:
            continue
        pattern = rf"\bfrom\s+{re.escape(imported.module)}(?=\s+import\b)"
        line, changes = re.subn(pattern, f"from {to_root}{inside}", lines[imported.line - 1], count=1)
        if not changes:
            raise MechanismError(
                f"{path}, line {imported.line}: write 'from {imported.module} import ...' on one line, because the "
                "file travels in an FMU under another package name."
            )
        lines[imported.line - 1] = line
    return "".join(lines)


#: Beginning of the name of the package that a user's own file is loaded into (see `own.load`).
OWN = "own_mechanism_"


@dataclass(frozen=True)
class Origin:
    """Where a model comes from.

    Attributes:
        model: the model.
        folder: of the module that holds it; its neighbours may be imported.
        own: the module is a file of the user's own, and whatever else lies in the folder is none of its business.
        notes: the docstring of such a file, as Markdown.
    """

    model: Model
    folder: Path
    own: bool
    notes: str


def model_of(module: ModuleType, baked: Baked = NOTHING_BAKED) -> Origin:
    """The model that a module holds, with what is baked into this FMU of it, and where it comes from.

    Raises:
        MechanismError: the module has no model, or one whose name no FMU can have, or nothing to bake that into.
    """
    model = getattr(module, "MODEL", None)
    if not isinstance(model, Model) or module.__file__ is None:
        raise MechanismError(f"{module.__name__} holds no model; it must set MODEL = Model(...).")
    if not re.fullmatch(r"[A-Za-z_]\w*", model.name, re.ASCII) or keyword.iskeyword(model.name):
        raise MechanismError(
            f"The model name {model.name!r} cannot name an FMU; use letters, digits and '_', and no Python keyword."
        )
    own = module.__name__.startswith(OWN)
    return Origin(
        baked_model(model, baked), Path(module.__file__).parent, own, inspect.getdoc(module) or "" if own else ""
    )


def file_in(destination: Path, name: str) -> Path:
    """Path of the FMU `name` in the folder `destination`, which is made if need be.

    Raises:
        MechanismError: the destination is no folder.
        OSError: it cannot be made.
    """
    if destination.suffix == ".fmu" or destination.is_file():
        raise MechanismError(
            f"{destination} is not a folder; give the folder for {name} (tools expect that file name)."
        )
    destination.mkdir(parents=True, exist_ok=True)
    return destination / name


def no_sources(model: Model) -> dict[str, bytes]:
    """What a tool meets that wants to compile the FMU for a platform without a binary: an error that says what to do.

    Without it, such tools end in an error of their own (FMPy 0.3: IndexError).
    """
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = SubElement(root, "BuildConfiguration", modelIdentifier=model.name, description="None: see the file")
    SubElement(SubElement(configuration, "SourceFileSet", language="C99"), "SourceFile", name=NO_SOURCES)
    text = (
        f"{model.name} has no C sources: its engine is compiled Python. Platforms with a binary are in its folder "
        "binaries; for others, run mechanism-fmu build there without --flavour native, which needs Python."
    )
    return {"sources/buildDescription.xml": to_bytes(root), f"sources/{NO_SOURCES}": f'#error "{text}"\n'.encode()}


def common_entries(origin: Origin, facts: Sequence[str], licences: Sequence[str], fmi: int = 2) -> dict[str, bytes]:
    """Documentation, drawing, logic, analyses, terminals and icon of a model, by their paths within the FMU.

    Args:
        origin: the model, and its folder with README.md and model.png, if there are any.
        facts: what the documentation says of running this flavour, as HTML.
        licences: distributions whose code travels in the FMU.
        fmi: major version of the standard.
    """
    model, folder = origin.model, None if origin.own else origin.folder
    icons = [*([folder / "model.png"] if folder else []), Path(__file__).with_name("model.png")]
    icon = next(path for path in icons if path.is_file())
    return {
        **documentation(model, folder, facts, licences, origin.notes),
        **drawing(model),
        **logic(model),
        **analysis(model),
        **terminals(model, fmi),
        **no_sources(model),
        "model.png": icon.read_bytes(),
    }
