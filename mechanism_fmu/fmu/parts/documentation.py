"""The documentation that travels in an FMU: one page that needs nothing else, and the licences."""

from __future__ import annotations

import base64
import mimetypes
import re
import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import replace
from html import escape
from importlib import metadata
from pathlib import Path
from urllib.parse import quote

from markdown_it import MarkdownIt
from markdown_it.token import Token

from ...model import Model
from ...statechart import definitions_table, diagram, markdown
from .fmi_units import display_factor
from .resources import default_logic
from .variables import Variable, common_description, numbered, variables_of

# What the project says of itself: in its checkout if this is one, else as an installed distribution.

_CHECKOUT = Path(__file__).parents[3]
_PROJECT = _CHECKOUT / "pyproject.toml"


#: Extras whose packages the library itself imports, where a model may reach them.
_EXTRAS = ("analysis", "designs", "plot", "dev")


def dependencies() -> list[str]:
    """What the library imports, with pins, e.g. "numpy>=2.0": what it needs, and what some of it needs.

    The same from a checkout and when installed.
    """
    if _PROJECT.is_file():
        project = tomllib.loads(_PROJECT.read_text(encoding="utf-8"))["project"]
        extras = project.get("optional-dependencies", {})
        pins: list[str] = [*project["dependencies"], *(pin for extra in _EXTRAS for pin in extras.get(extra, ()))]
    else:
        stated = [pin.partition(";") for pin in metadata.requires("mechanism_fmu") or []]
        extra = re.compile(rf"""extra == ['"]({"|".join(_EXTRAS)})['"]""")
        pins = [pin.strip() for pin, _, marker in stated if "extra ==" not in marker or extra.search(marker)]
    return [_in_order(pin) for pin in dict.fromkeys(pins)]


def _in_order(pin: str) -> str:
    """A requirement with its limits sorted: installers write them in an order of their own."""
    name = pin[: min((pin.index(sign) for sign in "<>=!~" if sign in pin), default=len(pin))]
    return name + ",".join(sorted(pin[len(name) :].split(",")))


def licence_text(distribution: str) -> str:
    """Text of the licence of an installed distribution, or of this project.

    Raises:
        FileNotFoundError: the distribution was installed without its licence.
    """
    if distribution == "mechanism_fmu" and _PROJECT.is_file():
        return (_CHECKOUT / "LICENSE").read_text(encoding="utf-8")
    text = metadata.distribution(distribution).read_text("licenses/LICENSE")
    if text is None:
        raise FileNotFoundError(f"The installed {distribution} has no licence file; install it again.")
    return text


