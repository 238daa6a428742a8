"""Reports and pages as axe-core judges them: nothing serious keeps a reader out; desk and phone, light and dark."""

import json
import shutil
import subprocess
import tarfile
from collections.abc import Callable
from pathlib import Path

import pytest
from chromium import PROGRAM, Browser, chromium, opened
from real_reports import Report

#: Of the npm registry; it judges, and goes into no report.
AXE = "axe-core@4.14.1"
NPM = shutil.which("npm")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(PROGRAM is None, reason="no chromium is installed (on Debian: apt install chromium)"),
    pytest.mark.skipif(NPM is None, reason="no npm is installed (on Debian: apt install npm)"),
]

JUDGE = """axe.run(document, {iframes: false}).then((found) => JSON.stringify(found.violations
    .filter((one) => ["serious", "critical"].includes(one.impact))
    .map((one) => [one.id, ...one.nodes.map((node) => node.html.slice(0, 120))])))"""


@pytest.fixture(scope="module")
def axe(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The script of axe-core."""
    folder = tmp_path_factory.mktemp("axe")
    assert NPM is not None
    try:
        subprocess.run([NPM, "pack", AXE], cwd=folder, capture_output=True, check=True, timeout=60)
    except (subprocess.SubprocessError, OSError):
        pytest.skip(f"npm cannot bring {AXE}")
    with tarfile.open(next(folder.glob("*.tgz"))) as archive:
        script = archive.extractfile("package/axe.min.js")
        assert script is not None
        return script.read().decode()


def judged(browser: Browser, file: Path, axe: str, ready: str) -> None:
    for scheme in ("light", "dark"):
        for width in (1200, 390):
            with opened(browser, file, width) as page:
                features = [{"name": "prefers-color-scheme", "value": scheme}]
                page.call("Emulation.setEmulatedMedia", features=features)
                page.wait_until(ready)
                page.value(f"{axe};0")
                assert json.loads(page.value(JUDGE)) == [], f"{file.name}, {scheme}, {width} px"


def test_no_report_keeps_a_reader_out(axe: str, reports: dict[str, Report], tmp_path: Path) -> None:
    with chromium(tmp_path / "profile") as browser:
        for name in ("run", "study", "sweep", "optimum", "machine"):
            judged(browser, reports[name].path, axe, "document.documentElement.classList.contains('drawn')")


def test_no_page_keeps_a_reader_out(axe: str, page_of: Callable[[str], Path], tmp_path: Path) -> None:
    with chromium(tmp_path / "profile") as browser:
        for name in ("ratchet", "geneva"):
            judged(browser, page_of(name), axe, "!!document.querySelector('.animation svg > *, #impacts tbody td')")
