"""Reports as axe-core judges them: nothing serious keeps a reader out, on a desk and a phone, in light and dark."""

import json
import shutil
import subprocess
import tarfile
from pathlib import Path

import pytest
from chromium import PROGRAM, chromium, opened
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


def test_no_report_keeps_a_reader_out(axe: str, reports: dict[str, Report], tmp_path: Path) -> None:
    with chromium(tmp_path / "profile") as browser:
        for name in ("run", "study", "sweep", "optimum", "machine"):
            for scheme in ("light", "dark"):
                for width in (1200, 390):
                    with opened(browser, reports[name].path, width) as page:
                        features = [{"name": "prefers-color-scheme", "value": scheme}]
                        page.call("Emulation.setEmulatedMedia", features=features)
                        page.wait_until("document.documentElement.classList.contains('drawn')")
                        page.value(f"{axe};0")
                        assert json.loads(page.value(JUDGE)) == [], f"{name}, {scheme}, {width} px"
