"""One force element on one mass, and outputs of a part by their names."""

from hypothesis import strategies as st

from mechanism_fmu.model import Body, Mechanism, Output, Settings
from mechanism_fmu.simulation import Simulation

EXACT = Settings(relative_tolerance=1e-12)
ENERGIES = tuple(Output(name, f"energy.{name}", "") for name in ("kinetic", "spring", "work", "lost"))
ORIGIN = (0.0, 0.0)
#: Any point of a body, near its centre.
POINT = st.tuples(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3))


def read(name, *quantities):
    return tuple(Output(f"{name}.{quantity}", f"{name}.{quantity}", "") for quantity in quantities)


def on_a_line(element, start=2.1, rate=0.0, outputs=(), mass=0.7):
    """A mass on the x axis with an element to the origin."""
    body = Body("mass", mass, 1.0, (start, 0.0, 0.0), (rate, 0.0, 0.0))
    outputs = (*read("mass", "x", "x_rate"), *outputs, *ENERGIES)
    return Simulation(Mechanism((body,), forces=(element,), outputs=outputs, settings=EXACT))
