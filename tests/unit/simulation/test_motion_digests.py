"""Every bit of seven motions, as a digest: whatever platform runs this test has the same.

    KEPT=write python -m pytest tests/unit/simulation/test_motion_digests.py

writes them anew, after a change of the engine that changes a last digit somewhere. That a browser, Windows and ARM give
the bits of the platform they are run from: tests/fmu/native, test_web.py and test_other_platforms.py.
"""

import hashlib
import json
import os
from pathlib import Path

import pytest

from tests.fmu.native.motions import CASES, motion

FILE = Path(__file__).parents[2] / "data" / "motion_digests.json"


@pytest.mark.parametrize("name", CASES)
def test_the_motion_is_that_of_every_platform(name):
    rows = motion(name) + 0.0  # one zero, not two
    digest = hashlib.sha256(rows.astype("<f8").tobytes()).hexdigest()
    kept = json.loads(FILE.read_text()) if FILE.exists() else {}
    if os.environ.get("KEPT") == "write":
        FILE.write_text(json.dumps(kept | {name: digest}, indent=1) + "\n")
    assert kept.get(name) == digest or os.environ.get("KEPT") == "write", (
        f"{name}: {len(rows)} rows differ in some bit from those kept; if the engine was changed: KEPT=write."
    )
