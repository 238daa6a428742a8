"""Run an SSP file in fmpy, with what its simulate_ssp (0.3.32) leaves out: parameters, factors, offsets, first inputs.

    python docs/examples/ssp_in_fmpy.py machine.ssp 4 2e-3        writes machine.csv: 4 s in steps of 2 ms

fmpy does the work; this gives it what it reads but does not use. A row has what the step from its time on has come to.
"""

from __future__ import annotations

import sys
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from unittest import mock
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt
from fmpy.ssp import simulation, ssd

_SSD = "{http://ssp-standard.org/SSP1/SystemStructureDescription}"
_SSC = "{http://ssp-standard.org/SSP1/SystemStructureCommon}"


class Transformed:
    """A connector as it is seen through the linear transformation of its connection."""

    def __init__(self, connector: Any, factor: float, offset: float) -> None:
        self.parent = connector.parent
        self._connector, self._factor, self._offset = connector, factor, offset

    @property
    def value(self) -> float:
        """Factor * value + offset."""
        return self._factor * self._connector.value + self._offset


def simulate(path: Path, stop_time: float, step: float) -> npt.NDArray[np.void]:
    """Run the file; a row for each step, with `time` and the connectors by name."""
    with _completed(path):
        found: npt.NDArray[np.void] = simulation.simulate_ssp(
            str(path), stop_time=stop_time, step_size=step, parameter_set=parameters(path)
        )
    return found


def parameters(path: Path) -> Any:
    """The parameters of all components in one set, with their names before them, and Booleans as numbers."""
    whole = ssd.ParameterSet(name="all")
    for component in ssd.read_ssd(str(path)).system.elements:
        for binding in component.parameterBindings:
            for parameter in (p for one in binding.parameterValues for p in one.parameters):
                value = float(parameter.value == "true") if parameter.type == "Boolean" else parameter.value
                name = f"{component.name}.{parameter.name}"
                whole.parameters.append(ssd.Parameter(name=name, type=parameter.type, value=value))
    return whole


def transformations(path: Path) -> dict[tuple[str, str], tuple[float, float]]:
    """Factor and offset by the component and the connector that a connection ends at."""
    with zipfile.ZipFile(path) as archive:
        root = ElementTree.fromstring(archive.read("SystemStructure.ssd"))
    found = {}
    for connection in root.iter(f"{_SSD}Connection"):
        linear = connection.find(f"{_SSC}LinearTransformation")
        if linear is not None:
            end = connection.attrib["endElement"], connection.attrib["endConnector"]
            found[end] = float(linear.get("factor", 1.0)), float(linear.get("offset", 0.0))
    return found


@contextmanager
def _completed(path: Path) -> Iterator[None]:
    """Let fmpy transform what it passes on, and begin with what the outputs are."""
    known = transformations(path)
    usual_connections, usual_step = simulation.get_connections, simulation.do_step
    components: list[Any] = []
    connections: list[tuple[Any, Any]] = []

    def get_connections(system: Any) -> list[tuple[Any, Any]]:
        components[:] = ssd.find_components(system)
        for start, end in usual_connections(system):
            connections.append((Transformed(start, *known.get((end.parent.name, end.name), (1.0, 0.0))), end))
        return connections

    def first(component: Any, time: float, step_size: float) -> None:
        _exchange(components, connections)
        steps["take"] = usual_step
        usual_step(component, time, step_size)

    steps: dict[str, Callable[..., None]] = {"take": first}
    with (
        mock.patch.object(simulation, "get_connections", get_connections),
        mock.patch.object(simulation, "do_step", lambda *given, **named: steps["take"](*given, **named)),
    ):
        yield


def _exchange(components: list[Any], connections: list[tuple[Any, Any]]) -> None:
    """Let inputs be what outputs are, as often as there are components: some outputs follow an input at once."""
    for _ in components:
        for component in components:
            for connector in component.connectors:
                if connector.kind == "output":
                    connector.value = simulation.get_value(component, connector.name)
        for start, end in connections:
            end.value = start.value
            simulation.set_value(end.parent, end.name, end.value)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    file = Path(sys.argv[1])
    results = simulate(file, float(sys.argv[2]), float(sys.argv[3]))
    heading = ",".join(results.dtype.names or ())
    np.savetxt(file.with_suffix(".csv"), results.tolist(), delimiter=",", header=heading, comments="", fmt="%.17g")
