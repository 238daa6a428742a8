"""Machines: several FMUs that exchange outputs and inputs (docs/how-to/machines.md).

- `connection` and `structure`: who follows whom, known before any component is there
- `machine`: parts and their exchange (`part`, `exchange`: values that are no continuous signals, `event_iteration`)
- `stepping`: the algorithms by which it takes a step; `running`: from start to stop
- `observers`: energies of couplings, impacts, recorded signals, statistics
- `file`: a machine in TOML; `formats`: SSP and containers, for other tools
"""

__all__ = ["connection", "machine", "part", "running", "stepping"]
