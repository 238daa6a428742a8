"""A parallelogram whose cranks turn through the line of their hinges, as a model."""

from types import SimpleNamespace

from mechanism_fmu.model import GROUND, Body, Mechanism, Model, Output, Revolute, settings_parameters


def _mechanism(_values: SimpleNamespace) -> Mechanism:
    return Mechanism(
        bodies=(
            Body("left", 1.0, 1 / 12, (0.0, 0.5, 0.0), start_rate=(0.5, 0.0, -1.0)),
            Body("right", 1.0, 1 / 12, (1.0, 0.5, 0.0), start_rate=(0.5, 0.0, -1.0)),
            Body("coupler", 1.0, 1 / 12, (0.5, 1.0, 0.0), start_rate=(1.0, 0.0, 0.0)),
        ),
        joints=(
            Revolute("a", "left", (0.0, -0.5), GROUND, (0.0, 0.0)),
            Revolute("b", "right", (0.0, -0.5), GROUND, (1.0, 0.0)),
            Revolute("c", "coupler", (-0.5, 0.0), "left", (0.0, 0.5)),
            Revolute("d", "coupler", (0.5, 0.0), "right", (0.0, 0.5)),
        ),
        gravity=(0.0, -9.81),
        outputs=(
            Output("left_angle", "left.angle", "Angle of the left crank", "rad"),
            Output("right_angle", "right.angle", "Angle of the right crank", "rad"),
        ),
        through_singularities=True,
    )


MODEL = Model("FlatParallelogram", "A parallelogram that lies flat", settings_parameters(), _mechanism)
