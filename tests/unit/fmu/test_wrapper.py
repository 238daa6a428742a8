import sys

import pytest

from mechanism_fmu.fmu.instance.protocol import PassedTexts, fmi_call, survive_release


class Slave:
    """What the wrapper holds of a slave: its class, itself and its log queue."""

    def __init__(self):
        self.log_queue = []
        self.reported = []

    def report(self, error):
        self.reported.append(error)

    @fmi_call
    def halve(self, number):
        """Half of an even number."""
        if number % 2:
            raise ValueError(f"{number} is odd")
        return number // 2


def references(slave):
    return [sys.getrefcount(one) for one in (type(slave), slave, slave.log_queue)]


def test_a_call_that_works_is_passed_through():
    slave = Slave()
    before = references(slave)
    assert slave.halve(6) == 3
    assert references(slave) == before
    assert slave.reported == []


def test_a_call_that_fails_is_reported_and_fails():
    slave = Slave()
    with pytest.raises(ValueError, match="7 is odd") as caught:
        slave.halve(7)
    assert slave.reported == [caught.value]


def test_each_failure_adds_the_references_that_the_wrapper_releases():
    slave = Slave()
    before = references(slave)
    for _ in range(5):
        with pytest.raises(ValueError, match="odd"):
            slave.halve(1)
        slave.reported.clear()
    assert references(slave) == [count + 5 for count in before]


def test_no_reference_is_added_for_what_ends_the_process():
    class Stopped(Slave):
        @fmi_call
        def stop(self):
            raise KeyboardInterrupt

    slave = Stopped()
    before = references(slave)
    with pytest.raises(KeyboardInterrupt):
        slave.stop()
    assert references(slave) == before


def test_a_decorated_method_keeps_its_name_and_words():
    assert Slave.halve.__name__ == "halve"
    assert Slave.halve.__doc__ == "Half of an even number."


def test_references_are_added_one_by_one():
    one, two = object(), []
    before = sys.getrefcount(one), sys.getrefcount(two)
    survive_release(one, two, two)
    assert (sys.getrefcount(one), sys.getrefcount(two)) == (before[0] + 1, before[1] + 2)


def test_texts_that_the_wrapper_holds_are_released_and_others_are_not():
    """The wrapper's reference is one that nobody gives back."""
    passed = PassedTexts()
    passed.add("".join(["held by ", "nobody else"]))
    held = "".join(["held by ", "the wrapper"])
    survive_release(held)  # what the wrapper does: one reference more
    passed.add(held)
    before = sys.getrefcount(held)
    passed.release()
    assert sys.getrefcount(held) == before - 2  # the wrapper's, and that of `passed`
    assert held == "held by the wrapper"
