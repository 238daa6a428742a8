"""The machine around an FMU: run it, record it, and see what its impacts do.

The harness knows a mechanism only through its FMU. In Python, start with `experiment.perform`:

    with open_fmu(Path("build/Ratchet.fmu")) as fmu:
        run = perform(fmu, Experiment(stop_time=6.0, step=1e-3))
    print(run.impacts)

Where to find what:

- an FMU: `description` (what it says about itself), `units` and `si`, `logic` (its modes), `drawing`, `messages`,
  `fmu` (by way of fmpy: extracted, instances of FMI 2 and 3)
- simulation: `slave` (what can be simulated), `clock`, `inputs`, `master` (moves time), `observers` (look on):
  `recorder`, `impacts`, `events` (`buffers`); `experiment` puts them together
- meaning: `declared` (what the FMU asks to be analysed), `analyses` (the list: `tooth_stress`, `tooth_damage`,
  `compliance`), `checks` (verdicts), `validate`; of one paper: `paper` (its claims), `study` and `wheels`, `cycle`
- files that people write: `toml_file` (tables, keys, lines, mistakes), `toml_values` (with units)
- several FMUs as one machine: `machine` (file, parts, algorithms, observers, SSP, container), `machine_cli`,
  `machine_command`, `processes`
- many designs: `designs` (the file, one design, many of them, the best), `designs_command`
- for people: `assignments` (name=value unit), `numbers`, `results` (files), `report`, `cli` (`cli_group`), `commands`,
  `ending`, `terminal`, `interrupt`

The modules named in `__all__` are for users (docs/public-interface.md); import from them, e.g. `from harness.fmu import
open_fmu`. They are not imported here, because `mechanism-fmu --help` must not wait for them.
"""

__all__ = [
    "clock",
    "errors",
    "experiment",
    "fmu",
    "machine",
    "master",
    "observers",
    "recorder",
    "results",
    "slave",
]
