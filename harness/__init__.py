"""The machine around an FMU: run it, record it, and see what its impacts do.

The harness knows a mechanism only through its FMU. In Python, start with `run.experiment.perform`:

    with open_fmu(Path("build/Ratchet.fmu")) as fmu:
        run = perform(fmu, Experiment(stop_time=6.0, step=1e-3))
    print(run.impacts)

From the ground up; each knows only those above it in this list:

- `errors`: what can go wrong
- `fmu`: one FMU: its description, units, values, instances, here or in processes of their own
- `toml_file`: files that people write
- `analysis`: what a run means: impacts, stress, damage, compliance; laws of impacts fitted to measured ones
- `run`: one run: time, inputs, recording, verdicts, files
- `machine`: several FMUs as one machine; `designs`: many designs of one mechanism
- `report`: reports and figures
- `papers`: what the papers say, worked out
- `app`: the command `mechanism-fmu`

The modules named in `__all__` are for users (docs/reference/public-interface.md); import from them, e.g. `from
harness.fmu import open_fmu`. They are not imported here, because `mechanism-fmu --help` must not wait for them.
"""

from ._moved import install as _install

__all__ = ["errors", "fmu", "machine", "run"]

_install()
