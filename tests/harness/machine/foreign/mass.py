"""The source of a foreign FMU, of FMI 2.0 by pythonfmu: a mass that a force moves, integrated exactly."""

from typing import Any

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

from mechanism_fmu.fmu.start import tidy_up


class Mass(Fmi2Slave):  # type: ignore[misc]
    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.mass, self.x, self.v, self.force = 1.0, 1.0, 0.0, 0.0
        self.register_variable(Real("mass", causality=Fmi2Causality.parameter, variability=Fmi2Variability.fixed))
        self.register_variable(Real("force", causality=Fmi2Causality.input))
        self.register_variable(Real("x", causality=Fmi2Causality.output))
        self.register_variable(Real("v", causality=Fmi2Causality.output))

    def do_step(self, current_time: float, step_size: float) -> bool:
        a = self.force / self.mass
        self.x += self.v * step_size + a * step_size**2 / 2
        self.v += a * step_size
        return True


# What pythonfmu's wrapper does wrong would end the process of the tests, too, now and then with an abort.
tidy_up(globals())
