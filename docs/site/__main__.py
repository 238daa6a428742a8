"""`python -m docs.site`: build the site offline, with warnings as errors."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

from sphinx.cmd.build import build_main

from . import api, live, pages, sources

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent


def build(output: Path, chosen: str) -> int:
    """Build the site.

    Args:
        output: its folder.
        chosen: which live pages: "all", "first" (that of the first page) or "none".

    Returns:
        Exit code of Sphinx.
    """
    output = output.resolve()
    if output.exists() and not is_replaceable(output):
        print(f"{output} is there, and is no site of an earlier build: it will not be deleted. Choose another folder.")
        return 2
    shutil.rmtree(output, ignore_errors=True)
    with tempfile.TemporaryDirectory(prefix="site_") as work:
        return _built(output, Path(work), chosen)


def is_replaceable(folder: Path) -> bool:
    """Whether a folder is empty, or a site, which a new one may take the place of; never one that holds this clone."""
    if not folder.is_dir() or folder in (ROOT, *ROOT.parents):
        return False
    return not any(folder.iterdir()) or ((folder / "_static").is_dir() and (folder / "searchindex.js").is_file())


def _built(output: Path, work: Path, chosen: str) -> int:
    staged = work / "pages"
    sources.write(ROOT, pages.stage(ROOT, staged), work / "extra" / "source")
    api.write(ROOT / "docs" / "reference" / "public-interface.md", staged / "reference" / "api")
    live.write(ROOT, work / "extra" / "live", chosen)
    os.environ["SITE_EXTRA"] = str(work / "extra")  # read by conf.py, which Sphinx executes
    arguments = ["-b", "html", "-q", "-W", "--keep-going", "-d", str(work / "doctrees"), "-c", str(HERE)]
    code = build_main([*arguments, str(staged), str(output)])
    if code == 0:
        for left in (".buildinfo", "objects.inv", "_static/webpack-macros.html"):
            (output / left).unlink(missing_ok=True)
        print(f"Open in a browser: {output / 'index.html'}")
    return code


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(prog="python -m docs.site", description=main.__doc__)
    parser.add_argument("output", nargs="?", type=Path, default=ROOT / "build" / "site", help="its folder")
    parser.add_argument("--live", choices=("all", "first", "none"), default="all", help="which models as live pages")
    given = parser.parse_args()
    sys.exit(build(given.output, given.live))


if __name__ == "__main__":
    main()
