"""Machines: several FMUs that exchange outputs and inputs (docs/machines.md).

- `structure`: who follows whom, known before any component is there (`loops`, `order`)
- `machine`: parts and their exchange (`component`, `part`, `signals`, `connection`, `extrapolation`, `names`); `run`;
  `initialization`, `driven` (inputs of a table), `held` (signals that are not continuous), `events` (FMI 3.0)
- `algorithms`: how it takes a step, a file each; `algorithm` chooses, `cautions` says what one cannot do
- what looks on: `record` (`growing_table`, `recorded`), `impacts` (`watched`, `impact_times`), `bonds` (`port`),
  `statistics`
- `remote`: a component in a process of its own
- `file`: a machine in TOML; `ssp` and `container`: for other tools
"""

__all__ = ["algorithms", "component", "connection", "extrapolation", "machine", "remote", "run"]
