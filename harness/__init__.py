"""The machine around an FMU: run it, record it, and see what its impacts do.

The harness knows a mechanism only through its FMU. In Python, start with `experiment.perform`:

    with open_fmu(Path("build/Ratchet.fmu")) as fmu:
        run = perform(fmu, Experiment(stop_time=6.0, step=1e-3))
    print(run.impacts)

Where to find what:

- an FMU: `description` (what it says about itself), `units` and `si`, `logic` (its modes), `drawing`, `messages`,
  `fmu` (fmpy), `workspace`
- simulation: `slave` (what can be simulated), `clock`, `inputs`, `master` (moves time), `observers` (look on):
  `recorder`, `impacts`, `events` (`buffers`); `experiment` puts them together
- several FMUs as one machine: `coupling`, `bonds` (the energy that a coupling makes)
- meaning: `tooth_stress`, `checks` (verdicts), `paper` (its claims), `study` and `wheels`, `cycle` (indexing),
  `validate`
- many designs: `designs` (the file, one design, many of them, the best), `sweep_command`, `optimise_command`
- for people: `assignments` (name=value unit), `numbers`, `results` (files), `report`, `cli`, `commands`, `ending`,
  `terminal`, `interrupt`

The modules named in `__all__` are for users (docs/public-interface.md); import from them, e.g. `from harness.fmu import
open_fmu`. They are not imported here, because `mechanism-fmu --help` must not wait for them.
"""

__all__ = [
    "bonds",
    "clock",
    "coupling",
    "errors",
    "experiment",
    "fmu",
    "master",
    "observers",
    "recorder",
    "results",
    "slave",
]
