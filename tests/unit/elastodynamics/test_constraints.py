"""Rows that keep a body rigid, by hand: a small turn and a shift leave them at zero, and nothing else does."""

from types import SimpleNamespace

import numpy as np

from mechanism_fmu.elastodynamics.structure.compatibility import _rigid_rows

ANGLE = 0.7
POINTS = ((0.0, 0.0), (0.4, -0.1), (-0.2, 0.3))


class Turned:
    """A pose at one time, in which every body is turned by `ANGLE`."""

    time = np.zeros(1)

    def turned(self, _body: str, point: tuple[float, float]) -> np.ndarray:
        (x, y), c, s = point, np.cos(ANGLE), np.sin(ANGLE)
        return np.array([[c * x - s * y, s * x + c * y]])


def test_rows_of_a_rigid_body_allow_its_rigid_displacements_only() -> None:
    places = tuple(SimpleNamespace(body="plate", point=point) for point in POINTS)
    mechanism = SimpleNamespace(members=(), bodies=(SimpleNamespace(name="plate"),))
    rows = _rigid_rows(mechanism, SimpleNamespace(places=places), Turned())  # type: ignore[arg-type]
    assert [(body, first, other) for _, body, first, other in rows] == [("plate", 0, k) for k in (1, 1, 2, 2)]
    shift, turn = np.array([0.3, -0.2]), 0.05
    for row, _, _, other in rows:
        arm = Turned().turned("plate", POINTS[other])[0]
        there = shift + turn * np.array([-arm[1], arm[0]])
        rigid = np.array([*shift, turn, *there, 0.0])
        assert abs(row[0] @ rigid) < 1e-15
        assert abs(row[0]).max() == 1.0
        assert max(abs(row[0] @ (rigid * np.array([0, 0, 1, 0, 0, 0]))), abs(row[0] @ [1, 1, 0, 0, 0, 0])) > 1e-3
