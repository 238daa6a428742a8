"""Models as live pages, beside the site, and the directive that shows them.

    ```{live} ratchet
    :picture: ../models/ratchet/drawing.svg
    ```

shows the picture and, once it is pressed, the page in which the engine runs; with `:at-once:` the page from the start.
"""

from __future__ import annotations

import os
from html import escape
from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util.docutils import SphinxDirective

#: The one on the first page.
FIRST = "ratchet"

_MISSING = "Not live here: the site was built without this page, where the engine was not compiled."


def write(root: Path, folder: Path, chosen: str) -> None:
    """Write the live pages, as far as they can be built here.

    Args:
        root: of the tree.
        folder: for the pages.
        chosen: "all", "first" or "none".
    """
    import build_fmu
    import models
    from harness.page.page_file import page
    from mechanism_fmu.fmu.native.objects import has_libraries

    folder.mkdir(parents=True, exist_ok=True)
    if chosen == "none" or not has_libraries():
        return
    examples = sorted((root / "docs" / "examples" / "gallery").glob("*.py"))
    wanted = [FIRST] if chosen == "first" else [*models.available(), *map(str, examples)]
    for name in wanted:
        (folder / f"{Path(name).stem}.html").write_text(page(build_fmu.web(name)), encoding="utf-8")


class Live(SphinxDirective):
    """A live page: a picture until it is pressed, or the page at once."""

    required_arguments = 1
    option_spec: ClassVar[dict[str, Any]] = {
        "picture": directives.unchanged,
        "at-once": directives.flag,
        "title": directives.unchanged,
    }

    def run(self) -> list[nodes.Node]:
        """Its HTML; without the page, the picture and a word about it."""
        name, title = self.arguments[0], self.options.get("title", f"{self.arguments[0]}, live")
        return live(self.env, name, self.options.get("picture"), title, at_once="at-once" in self.options)


def live(env: BuildEnvironment, name: str, picture: str | None, title: str, at_once: bool = False) -> list[nodes.Node]:
    """What shows a live page.

    Args:
        env: of the page on which it stands.
        name: of the live page.
        picture: until it is pressed, as seen from that page.
        title: of the frame.
        at_once: show it from the start.
    """
    address = "../" * env.docname.count("/") + f"live/{name}.html"
    made = (Path(os.environ["SITE_EXTRA"]) / "live" / f"{name}.html").exists()
    if made and at_once:
        frame = f'<iframe src="{address}" title="{escape(title)}" loading="lazy"></iframe>'
        return [
            _raw(f'<div class="live">{frame}</div><p class="live-alone"><a href="{address}">The page alone</a></p>')
        ]
    shown: list[nodes.Node] = [_raw('<div class="live still">')]
    if picture:
        shown.append(nodes.image(uri=picture, alt=title))
    if made:
        shown.append(_raw(f'<button type="button" data-live="{address}" data-title="{escape(title)}">Run it</button>'))
    else:
        shown.append(nodes.paragraph("", _MISSING))
    return [*shown, _raw("</div>")]


class Cards(SphinxDirective):
    """Cards with a live page each: lines `NAME | PICTURE | TITLE | words`, the picture as seen from this page."""

    has_content = True

    def run(self) -> list[nodes.Node]:
        """A grid of them."""
        shown: list[nodes.Node] = [_raw('<div class="cards">')]
        for line in self.content:
            name, picture, title, words = (part.strip() for part in line.split("|"))
            shown += [_raw(f'<div class="card-of"><h3>{escape(title)}</h3>')]
            shown += live(self.env, name, picture, title)
            shown += [_raw(f"<p>{escape(words)}</p></div>")]
        return [*shown, _raw("</div>")]


def _raw(html: str) -> nodes.raw:
    return nodes.raw("", html, format="html")


def setup(app: Sphinx) -> dict[str, Any]:
    """Tell Sphinx."""
    app.add_directive("live", Live)
    app.add_directive("live-cards", Cards)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
