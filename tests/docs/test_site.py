"""The site is built offline without a warning, and nothing in it asks a network."""

import re
import subprocess
import sys
from html import unescape
from pathlib import Path
from urllib.parse import unquote

import pytest

from docs.site import pages
from docs.site.commands import PAGE, page

ROOT = Path(__file__).parents[2]


def test_the_page_of_commands_is_what_help_says() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(), "python -m docs.site.commands"


def test_a_folder_that_is_no_site_is_not_deleted(tmp_path: Path) -> None:
    site = pytest.importorskip("docs.site.__main__")
    kept = tmp_path / "thesis.txt"
    kept.touch()
    assert site.build(tmp_path, "none") == 2
    assert kept.exists()
    assert not any(site.is_replaceable(folder) for folder in (ROOT, ROOT.parent, kept))


def test_links_of_all_pages_lead_somewhere(tmp_path: Path) -> None:
    """A link that leads nowhere is refused when pages are collected; those to sources are listed."""
    named = pages.stage(ROOT, tmp_path)
    assert "docs/examples/geared_cam.toml" in named
    assert all((ROOT / name).exists() for name in named)


def test_a_link_that_leads_nowhere_is_refused(tmp_path: Path) -> None:
    (tmp_path / "docs").mkdir()
    (tmp_path / "models").mkdir()
    (tmp_path / "docs" / "index.md").write_text("[there](nowhere.md)", encoding="utf-8")
    with pytest.raises(ValueError, match=r"docs/index\.md: the link to 'nowhere\.md' leads nowhere"):
        pages.stage(tmp_path, tmp_path / "site")


@pytest.mark.slow
def test_the_site_is_built_without_a_warning_and_asks_no_network(tmp_path: Path) -> None:
    """Half a minute: Sphinx, with warnings as errors; of the live pages none, which are tested as pages."""
    site = tmp_path / "site"
    command = [sys.executable, "-m", "docs.site", str(site), "--live", "none"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    files = sorted(site.rglob("*.html"))
    assert len(files) > 150
    for file in files:
        text = file.read_text(encoding="utf-8")
        for element in re.findall(r"<(?:link|script|img|iframe|source|object|embed)\b[^>]*>", text):
            assert not re.search(r'(?:src|href|srcset)="(?:https?:)?//', element), f"{file}: {element}"
        for target in re.findall(r'(?:src|href)="([^"#?]+)[^"]*"', text):
            if not re.match(r"[a-z]+:", target):
                path = file.parent / unquote(unescape(target))
                assert path.exists(), f"{file.relative_to(site)}: {target}"
    for file in [*site.rglob("*.css"), *site.rglob("*.js")]:
        text = file.read_text(encoding="utf-8")
        assert not re.search(r"""(?:@import\s+|url\(\s*|fetch\(\s*|\.src\s*=\s*)["']?https?://""", text), file
