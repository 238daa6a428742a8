"""Every way in which an engine call can end has a number of its own and its advice."""

from mechanism_fmu.engine import status

CODES = {name: value for name, value in vars(status).items() if name.isupper() and isinstance(value, int)}


def test_the_numbers_are_counted_from_zero():
    assert sorted(CODES.values()) == list(range(len(CODES)))


def test_all_but_ok_have_advice_in_whole_sentences():
    assert set(status.ADVICE) == set(CODES.values()) - {status.OK}
    assert all(text[0].isupper() and text.endswith(".") for text in status.ADVICE.values())
