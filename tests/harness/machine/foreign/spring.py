"""The source of a foreign FMU, of FMI 3.0 by pythonfmu3: a spring, whose force follows its length at once."""

from typing import Any

from pythonfmu3 import Float64, Fmi3Causality, Fmi3Slave, Fmi3Variability


class Spring(Fmi3Slave):  # type: ignore[misc]
    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.stiffness, self.x, self.time = 4.0, 0.0, 0.0
        self.register_variable(
            Float64("time", causality=Fmi3Causality.independent, variability=Fmi3Variability.continuous)
        )
        self.register_variable(
            Float64("stiffness", causality=Fmi3Causality.parameter, variability=Fmi3Variability.fixed)
        )
        self.register_variable(Float64("x", causality=Fmi3Causality.input))
        self.register_variable(
            Float64("force", causality=Fmi3Causality.output, getter=lambda: -self.stiffness * self.x)
        )

    def do_step(self, current_time: float, step_size: float) -> bool:
        self.time = current_time + step_size
        return True
