from pathlib import Path

from fake_slave import fake_description

from harness.fmu.values import in_display_unit
from harness.run.results import versions
from mechanism_fmu import __version__


def test_a_result_says_what_made_it() -> None:
    found = versions(Path("build/Fake.fmu"), fake_description())
    assert (found["FMU"], found["GUID of the FMU"]) == ("Fake.fmu", "{guid}")
    assert found["mechanism_fmu"] == __version__
    assert {"numpy", "scipy", "pandas", "fmpy", "pillow", "pyarrow", "rainflow", "optuna"} <= set(found)
    assert all(found.values())


def test_a_table_has_values_in_display_units() -> None:
    description = fake_description()
    assert in_display_unit(1.5707963267948966, "tooth_slope_angle", description) == ("90", "deg")
    assert in_display_unit(293.15, "oil_temperature", description) == ("293.15", "K")  # the FMU names no other
    assert in_display_unit(9e-5, "crank_inertia", description) == ("9e-05", "kg.m2")
    assert in_display_unit(0.5, "restitution", description) == ("0.5", "1")
    assert in_display_unit(20, "tooth_count", description) == ("20", "1")
    assert in_display_unit(True, "guided", description) == ("true", "")
    assert in_display_unit("cold", "note", description) == ("cold", "")
