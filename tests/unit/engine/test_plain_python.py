import numpy as np
import pytest
from own_process import run_script
from ratchet_numbers import ratchet_numbers

import models


def test_the_engine_without_compilation_gives_the_same_numbers():
    plain = np.array(run_script("ratchet_numbers.py", NUMBA_DISABLE_JIT="1"))
    compiled = np.array(ratchet_numbers())
    np.testing.assert_allclose(plain, compiled, rtol=1e-13, atol=1e-16)


@pytest.mark.slow
@pytest.mark.parametrize("name", models.available())
def test_no_index_counts_from_the_end(name):
    (told,) = run_script("negative_indices.py", name, NUMBA_DISABLE_JIT="1").values()
    co_simulation, model_exchange, uses = told
    assert not any(co_simulation + model_exchange)
    assert uses > 10_000
