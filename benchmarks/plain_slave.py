"""The slave of an FMU as an engineer would write it by hand: the plain ratchet, stepped by `solve_ivp`."""

from __future__ import annotations

from typing import Any

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

from .plain import INPUTS, OUTPUTS, at_rest, driven, outputs
from .reference import step


class PlainRatchet(Fmi2Slave):  # type: ignore[misc]  # pythonfmu is not typed
    """The inputs and the main outputs of Ratchet.fmu."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.modelName = "PlainRatchet"
        self._ratchet, self._state = at_rest()
        self.__dict__.update(INPUTS)
        self._show()
        continuous = Fmi2Variability.continuous
        for name in INPUTS:
            self.register_variable(Real(name, causality=Fmi2Causality.input, variability=continuous))
        for name in OUTPUTS:
            self.register_variable(Real(name, causality=Fmi2Causality.output, variability=continuous))

    def do_step(self, _current_time: float, step_size: float) -> bool:
        """fmi2DoStep."""
        self._ratchet = driven(self._ratchet, self.drive_torque, self.spring_preload, self.load_torque)
        self._state = step(self._ratchet, self._state, step_size)
        self._show()
        return True

    def _show(self) -> None:
        self.__dict__.update(zip(OUTPUTS, outputs(self._state).tolist(), strict=True))
