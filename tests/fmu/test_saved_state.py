"""Saving and restoring: everything, bit for bit, here and elsewhere; and nothing that is not a state."""

import math
import struct
import subprocess
import sys
import zlib

import pytest
from fmpy.fmi1 import FMICallException

import models
from mechanism_fmu.model import compile_mechanism
from mechanism_fmu.tables.layout import FIELDS, pack, shape_of
from mechanism_fmu.tables.sizes import sizes_of
from tests.fuzz.forged import forged_words

ROUGH = {"restitution": 0.5, "tooth_count": 15, "relative_tolerance": 1e-8}


def rest_of_run(one, until=1.6):
    """All outputs at every step to the end, as bytes."""
    rows = []
    while one.time < until - 1e-9:
        one.set({"drive_torque": 1e-3 + 1e-4 * (round(one.time * 100) % 5)})
        one.step(0.01)
        rows.append(struct.pack(f"{len(one.fmu.named('output'))}d", *map(float, one.outputs().values())))
    return b"".join(rows)


def block(model):
    return pack(compile_mechanism(model.build(model.values())))


@pytest.mark.parametrize("at", [0.0, 0.5, 0.93, 0.94, 0.95, 1.2])
def test_replay_is_bit_equal(instance, at):
    one = instance().begin(ROUGH)
    one.run(at, 0.01)
    state = one.save()
    expected = rest_of_run(one)

    one.restore(state, at)
    assert rest_of_run(one) == expected
    one.restore(state, at)
    assert rest_of_run(one) == expected
    one.slave.freeFMUstate(state)


def test_replay_in_another_instance_is_bit_equal(instance):
    one = instance().begin(ROUGH)
    one.run(0.945, 0.005)
    saved = one.save_bytes()
    expected = rest_of_run(one)

    fresh = instance("other")
    fresh.restore_bytes(saved, 0.945)
    busy = instance("busy").begin({"tooth_count": 20})
    busy.run(0.3, 0.1)
    busy.restore_bytes(saved, 0.945)

    assert rest_of_run(fresh) == expected
    assert rest_of_run(busy) == expected
    assert busy["tooth_count"] == 15


def test_replay_in_another_process_is_bit_equal(instance, tmp_path):
    one = instance().begin(ROUGH)
    one.run(0.945, 0.005)
    (tmp_path / "state").write_bytes(one.save_bytes())
    program = (
        "import sys; from pathlib import Path\n"
        "from tests.fmu.conformance.host import Fmu, Instance\n"
        "from tests.fmu.test_saved_state import rest_of_run\n"
        "with Instance(Fmu.at(sys.argv[1])) as one:\n"
        "    one.restore_bytes(Path(sys.argv[2], 'state').read_bytes(), 0.945)\n"
        "    Path(sys.argv[2], 'rest').write_bytes(rest_of_run(one))\n"
    )
    subprocess.run([sys.executable, "-c", program, one.fmu.folder, str(tmp_path)], check=True, timeout=120)

    assert (tmp_path / "rest").read_bytes() == rest_of_run(one)


def test_state_holds_parameters_before_initialization(instance):
    one = instance()
    one.set(ROUGH)
    saved = one.save_bytes()
    other = instance("other")
    other.restore_bytes(saved, 0.0)
    other.begin()
    one.begin()

    assert rest_of_run(other) == rest_of_run(one)


def test_many_states_at_once(instance):
    one = instance().begin(ROUGH)
    states, wheel = [], []
    for _ in range(200):
        states.append(one.save())
        wheel.append(one["wheel_angle"])
        one.step(0.01)
    for k in (0, 199, 50, 94, 93):
        one.restore(states[k], 0.01 * k)
        assert one["wheel_angle"] == wheel[k]
    for state in states:
        one.slave.freeFMUstate(state)


def damaged(saved):
    yield "empty", b""
    yield "one byte", b"M"
    yield "half", saved[: len(saved) // 2]
    yield "one byte short", saved[:-1]
    yield "one byte long", saved + b"\0"
    yield "zeros", bytes(len(saved))
    for k in range(0, len(saved), 97):
        yield f"bit of byte {k}", saved[:k] + bytes([saved[k] ^ 0x10]) + saved[k + 1 :]


def test_state_of_another_model_is_refused(instance):
    """The bytes are sound, but the fingerprint (bytes 8 to 24) is another one."""
    one = instance().begin()
    saved = one.save_bytes()
    other = saved[:8] + bytes(16) + saved[24:-4]
    with pytest.raises(FMICallException):
        one.restore_bytes(other + struct.pack("<I", zlib.crc32(other)), 0.0)

    assert any("belongs to another model or another version" in message.text for message in one.log)


def test_what_is_not_a_state_is_refused_and_survived(instance):
    one = instance().begin()
    one.run(0.5, 0.1)
    saved = one.save_bytes()
    for what, bad in damaged(saved):
        said = len(one.log)
        with pytest.raises(FMICallException):
            one.restore_bytes(bad, 0.5)
        assert any("saved state" in message.text for message in one.log[said:]), what
    one.restore_bytes(saved, 0.5)
    one.run(1.0, 0.1)

    assert one["impact_time"] == pytest.approx(0.9399211769, rel=1e-9)


def forged(saved, changes):
    """A pythonfmu state with other bytes at places counted from behind, and a right checksum."""
    body = bytearray(saved[:-4])
    for place, packed in changes.items():
        body[place : place + len(packed)] = packed
    return bytes(body) + struct.pack("<I", zlib.crc32(bytes(body)))


def test_forged_states_are_refused_and_nothing_changes(instance):
    one = instance().begin()
    one.run(0.5, 0.1)
    saved = one.save_bytes()
    model = models.load("ratchet").MODEL
    words = sum(math.prod(shape_of(f, sizes_of(block(model)))) for f in FIELDS if f.section == "state")
    first = len(saved) - 4 - 8 * words
    cases = [(what, {first + 8 * place: struct.pack("<Q", bits)}) for what, place, bits in forged_words(model)]
    cases += [(f"phase {phase}", {24: struct.pack("<I", phase)}) for phase in (4, 2**31)]
    cases += [(f"{count} parameters", {28: struct.pack("<I", count)}) for count in (0, 2**31)]
    cases += [("start time", {44: struct.pack("<d", 1e300)}), ("no experiment", {44: struct.pack("<d", math.nan)})]
    cases += [("first parameter", {68: struct.pack("<d", value)}) for value in (math.nan, -1e300)]
    assert len(cases) > 60
    for what, changes in cases:
        said = len(one.log)
        with pytest.raises(FMICallException):
            one.restore_bytes(forged(saved, changes), 0.5)
        assert any("saved state" in message.text for message in one.log[said:]), what
        assert one.save_bytes() == saved, what
    one.run(1.0, 0.1)

    assert one["impact_time"] == pytest.approx(0.9399211769, rel=1e-9)
