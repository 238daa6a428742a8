import json
from dataclasses import replace

import pendulum

import models
from mechanism_fmu.fmu.parts.documentation import page
from mechanism_fmu.fmu.parts.resources import LOGIC, logic, switches_of
from mechanism_fmu.model.transitions import logic_of
from mechanism_fmu.statechart.records import decode

RATCHET = models.load("ratchet").MODEL


def data_of(model):
    return json.loads(logic(model)[LOGIC])


def test_a_model_without_contacts_has_no_file():
    bare = replace(pendulum.MODEL, mechanism=lambda values: replace(pendulum.MODEL.mechanism(values), contacts=()))
    assert logic(bare) == {}


def test_a_model_without_switches_has_one_variant():
    data = data_of(pendulum.MODEL)
    assert (data["format"], data["contacts"], data["switches"]) == (1, ["wall"], [])
    assert data["choices"] == {"": 0}
    assert {"guard": 0, "subject": 0, "name": "wall.gap"} in data["events"]
    (variant,) = data["variants"]
    assert decode(variant) == logic_of(pendulum.MODEL.build(pendulum.MODEL.values()))


def test_the_switches_are_the_parameters_that_change_the_logic():
    names = [p.name for p in switches_of(RATCHET)]
    assert names == [
        *("guided", "holding_pawl", "restitution", "holding_pawl_restitution"),
        *("friction", "joint_friction_radius"),
    ]


def test_every_choice_of_the_ratchet_is_the_logic_of_those_values():
    data = data_of(RATCHET)
    assert len(data["choices"]) == 64
    for key, place in data["choices"].items():
        values = {
            name: 0.5 * int(bit) if "restitution" in name or "friction" in name else int(bit)
            for name, bit in zip(data["switches"], key, strict=True)
        }
        assert decode(data["variants"][place]) == logic_of(RATCHET.build(RATCHET.values(**values)))
    assert len(data["variants"]) < len(data["choices"])


def test_the_same_model_gives_the_same_bytes():
    assert logic(RATCHET) == logic(replace(RATCHET))
    assert logic(RATCHET)[LOGIC].endswith(b"}\n")


def test_the_documentation_shows_diagram_and_tables():
    html = page(RATCHET, models.available()["ratchet"], ())
    assert "<h2>Modes and transitions</h2>" in html
    assert '<svg xmlns="http://www.w3.org/2000/svg" class="statechart"' in html
    assert "<td><code>face.touches and face.approaches</code></td>" in html
    assert "<td><code>face.leaves</code></td>" in html
