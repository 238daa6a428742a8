"""A tooth as a plate of finite elements (scikit-fem), clamped at its root: an oracle."""

import numpy as np
from skfem import Basis, BilinearForm, ElementQuad2, ElementVector, FacetBasis, LinearForm, MeshQuad, condense, solve
from skfem.helpers import ddot, eye, sym_grad, trace


class PlaneTooth:
    """Plane stress, unit face width; x along the centre line from the root, y across it."""

    def __init__(self, length, root, tip, young, poisson, x, eta):
        """Straight flanks, `root` and `tip` apart; grid lines at `x` along the tooth and `eta`, -1 to 1, across it."""
        mesh = MeshQuad.init_tensor(np.asarray(x), np.asarray(eta))

        def flank(place):
            return 0.5 * (root + (tip - root) * place / length)

        mesh = MeshQuad(np.stack([mesh.p[0], mesh.p[1] * flank(mesh.p[0])]), mesh.t)
        self.mesh = mesh.with_boundaries(
            {
                "root": lambda m: m[0] < 1e-9 * length,
                "end": lambda m: m[0] > length * (1 - 1e-9),
                "flank": lambda m: m[1] > flank(m[0]) - 1e-6 * root,
            }
        )
        self.element = ElementVector(ElementQuad2())
        self.basis = Basis(self.mesh, self.element, intorder=4)
        lame, shear = young * poisson / (1 - poisson**2), young / (2 * (1 + poisson))

        @BilinearForm
        def stiffness(u, v, w):
            strain = sym_grad(u)
            return ddot(lame * eye(trace(strain), 2) + 2 * shear * strain, sym_grad(v))

        self.stiffness = stiffness.assemble(self.basis)

    def forces(self, boundary, traction):
        """Nodal forces of a `traction(x, y)`, which gives its two components."""

        @LinearForm
        def load(v, w):
            p = traction(w.x[0], w.x[1])
            return p[0] * v[0] + p[1] * v[1]

        return load.assemble(FacetBasis(self.mesh, self.element, facets=self.mesh.boundaries[boundary], intorder=8))

    def displacements(self, forces):
        """Nodal displacements by nodal forces."""
        return solve(*condense(self.stiffness, forces, D=self.basis.get_dofs("root")))

    def at(self, displacements, x, y):
        """The two components of the displacement at the node next to a place."""
        node = np.argmin(np.hypot(self.mesh.p[0] - x, self.mesh.p[1] - y))
        return displacements[self.basis.nodal_dofs[:, node]]
