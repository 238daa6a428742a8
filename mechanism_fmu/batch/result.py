"""What came of many designs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .numbers import Array


@dataclass(frozen=True)
class BatchResult:
    """What came of many designs, in SI units. Columns have the shape (designs,), and NaN where a design has failed.

    Attributes:
        designs: what was asked: parameters and inputs by name.
        values: outputs and calculated parameters at the time reached, by name.
        least, greatest: of the same, over the start, all communication points and the end; empty if nobody asked.
        impact_count: impacts until then.
        impacts: the first impacts of each design, by field as in the FMU's `impacts[k].<field>`, shape (designs, kept);
            NaN where there were fewer.
        reached: time reached [s]; of a failed design the last good instant, NaN if it did not start.
        pulled: of each contact, by name, the first time [s] at which it pulled where a real one would open, as a guided
            one may; infinite: never.
        failures: why a design failed, in the FMU's words; "" of those that did not.
        warnings: what the FMU's log warns of, at the start and where contacts pull; "" of those that did well.
        compiled: how the engine was compiled: "ahead of time" or "just in time".
        threads: how many ran them.
    """

    designs: Mapping[str, Array]
    values: Mapping[str, Array]
    least: Mapping[str, Array]
    greatest: Mapping[str, Array]
    impact_count: Array
    impacts: Mapping[str, Array]
    reached: Array
    pulled: Mapping[str, Array]
    failures: tuple[str, ...]
    warnings: tuple[str, ...]
    compiled: str
    threads: int

    def table(self) -> dict[str, Array]:
        """All columns under the names of the FMU's variables, for `pandas.DataFrame`.

        Designs and outputs as they are called, extremes as `<output>.least` and `<output>.greatest`, impacts as
        `impacts[k].<field>`, and `impacts`, `time_reached` [s],
        `<contact>.pulls_from` [s], `failure` and `warning`.
        """
        kept = {
            f"impacts[{k + 1}].{name}": column[:, k]
            for name, column in self.impacts.items()
            for k in range(column.shape[1])
        }
        return {
            **self.designs,
            **self.values,
            **{f"{name}.least": column for name, column in self.least.items()},
            **{f"{name}.greatest": column for name, column in self.greatest.items()},
            "impacts": self.impact_count,
            **kept,
            "time_reached": self.reached,
            **{f"{name}.pulls_from": column for name, column in self.pulled.items()},
            "failure": np.array(self.failures, object),
            "warning": np.array(self.warnings, object),
        }
