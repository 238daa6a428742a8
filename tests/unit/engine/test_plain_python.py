import numpy as np
from own_process import run_script
from ratchet_numbers import ratchet_numbers


def test_the_engine_without_compilation_gives_the_same_numbers():
    plain = np.array(run_script("ratchet_numbers.py", NUMBA_DISABLE_JIT="1"))
    compiled = np.array(ratchet_numbers())
    np.testing.assert_allclose(plain, compiled, rtol=1e-13, atol=1e-16)
