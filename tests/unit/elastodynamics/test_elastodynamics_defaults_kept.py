"""Defaults of what the package offers, beside what they were: see tests/kept.py."""

from mechanism_fmu import elastodynamics
from tests.kept import defaults_of, plain_data, same_as_kept


def test_kept_defaults() -> None:
    same_as_kept("defaults_elastodynamics.json", plain_data(defaults_of(elastodynamics)))
