"""Motions that every flavour and platform must give to the bit."""

import importlib

import numpy as np

from mechanism_fmu import codes
from mechanism_fmu.fmu.parts.variables import variables_of
from mechanism_fmu.simulation import Simulation

#: Values other than the defaults; for how long [s], in how many steps.
CASES = {
    "ratchet": ({}, 6.0, 600),
    "cam_drive": ({"unilateral": True, "cam_speed_start": 25.0, "drive_stiffness": 0.0, "restitution": 0.3}, 1.0, 200),
    "geneva": ({}, 2.0, 400),
    "four_bar": ({"crank_speed_start": 6.0}, 2.0, 400),
    "slider_crank": ({"slider_friction": 0.1, "crank_speed_start": 12.0}, 1.0, 200),
    "gear_train": ({}, 1.0, 100),
    "rotary_table": ({}, 1.0, 100),
}


def model_of(name):
    return importlib.import_module(f"models.{name}.model")


def continuous_outputs(model):
    outputs = [v for v in variables_of(model) if v.causality == "output" and v.type == "Real"]
    return [v for v in outputs if "[" not in v.name and not v.name.startswith("impact")]


def motion(name):
    """Of a case, in Python."""
    values, until, steps = CASES[name]
    return motion_of(model_of(name).MODEL, values, until, steps)


def motion_of(model, values, until, steps):
    """In Python: rows at the points of the grid and behind impacts, as `page_run` of page.c has them."""
    names = [v.name for v in continuous_outputs(model)]
    simulation = Simulation(model.build(model.values(**values)))

    def row(struck):
        found = simulation.read()
        return [simulation.time, struck, *(found[name] for name in names)]

    rows = [row(0.0)]
    for k in range(1, steps + 1):
        target = k * (until / steps)
        simulation.begin_step()
        while simulation.time < target:
            impacts = simulation.counters[codes.COUNT_IMPACTS]
            simulation.go_on(target, codes.STOP_AT_IMPACT)
            struck = float(simulation.counters[codes.COUNT_IMPACTS] > impacts)
            rows.append(row(struck))
    return np.array(rows)
