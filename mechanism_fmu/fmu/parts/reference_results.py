"""Reference results that travel in an FMU: what its default experiment gives, and with which parameters.

By the layered standard FMI-LS-REF 1.0.0-beta.1: a manifest names a CSV file of results and an SSP parameter set.
Whoever has the FMU can see whether it does in their tool what it did where it was built.
"""

from __future__ import annotations

import math
from ctypes import CDLL
from xml.etree.ElementTree import Element, SubElement, register_namespace

from ... import __version__
from ...model import Model, compile_mechanism
from ...moving import MovingMechanism, SimulationError
from ...tables.layout import pack
from .model_description import to_bytes
from .variables import Variable, variables_of

#: Folder of the files, within the FMU.
FOLDER = "extra/org.fmi-standard.fmi-ls-ref"

#: Most rows of results behind the first.
_ROWS = 60
#: Significant digits: one more than the usual tolerance of the motion has.
_DIGITS = 10
#: An output that never reaches this share of its nominal value is rounding about 0, another one on another processor.
_ROUNDING = 1e-9

_MANIFEST = "http://fmi-standard.org/fmi-ls-manifest"
_VALUES = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"


def reference_results(model: Model, library: CDLL | None = None) -> dict[str, bytes]:
    """Manifest, results and parameter set by their paths within the FMU; none when the experiment cannot be finished.

    Args:
        model: it.
        library: of the compiled engine; None: as `engine.run.engine_for` finds it.
    """
    rows = _rows(model, library)
    if rows is None:
        return {}
    results, parameters = f"{model.name}_ref.csv", f"{model.name}_default.ssv"
    return {
        f"{FOLDER}/fmi-ls-manifest.xml": _manifest(results, parameters),
        f"{FOLDER}/{results}": "".join(f"{','.join(row)}\n" for row in rows).encode(),
        f"{FOLDER}/{parameters}": _parameter_set(model),
    }


def result_points(model: Model) -> list[float]:
    """Times of the results [s]: about `_ROWS` communication points of the default experiment, from 0 to its end."""
    return [0.0, *(ends[-1] for ends in _steps(model)[1:])]


def _steps(model: Model) -> list[list[float]]:
    """Ends of the default experiment's steps [s], from row to row: some outputs are about the last step."""
    count = max(1, math.ceil(model.stop_time / model.step_size - 1e-9))
    every = math.ceil(count / _ROWS)
    ends = [*(k * model.step_size for k in range(1, count)), model.stop_time]
    return [[], *(ends[first : first + every] for first in range(0, count, every))]


def _rows(model: Model, library: CDLL | None) -> list[list[str]] | None:
    """The results as a table of texts with a head.

    Buffers of single impacts and events are left out, and outputs that are rounding: a slip where nothing can slip.
    """
    outputs = [v for v in variables_of(model) if v.causality == "output" and "[" not in v.name]
    mechanism = model.build(model.values())
    simulation = MovingMechanism.over(mechanism, pack(compile_mechanism(mechanism)), library)
    times = result_points(model)
    found: list[dict[str, float]] = []
    try:
        simulation.begin(0.0)
        for ends in _steps(model):
            for end in ends:
                simulation.advance(end)
            found.append(simulation.read())
    except SimulationError:
        return None
    shown = [v for v in outputs if not _is_rounding(v, [values[v.name] for values in found])]
    rows = [
        [_text(time), *(_value(v, values[v.name]) for v in shown)] for time, values in zip(times, found, strict=True)
    ]
    return [["time", *(v.name for v in shown)], *rows]


def _is_rounding(variable: Variable, values: list[float]) -> bool:
    largest = max(map(abs, values))
    return variable.type == "Real" and 0.0 < largest < _ROUNDING * (variable.nominal or 1.0)


def _value(variable: Variable, value: float) -> str:
    return _text(value) if variable.type == "Real" else str(int(value))


def _text(value: float) -> str:
    return f"{value:.{_DIGITS}g}"


def _manifest(results: str, parameters: str) -> bytes:
    register_namespace("fmi-ls", _MANIFEST)
    root = Element(
        "fmiReferences",
        {
            f"{{{_MANIFEST}}}fmi-ls-name": "org.fmi-standard.fmi-ls-ref",
            f"{{{_MANIFEST}}}fmi-ls-version": "1.0.0-beta.1",
            f"{{{_MANIFEST}}}fmi-ls-description": (
                "Layered Standard providing information on related files included in an FMU."
            ),
        },
    )
    SubElement(
        root, "Related", type="text/csv", source=results, role="result", description="Outputs of the default experiment"
    )
    SubElement(
        root,
        "Related",
        type="application/x-ssp-parameter-set",
        source=parameters,
        role="parameter",
        description="The parameters' default values",
    )
    return to_bytes(root)


def _parameter_set(model: Model) -> bytes:
    """The parameters' default values as SSP 1.0 has them."""
    register_namespace("ssv", _VALUES)
    tool = f"mechanism_fmu {__version__}"
    root = Element(f"{{{_VALUES}}}ParameterSet", version="1.0", name=f"{model.name}_default", generationTool=tool)
    group = SubElement(root, f"{{{_VALUES}}}Parameters")
    for variable in variables_of(model):
        if variable.causality != "parameter" or variable.start is None:
            continue
        parameter = SubElement(group, f"{{{_VALUES}}}Parameter", name=variable.name)
        text = str(variable.start).lower() if variable.type == "Boolean" else repr(variable.start)
        SubElement(parameter, f"{{{_VALUES}}}{variable.type}", value=text)
    return to_bytes(root)
