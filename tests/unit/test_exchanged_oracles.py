"""Oracles with other numbers, fewer kinds and more: what can be compared is, and the rest is skipped by name."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from scipy.special import ellipk

_ROOT = Path(__file__).parents[2]
_FILES = (
    "tests/analytic/test_friction_oracle.py",
    "tests/analytic/test_shapes_oracle.py",
    "tests/unit/engine/test_joint_oracle.py",
)


def _own(name: str) -> Any:
    return json.loads((_ROOT / "tests" / "data" / name).read_text(encoding="utf-8"))


def _thrown_block(alpha_deg: float, mu: float, g: float, v0: float) -> dict[str, Any]:
    """Case 1b of friction in closed form: thrown up an incline from which it comes back."""
    (case,) = [case for case in _own("friction.json")["cases"] if case["id"] == "1b"]
    angle = math.radians(alpha_deg)
    up, down = (g * (math.sin(angle) + sign * mu * math.cos(angle)) for sign in (1.0, -1.0))
    stop, place = v0 / up, v0**2 / (2.0 * up)
    results = {
        "a_t_stop": stop,
        "a_s_stop": place,
        "a_t_back_at_start": stop + math.sqrt(2.0 * place / down),
        "a_v_back_at_start": -math.sqrt(2.0 * down * place),
        "a_acceleration_after_turn": -down,
    }
    data = case["data"] | {"alpha_deg": alpha_deg, "mu": mu, "g": g, "v0": v0}
    return dict(case) | {"id": "1c", "data": data, "results": results}


def _shapes() -> list[dict[str, Any]]:
    """A bowl with another amplitude, and a ball in a ring with another restitution up to its first impact."""
    by_kind = {case["kind"]: case for case in _own("shapes.json")["cases"]}
    bowl = by_kind["ball_in_bowl"] | {"case": "bowl_0.7", "data": {"amplitude": 0.7}}
    bowl["results"] = {"period": 4.0 * math.sqrt(1.0 / 9.81) * float(ellipk(math.sin(0.35) ** 2))}
    ring = by_kind["ball_in_ring"]
    first = {name: float(value) for name, value in ring["results"][0].items() if not isinstance(value, list)}
    change = (0.3 - ring["data"]["e"]) * abs(first["closing"]) / math.hypot(first["x"], first["y"])
    first |= {f"{axis}_rate": first[f"{axis}_rate"] - change * first[axis] for axis in "xy"}
    data = ring["data"] | {"e": 0.3}
    ring = ring | {"case": "ring_0.3", "data": data, "until": "the first impact"}
    ring["results"] = [first, first | {"t": 1e3}]
    return [bowl, ring, bowl | {"case": "screw_1", "kind": "screw_in_thread"}]


def test_other_numbers_and_kinds(tmp_path: Path) -> None:
    joint = dict(list(_own("joints.json")["joints"].items())[:1])
    files = {
        "FRICTION_ORACLE": {"cases": [_thrown_block(40.0, 0.2, 9.81, 3.0), {"id": "9a", "data": {}, "results": {}}]},
        "SHAPES_ORACLE": {"cases": _shapes()},
        "JOINT_ORACLE": {"joints": joint | {"universal": next(iter(joint.values()))}},
    }
    environment = dict(os.environ)
    for variable, content in files.items():
        path = tmp_path / f"{variable.lower()}.json"
        path.write_text(json.dumps(content), encoding="utf-8")
        environment[variable] = str(path)
    command = [sys.executable, "-m", "pytest", "-rs", "-p", "no:cacheprovider", "-p", "no:xdist", *_FILES]
    done = subprocess.run(command, cwd=_ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
    said = " ".join(done.stdout.split())
    for kind in ("9", "screw_in_thread", "universal"):
        assert f"has cases of the kind {kind}, for which this project has no test" in said
    for kind in ("2", "8", "galton", "verge"):
        assert f"has no case of the kind {kind}" in said
    compared = done.stdout.partition("[100%]")[0].count(".")
    assert compared >= 2 + 1 + 2 + len(next(iter(joint.values()))["cases"])
