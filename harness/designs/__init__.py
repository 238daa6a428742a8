"""Many designs of one mechanism: sweeps and optima, each from one TOML file.

Internal: they serve the commands `sweep` and `optimise`. In the order in which a design passes them:

- the file: `variation` (what all designs share, and what is varied), `sweep` or `optimum_file` (all of it)
- one design: `task` (what is done with each), `by_fmu` (a run), `by_batch` (hundreds in one call)
- many: `workers` (this process or others), `cluster` (Dask), `store` (files that survive everything)
- `search`: optimisation methods; `sensitivity`: Sobol indices, how much each variable matters near the best
"""

__all__: list[str] = []
