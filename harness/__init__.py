"""The machine around an FMU: run it, record it, and see what its impacts do.

The harness knows a mechanism only through its FMU. A master moves time (`master`), anything with the interface of
`slave` can be simulated, observers look on (`observers`). In Python, start with `experiment.perform`:

    with open_fmu(Path("build/Ratchet.fmu")) as fmu:
        run = perform(fmu, Experiment(stop_time=6.0, step=1e-3))
    print(run.impacts)
"""
