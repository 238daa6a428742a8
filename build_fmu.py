"""Command: build the FMU of a model."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from enum import StrEnum
from os.path import isfile
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

if TYPE_CHECKING:
    from rich.console import Console

    from mechanism_fmu.fmu.native.objects import Report
    from mechanism_fmu.fmu.native.web import WebModule
    from mechanism_fmu.model import Mechanism, Model

    _Loaded = tuple[ModuleType, Path | None, Report, Callable[[str], None]]

# Everything else is imported where it is used: --help must not wait for numba.

_USAGE_ERROR = 2


class Flavour(StrEnum):
    """How an FMU runs: on a Python of the target, or on nothing but itself."""

    PYTHONFMU = "pythonfmu"
    NATIVE = "native"


def build(
    model: Annotated[
        str | None,
        typer.Argument(
            help="Name of a ready-made model, e.g. 'ratchet' (see --list), or file of your own mechanism.",
            show_default=False,
        ),
    ] = None,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Folder for the FMU; it is made if need be.", file_okay=False)
    ] = Path("build"),
    flavour: Annotated[
        Flavour, typer.Option(help="pythonfmu: needs Python where it runs. native: needs nothing there.")
    ] = Flavour.PYTHONFMU,
    fmi: Annotated[int, typer.Option(min=2, max=3, help="Version of the standard; 3 in the native flavour only.")] = 2,
    clocks: Annotated[
        bool,
        typer.Option(
            "--clocks", help="FMI 3.0 with a clock of impacts and arrays, for tools that use them, in event mode only."
        ),
    ] = False,
    show_list: Annotated[bool, typer.Option("--list", help="List the models and stop.")] = False,
) -> None:
    """Build the FMU of a model: one file for FMI co-simulation.

    `mechanism-fmu build` and `python build_fmu.py` are the same command.
    `python build_fmu.py ratchet -o build/` writes build/Ratchet.fmu, which runs where there is a Python with numpy.
    `python build_fmu.py my_mechanism.py` builds a mechanism of your own: a file that sets MODEL (to begin with one,
    run `mechanism-fmu new my_mechanism`; see docs/tutorials/your-first-mechanism.md).
    With `--flavour native` it needs no Python: binaries for Linux, Windows and macOS; add `--fmi 3` for FMI
    3.0 with event mode and early return at impacts. Where it is built, the native flavour needs the package ziglang
    (`python -m pip install ziglang==0.17.0`). The same sources always give the same GUID.
    \f

    Args:
        model: name of a ready-made model, or file of your own mechanism; None is refused but where models are listed.
        output: folder for the FMU; it is made if need be.
        flavour: pythonfmu needs Python where the FMU runs, native needs nothing there.
        fmi: version of the standard, 2 or 3; 3 in the native flavour only.
        clocks: whether FMI 3.0 comes with a clock of impacts and arrays.
        show_list: whether the models are listed, and nothing is built.

    Raises:
        typer.Exit: it cannot be built; the reason has been said.
    """  # noqa: D301 at \f ends what --help shows
    import models

    if show_list:
        for name in models.available():
            typer.echo(f"{name:12}  {models.load(name).MODEL.description}")
        return
    began = time.perf_counter()
    path = built(model or "", output, flavour, fmi, clocks=clocks, inform=typer.echo)
    seconds = time.perf_counter() - began
    typer.echo(f"{path}  {path.stat().st_size / 1e3:.0f} kB  GUID {_guid(path)}  {seconds:.1f} s")
    advise(flavour)


def built(
    model: str,
    output: Path,
    flavour: Flavour = Flavour.PYTHONFMU,
    fmi: int = 2,
    *,
    starts: Mapping[str, float] | None = None,
    inputs: Mapping[str, tuple[float, float, str | None]] | None = None,
    clocks: bool = False,
    inform: Callable[[str], None] | None = None,
) -> Path:
    """Build the FMU of a model as `build` does, and return its file; what is to be said goes to stderr.

    Args:
        model: name of a ready-made model, or file of your own mechanism.
        output: folder for the FMU.
        flavour: of it.
        fmi: version of the standard.
        starts: start values that this FMU has as its own, of parameters and inputs.
        inputs: those that are given otherwise than in the model: factor, offset and unit (None: the model's).
        clocks: FMI 3.0 with a clock of impacts and arrays.
        inform: is called with the degrees of freedom of a mechanism of your own.

    Raises:
        typer.Exit: it cannot be built; the reason has been said.
    """
    from mechanism_fmu.fmu.disk.user_cache import record_source
    from mechanism_fmu.fmu.native.package import build_native_fmu
    from mechanism_fmu.fmu.native.web import sources_of
    from mechanism_fmu.fmu.own.freedoms import report_freedoms
    from mechanism_fmu.fmu.package import build_fmu
    from mechanism_fmu.model.baked import Baked, Seen

    own = Baked(starts or {}, {name: Seen(*given) for name, given in (inputs or {}).items()})
    _require(model)
    if fmi == 3 and flavour is not Flavour.NATIVE:
        _refuse("FMI 3.0 comes in the native flavour only; add --flavour native.")
    if clocks and fmi != 3:
        _refuse("Clocks come with FMI 3.0 only; add --fmi 3.")
    with _loaded(model, "the FMU", flavour is Flavour.NATIVE) as (module, file, report, warn):
        source = f"{file.resolve() if file else model}\n{sources_of(module)}"  # before what comes takes its time
        if flavour is Flavour.NATIVE:
            path = build_native_fmu(module, output, fmi, report, clocks=clocks, baked=own)
        else:
            path = build_fmu(module, output, report, baked=own)
        if not own.starts and not own.inputs:
            record_source(path, source)
        if inform is not None and file is not None:
            report_freedoms(module.MODEL, file, inform, warn)
    return path


def web(model: str) -> WebModule:
    """A model for a page, with the WebAssembly module that it runs in; what is to be said goes to stderr.

    Args:
        model: name of a ready-made model, or file of your own mechanism.

    Raises:
        typer.Exit: it cannot be built; the reason has been said.
    """
    from mechanism_fmu.fmu.native.web import web_module

    _require(model)
    with _loaded(model, "the page", True) as (module, _, report, _):
        return web_module(module, report)


def web_of(path: Path) -> WebModule:
    """The model of an FMU for a page, if the FMU was built here from a model that is as it was; nothing is compiled.

    Args:
        path: of the FMU.

    Raises:
        LookupError: it cannot be had; the message says why.
    """
    import models
    from mechanism_fmu.fmu.disk.user_cache import source_of
    from mechanism_fmu.fmu.native.objects import web_library_is_made
    from mechanism_fmu.fmu.native.web import sources_of, web_module
    from mechanism_fmu.fmu.own.find import find
    from mechanism_fmu.fmu.own.prepare import load
    from mechanism_fmu.model import MechanismError

    model, _, digest = source_of(path).partition("\n")
    if not model:
        raise LookupError(
            "the model of an FMU is known where `mechanism-fmu build` has made it, and this file is not from here"
        )
    try:
        module = models.load(model) if model in models.available() else load(find(model))
        if sources_of(module) != digest:
            raise LookupError(f"{model} has changed since the FMU was built; build it again")
        if not web_library_is_made():
            raise LookupError(
                f"the engine for browsers is not compiled here yet; `mechanism-fmu page {model}` does it, once"
            )
        return web_module(module)
    except (MechanismError, OSError) as error:
        raise LookupError(str(error)) from error


def _require(model: str) -> None:
    """That there can be such a model."""
    import models
    from mechanism_fmu.fmu.own.find import looks_like_a_file

    if model and (model in models.available() or looks_like_a_file(model)):
        return
    asked = f"There is no model {model!r}" if model else "Say which model to build"
    names = ", ".join(models.available())
    example = f"{model}.py" if model and isfile(f"{model}.py") else "my_mechanism.py"
    _refuse(f"{asked}; there are: {names}. For a mechanism of your own, give its file, e.g. {example}.")


def _refuse(text: str) -> NoReturn:
    _messages().print(text, style="red", markup=False)
    raise typer.Exit(_USAGE_ERROR)


@contextmanager
def _loaded(model: str, what: str, native: bool) -> Iterator[_Loaded]:
    """A model's module, the file if it is the user's own, what shows how far the engine is compiled, what warns.

    Of bodies that overlap at the start a picture is written into the current folder: a build that fails leaves nothing
    where its FMU would be.

    Raises:
        typer.Exit: it cannot be loaded, or what the block makes of it cannot be made; the reason has been said.
    """
    import models
    from mechanism_fmu.fmu.own.find import WrongUseError
    from mechanism_fmu.fmu.own.mistakes import explained_in_fmu
    from mechanism_fmu.fmu.own.prepare import prepare
    from mechanism_fmu.model import MechanismError
    from mechanism_fmu.model.errors import picture_of

    messages = _messages()
    try:
        with messages.status(f"Building {what} of {model} ...") as status, ExitStack() as explanations:

            def report(text: str, done: float) -> None:
                status.update(f"The engine is compiled once for all platforms, {100 * done:.0f} %: {text} ...")

            def warn(text: str) -> None:
                messages.print(f"Warning: {text}", style="yellow", markup=False)

            if model in models.available():
                yield models.load(model), None, report, warn
            else:
                module, file = prepare(model, native, warn)
                explanations.enter_context(explained_in_fmu(file))
                yield module, file, report, warn
    except (MechanismError, OSError) as error:
        messages.print(str(error), style="red", markup=False)
        picture = picture_of(error)
        if picture:
            shown = Path(f"{Path(model).stem}_overlap.svg")
            shown.write_text(picture, encoding="utf-8")
            messages.print(f"The bodies are drawn in {shown}.", style="red", markup=False)
        raise typer.Exit(_USAGE_ERROR if isinstance(error, WrongUseError) else 1) from None


def mechanism(model: str, **parameters: float) -> Mechanism:
    """The description of a model's mechanism, for those who analyse it without its FMU.

    Args:
        model: name of a ready-made model, or file of your own; `built` says more of what is wrong with that.
        parameters: values that differ from the defaults, each in the SI unit of its parameter [m, rad, kg, ...].

    Raises:
        typer.Exit: there is no such mechanism; the reason has been said.
    """
    import models
    from mechanism_fmu.fmu.own.find import find
    from mechanism_fmu.fmu.own.prepare import load
    from mechanism_fmu.model import MechanismError

    try:
        module = models.load(model) if model in models.available() else load(find(model))
        described: Mechanism = module.MODEL.build(module.MODEL.values(**parameters))
    except MechanismError as error:
        _messages().print(str(error), style="red", markup=False)
        raise typer.Exit(_USAGE_ERROR) from None
    return described


def model_of(model: str) -> Model:
    """A model itself, for those who analyse its motion without its FMU.

    Args:
        model: name of a ready-made model, or file of your own mechanism.

    Raises:
        typer.Exit: there is no such model, or its file has a mistake; the reason has been said.
    """
    _require(model)
    with _loaded(model, "the mechanism", False) as (module, _, _, _):
        found: Model = module.MODEL
    return found


def model_with_guid(name: str, guid: str, flavour: Flavour, fmi: int) -> str | None:
    """The ready-made model whose FMU, built here and now, has this GUID; None if there is none.

    A GUID is a fingerprint of all that an FMU is made from, so that a copy with other numbers is the same in all else.

    Args:
        name: of the FMU's model.
        guid: of the FMU.
        flavour: of it.
        fmi: version of the standard.
    """
    import models

    for known in models.available():
        if models.load(known).MODEL.name == name:
            with tempfile.TemporaryDirectory(prefix="mechanism_fmu_") as place:
                return known if _guid(built(known, Path(place), flavour, fmi)) == guid else None
    return None


def models_that_bend() -> list[str]:
    """Names of the ready-made linkages with elastic members."""
    found = {name: mechanism(name) for name in model_names()}
    return [name for name, one in found.items() if one.members and not one.contacts]


def model_names() -> list[str]:
    """Names of the ready-made models."""
    import models

    return list(models.available())


def machines() -> dict[str, Path]:
    """Files of the ready-made machines, by name."""
    import models

    return models.machines()


def advise(flavour: Flavour) -> None:
    """Say what an FMU of this flavour, built here, could have more of."""
    from mechanism_fmu.fmu.native.link import INSTALL
    from mechanism_fmu.fmu.native.objects import has_libraries

    if flavour is Flavour.PYTHONFMU and not has_libraries():
        _messages().print(
            "The engine is not inside in compiled form, because the package ziglang is not installed: the FMU needs "
            "numba, and its first start takes 15 to 30 s. For a fast one, install it and build again: " + INSTALL,
            style="yellow",
            markup=False,
        )


def _messages() -> Console:
    from rich.console import Console

    return Console(stderr=True, highlight=False, soft_wrap=True)


def _guid(path: Path) -> str:
    import zipfile
    from xml.etree import ElementTree

    with zipfile.ZipFile(path) as fmu:
        description = ElementTree.fromstring(fmu.read("modelDescription.xml")).attrib
    return description.get("guid") or description["instantiationToken"]


if __name__ == "__main__":
    typer.run(build)
