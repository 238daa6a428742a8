"""Many designs of one mechanism: sweeps and optima, each from one TOML file.

Internal: they serve the commands `sweep` and `optimise`. In the order in which a design passes them:

- the file (`harness/toml_file.py`): `plan` ([fmu], [run], [set]), `quantities` ([record]),
  `variation` ([vary.*]), `sampling` (the list of designs), `sweep_file` (all of it)
- one design: `task` (what is done with each), `by_fmu` (a run), `by_batch` (hundreds in one call),
  `of_impacts`, `ways` (which ways there are)
- many: `workers` (processes), `cluster` (Dask), `store` (files that survive everything)
- `sweep`: all of it together

For an optimum, besides: `optimum_file`, `goal` (objective and constraints), `history` (what was asked for is not run
again), `search`, `sensitivity`.
"""

__all__: list[str] = []
