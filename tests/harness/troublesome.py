"""The source of an FMU that misbehaves on demand."""

import os
from typing import Any

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real
from pythonfmu.enums import Fmi2Status

from mechanism_fmu.fmu.start import tidy_up

BEHAVE, DISCARD, RAISE, RAISE_SILENTLY, FORMAT, RAISE_AT_START, COMPLAIN = range(7)


class Troublesome(Fmi2Slave):  # type: ignore[misc]
    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if os.environ.get("STILLBORN"):
            raise RuntimeError("no engine here")
        self.trouble = BEHAVE
        self.y = 0.0
        self.register_variable(Integer("trouble", causality=Fmi2Causality.parameter, variability=Fmi2Variability.fixed))
        self.register_variable(Real("y", causality=Fmi2Causality.output))

    def exit_initialization_mode(self) -> None:
        if self.trouble == RAISE_AT_START:
            self.log("the crank is too short by 3 mm; lengthen it.", Fmi2Status.error)
            raise ValueError

    def do_step(self, current_time: float, step_size: float) -> bool:
        late = current_time > 0.45
        if self.trouble == FORMAT and late:
            self.log("loaded to 100%, %s and %n are only text", Fmi2Status.warning)
        if self.trouble == COMPLAIN and not late and current_time > 0.35:
            self.log("the oil is hot.", Fmi2Status.error)
        if self.trouble == RAISE and late:
            self.log("the pawl has left the wheel.", Fmi2Status.error)
        if self.trouble in (RAISE, RAISE_SILENTLY) and late:
            raise ValueError
        self.y = current_time + step_size
        return not (self.trouble == DISCARD and late)


# What pythonfmu's wrapper does wrong would end the process of the tests, too, now and then with an abort.
tidy_up(globals())
