"""Calls of a page's scripts in node."""

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from harness import page as page_package

NODE = shutil.which("node")
SCRIPTS = Path(page_package.__file__).parent
needs_node = pytest.mark.skipif(NODE is None, reason="node is not installed")


def in_node(*calls: list[Any], of: Path | None = None, **more: Any) -> list[Any]:
    asked = {"page": None if of is None else str(of), "folder": str(SCRIPTS), "calls": calls} | more
    program = Path(__file__).with_name("page_scripts.js")
    assert NODE is not None
    done = subprocess.run([NODE, program], input=json.dumps(asked), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    answers: list[Any] = json.loads(done.stdout)
    return answers
