"""Files of the tree as plain pages of the site, for links from pages to sources."""

from __future__ import annotations

from html import escape
from pathlib import Path

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import TextLexer, get_lexer_for_filename
from pygments.util import ClassNotFound

_LIGHT, _DARK = HtmlFormatter(style="a11y-high-contrast-light"), HtmlFormatter(style="a11y-high-contrast-dark")
_STYLE = f"""
body {{ margin: 1rem; font: 0.9rem monospace; }} h1 {{ font: 600 1.1rem sans-serif; }} pre {{ overflow-x: auto; }}
{_LIGHT.get_style_defs(".highlight")}
@media (prefers-color-scheme: dark) {{
:root {{ color-scheme: dark; }} body {{ background: #14181e; color: #ced6dd; }}
{_DARK.get_style_defs(".highlight")}
}}
"""


def write(root: Path, names: set[str], folder: Path) -> None:
    """Write a page for each file, or for each folder a list of what is in it.

    Args:
        root: of the tree.
        names: of the files and folders, from the root.
        folder: for the pages.
    """
    folder.mkdir(parents=True)
    (folder / "style.css").write_text(_STYLE, encoding="utf-8")
    for name in names:
        path, page = root / name, folder / f"{name}.html"
        page.parent.mkdir(parents=True, exist_ok=True)
        if path.is_dir():
            text = "\n".join(sorted(one.name for one in path.iterdir() if one.name != "__pycache__"))
        else:
            text = path.read_text(encoding="utf-8")
        try:
            lexer = get_lexer_for_filename(name)
        except ClassNotFound:
            lexer = TextLexer()
        head = f'<meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{escape(name)}</title>'
        up = "../" * name.count("/")
        shown = highlight(text, lexer, _LIGHT)
        html = f'<!doctype html>\n<html lang="en"><head>{head}<link rel="stylesheet" href="{up}style.css"></head>'
        page.write_text(f"{html}<body><h1>{escape(name)}</h1>{shown}</body></html>\n", encoding="utf-8")
