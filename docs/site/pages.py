"""The pages of the site: Markdown files of the tree, with links that lead to what the site has.

A link to a file that is no page, as to a source, leads to a plain page that shows this file (`sources`). So nothing
leads out of the site.
"""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path, PurePosixPath

from . import notebook

#: What else of the tree is a page, and where.
_ELSEWHERE = {"CHANGELOG.md": "project/changelog.md", "CONTRIBUTING.md": "project/contributing.md"}
#: What is linked to and has another form in the site.
_FOLDERS = {"docs/decisions": "decisions/index.md", "models": "models/index.md", "README.md": "index.md"}
#: Folders of docs without pages.
_NO_PAGES = ("docs/site/", "docs/examples/")
_PICTURES = (".svg", ".png", ".gif")
_PAGES = (".md", ".ipynb")
_LINK = re.compile(r'(\[[^\]\[]*(?:\[[^\]]*\][^\]\[]*)*\]\(|<img src=")([^)\s"#]*)(#[^)\s"]*)?([)"])')
_FENCED = re.compile(r"(?ms)(^ *```.*?^ *```$)")


def stage(root: Path, target: Path) -> set[str]:
    """Copy the pages and their pictures.

    Args:
        root: of the tree.
        target: folder for the pages.

    Returns:
        The files and folders that pages name and that are no pages.

    Raises:
        ValueError: a link leads nowhere.
    """
    where = _places(root)
    named: set[str] = set()
    for source, place in where.items():
        path = target / place
        path.parent.mkdir(parents=True, exist_ok=True)
        if source.endswith(".md"):
            text = (root / source).read_text(encoding="utf-8")
            path.write_text(_linked(text, source, place, where, root, named), encoding="utf-8")
        elif source.endswith(".ipynb"):
            text = _linked(notebook.markdown(root / source), source, place, where, root, named)
            path.write_text(text, encoding="utf-8")
        else:
            shutil.copyfile(root / source, path)
    for folder in ("joints", "elements"):
        _add_tree(target / folder / "index.md")
    _write_list(target / "decisions" / "index.md", "Decisions", _beside(target / "decisions" / "index.md"))
    models = sorted(path.parent.name for path in target.glob("models/*/index.md"))
    _write_list(target / "models" / "index.md", "Models", [f"{name}/index.md" for name in models])
    return named


def _places(root: Path) -> dict[str, str]:
    """Of each file that the site takes as it is, its place there."""
    found = {name: place for name, place in _ELSEWHERE.items() if (root / name).exists()}
    for path in sorted(root.glob("docs/**/*")):
        name = path.relative_to(root).as_posix()
        if path.suffix in (*_PAGES, *_PICTURES) and not name.startswith(_NO_PAGES):
            found[name] = _indexed(name.removeprefix("docs/")).replace(".ipynb", ".md")
    for path in sorted(root.glob("models/*/*")):
        if path.suffix in (".md", ".svg", ".png"):
            name = path.relative_to(root).as_posix()
            found[name] = _indexed(name)
    return found


def _indexed(name: str) -> str:
    """A folder's README is its first page."""
    path = PurePosixPath(name)
    return (path.parent / "index.md").as_posix() if path.name == "README.md" else name


def _linked(text: str, source: str, place: str, where: dict[str, str], root: Path, named: set[str]) -> str:
    """The text of a page with its links as they are in the site; but for those in code."""

    def link(match: re.Match[str]) -> str:
        before, target, anchor, after = match[1], match[2], match[3] or "", match[4]
        if not target or re.match(r"[a-z]+:", target):
            return match[0]
        path = os.path.normpath(os.path.join(os.path.dirname(source), target))
        if not (root / path).exists():
            raise ValueError(f"{source}: the link to {target!r} leads nowhere.")
        if path in _FOLDERS:
            to = _FOLDERS[path]
        elif path in where:
            to = where[path]
        else:
            named.add(path)
            to = os.path.relpath(f"source/{path}.html", os.path.dirname(place) or ".")
            return f'<a href="{to}">{before[1:-2]}</a>'
        return f"{before}{os.path.relpath(to, os.path.dirname(place) or '.')}{anchor}{after}"

    parts = _FENCED.split(text)  # every second one is code
    return "".join(part if number % 2 else _LINK.sub(link, part) for number, part in enumerate(parts))


def _write_list(page: Path, title: str, entries: list[str]) -> None:
    page.parent.mkdir(parents=True, exist_ok=True)
    lines = "\n".join(f"- [](<{entry}>)" for entry in entries)
    hidden = "\n".join(entry.removesuffix(".md") for entry in entries)
    page.write_text(f"# {title}\n\n{lines}\n\n```{{toctree}}\n:hidden:\n\n{hidden}\n```\n", encoding="utf-8")


def _beside(page: Path) -> list[str]:
    """The other pages of its folder."""
    return sorted(path.name for path in page.parent.glob("*.md") if path != page)


def _add_tree(page: Path) -> None:
    """Add the other pages of its folder to a folder's first page."""
    names = "\n".join(name.removesuffix(".md") for name in _beside(page))
    with page.open("a", encoding="utf-8") as file:
        file.write(f"\n```{{toctree}}\n:hidden:\n\n{names}\n```\n")
