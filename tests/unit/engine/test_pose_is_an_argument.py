"""Nothing in the engine reads positions that it was not given: poses come from who has placed the bodies."""

import re
from pathlib import Path

from mechanism_fmu import engine

FOLDER = Path(engine.__file__).parent


def test_only_the_kinematics_make_a_pose_of_a_block() -> None:
    makers = {
        path.relative_to(FOLDER).as_posix()
        for path in FOLDER.rglob("*.py")
        if re.search(r"\bPose\(", path.read_text(encoding="utf-8"))
    }
    assert makers == {"constraints/kinematics.py"}
