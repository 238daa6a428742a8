"""Beam modes against finite elements of another library: cubic Hermite elements of scikit-fem.

Their frequencies approach those of the beam from above like h^4; the Rayleigh–Ritz modes have long converged.
"""

import numpy as np
import pytest
from scipy.linalg import eigh
from skfem import Basis, BilinearForm, ElementLineHermite, MeshLine
from skfem.helpers import dd, ddot

from mechanism_fmu.stress import STEEL, End, TrapezoidTooth, WedgeTooth, natural_modes

ORDER = 4
COUNT = 3


def element_frequencies(beam, ends, elements):
    """Natural frequencies [rad/s] from `elements` equal elements; deflection and slope are held at nodes."""
    basis = Basis(MeshLine(np.linspace(0.0, 1.0, elements + 1)), ElementLineHermite(), intorder=10)

    @BilinearForm
    def stiffness(u, v, w):
        return STEEL.youngs_modulus * beam.second_moment(w.x[0] * beam.length) / beam.length**3 * ddot(dd(u), dd(v))

    @BilinearForm
    def mass(u, v, w):
        return STEEL.density * beam.area(w.x[0] * beam.length) * beam.length * u * v

    held = [
        basis.get_dofs(lambda x, place=place: x[0] == place).all(["u", "u_x"][order])
        for place, end in zip((0.0, 1.0), ends, strict=True)
        for order in end.vanishing
    ]
    free = basis.complement_dofs(np.concatenate(held))
    k, m = (form.assemble(basis)[free][:, free].toarray() for form in (stiffness, mass))
    return np.sqrt(eigh(k, m, eigvals_only=True)[:COUNT])


@pytest.mark.parametrize(
    ("beam", "ends"),
    [
        (WedgeTooth(0.033, 0.61), (End.CLAMPED, End.FREE)),
        (TrapezoidTooth(0.05, 0.03, 0.01), (End.CLAMPED, End.FREE)),
        (TrapezoidTooth(0.05, 0.03, 0.01), (End.PINNED, End.CLAMPED)),
        (TrapezoidTooth(0.05, 0.03, 0.01), (End.PINNED, End.GUIDED)),
    ],
    ids=["wedge", "cantilever", "pinned-clamped", "pinned-guided"],
)
def test_elements_converge_to_the_ritz_modes_with_their_own_order(beam, ends):
    ritz = np.array([mode.natural_frequency for mode in natural_modes(beam, STEEL, 20, root=ends[0], tip=ends[1])])
    errors = [element_frequencies(beam, ends, n) / ritz[:COUNT] - 1 for n in (16, 32)]
    slopes = np.log2(errors[0] / errors[1])
    assert np.all(errors[1] > 0)
    np.testing.assert_allclose(slopes, ORDER, atol=0.15)
    # What is left after one step of Richardson's extrapolation.
    extrapolated = errors[1] - (errors[0] - errors[1]) / (2**ORDER - 1)
    assert np.all(np.abs(extrapolated) < 0.1 * errors[1])