#: Characters of a drawing that may stand in an address between double quotes.
_AS_THEY_ARE = "/:=;,()'!*@$?+~"

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
table { border-collapse: collapse; margin: 1rem 0; font-size: .9rem; }
th, td { border-bottom: 1px solid #ddd; padding: .25rem .6rem; text-align: left; vertical-align: top; }
code, pre { font-family: ui-monospace, monospace; font-size: .9em; }
pre { background: #f6f6f6; padding: .8rem; overflow-x: auto; }
img { max-width: 100%; }
"""


def documentation(
    model: Model, folder: Path | None, facts: Sequence[str], licences: Sequence[str], notes: str = ""
) -> dict[str, bytes]:
    """Files of the FMU's folder `documentation`, by their path within the FMU.

    Args:
        model: what the FMU simulates.
        folder: of the model; its README.md, if there, becomes part of the page, with its pictures. None: there is none.
        facts: what there is to know when this flavour of FMU is run, as HTML.
        licences: distributions whose code travels in the FMU.
        notes: what is to be read in place of a README.md, as Markdown.
    """
    texts = {f"documentation/licenses/{name}.txt": licence_text(name).encode() for name in licences}
    return {"documentation/index.html": page(model, folder, facts, notes).encode(), **texts}


def page(model: Model, folder: Path | None, facts: Sequence[str], notes: str = "") -> str:
    """The page of a model as HTML; see `documentation`."""
    variables = variables_of(model)
    shown = _together(variables)
    readme = None if folder is None else folder / "README.md"
    text = readme.read_text(encoding="utf-8") if readme is not None and readme.is_file() else notes
    tables = "".join(
        _table(title, [v for v in shown if v.causality == causality])
        for title, causality in (
            ("Inputs", "input"),
            ("Outputs", "output"),
            ("Parameters", "parameter"),
            ("Calculated parameters", "calculatedParameter"),
        )
    )
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(model.name)}</title>'
        f"<style>{_STYLE}</style></head><body>\n"
        f"<h1>{escape(model.name)}</h1>\n<p>{escape(model.description)}</p>\n"
        f"{_markdown(text, folder)}"
        f"<h2>Variables</h2>\n{tables}"
        f"{_modes(model, folder)}"
        f"<h2>Running this FMU</h2>\n<ul>\n{''.join(f'<li>{fact}</li>{chr(10)}' for fact in facts)}</ul>\n"
        "</body></html>\n"
    )


def _modes(model: Model, folder: Path | None) -> str:
    """The modes and transitions for the default values; "" of a mechanism without any."""
    logic = default_logic(model)
    if not logic.regions:
        return ""
    return (
        "<h2>Modes and transitions</h2>\n<p>With the default values; those of other values are in "
        "<code>resources/logic.json</code>, and <code>mechanism-fmu modes</code> shows them. The charts run beside "
        "each other; an arrow has its event, [its guard] and / what it resets.</p>\n"
        f"{diagram(logic)}{_markdown(markdown(logic), folder)}{_markdown(definitions_table(logic), folder)}"
    )


def _together(variables: Sequence[Variable]) -> list[Variable]:
    """The variables with one in place of those that are numbered: `impacts[1..8].time`."""
    arrays = {elements[0].value_reference: elements for elements in numbered(variables)}
    left_out = {element.value_reference for elements in arrays.values() for element in elements[1:]}
    return [
        replace(
            variable,
            name=variable.name.replace("[1]", f"[1..{len(arrays[variable.value_reference])}]"),
            description=common_description([element.description for element in arrays[variable.value_reference]]),
        )
        if variable.value_reference in arrays
        else variable
        for variable in variables
        if variable.value_reference not in left_out
    ]


def _table(title: str, variables: Sequence[Variable]) -> str:
    if not variables:
        return ""
    head = ("Name", "Type", "Unit", "Start", "Limits", "Meaning")
    rows = (
        (
            f"<code>{escape(v.name)}</code>",
            v.type,
            escape(v.unit or ""),
            _quantity(v, v.start),
            _limits(v),
            escape(v.description),
        )
        for v in variables
    )
    return f"<h3>{title}</h3>\n<table>\n<tr>{_cells('th', head)}</tr>\n" + (
        "".join(f"<tr>{_cells('td', row)}</tr>\n" for row in rows) + "</table>\n"
    )


def _cells(tag: str, cells: Iterable[str]) -> str:
    return "".join(f"<{tag}>{cell}</{tag}>" for cell in cells)


def _quantity(variable: Variable, value: float | None) -> str:
    """A value in the variable's unit and, where it has one, in its display unit."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    shown = f"{value:g}"
    if variable.unit is not None and variable.display_unit is not None:
        shown += f" ({value * display_factor(variable.unit, variable.display_unit):g} {variable.display_unit})"
    return escape(shown)


def _limits(variable: Variable) -> str:
    low, high = _quantity(variable, variable.minimum), _quantity(variable, variable.maximum)
    return f"{low} … {high}" if low or high else ""


def _markdown(text: str, folder: Path | None) -> str:
    """Markdown as HTML that needs no other file."""
    converter = MarkdownIt("commonmark", {"html": False}).enable("table")
    tokens = converter.parse(text)
    for token in (t for block in tokens for t in (block, *(block.children or ()))):
        _make_self_contained(token, folder)
    html: str = converter.renderer.render(tokens, converter.options, {})
    return html


def _make_self_contained(token: Token, folder: Path | None) -> None:
    """Inline pictures, drop links to files that stay behind, and leave the first heading level to the page.

    Without a folder, pictures are their texts.
    """
    if token.type in ("heading_open", "heading_close"):
        token.tag = f"h{min(int(token.tag[1]) + 1, 6)}"
    elif token.type == "image" and folder is None:
        token.type = "text"
    elif token.type == "image":
        assert folder is not None
        token.attrs["src"] = _inlined(folder / str(token.attrs["src"]))
    elif token.type == "link_open" and not str(token.attrs["href"]).startswith(("https://", "http://", "#")):
        del token.attrs["href"]


def _inlined(picture: Path) -> str:
    """A picture as an address. Drawings stay text: an FMU then compresses them to a third of their base64 form."""
    kind, contents = mimetypes.guess_type(picture.name)[0], picture.read_bytes()
    if picture.suffix == ".svg":
        return f"data:{kind},{quote(contents, safe=_AS_THEY_ARE)}"
    return f"data:{kind};base64,{base64.b64encode(contents).decode()}"
