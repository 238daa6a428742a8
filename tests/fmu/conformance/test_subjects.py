"""The conformance tests run on every ready-made mechanism."""

import models
from tests.fmu.conformance.conftest import SUBJECTS


def test_every_model_is_a_subject():
    assert set(SUBJECTS) == set(models.available())
