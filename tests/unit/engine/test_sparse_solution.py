"""The sparse solution of rows of two bodies each against dense ones, for all structures that mechanisms have."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.dynamics.linear_solve import solve, write_matrix
from mechanism_fmu.engine.dynamics.minimum_norm import expand, orthogonalise, solve_orthogonalised
from mechanism_fmu.engine.dynamics.sparse import factorise_sparse, solve_sparse
from mechanism_fmu.model.elimination import elimination_order
from mechanism_fmu.tables.layout import allocate, field_of
from mechanism_fmu.tables.motion import LinearSystem
from mechanism_fmu.tables.sizes import GIVEN_SIZES


@entry
def _solve_in(block, count, width, factor):
    write_matrix(block, count, factor)
    if factorise_sparse(block, count) and solve_sparse(block, count, width):
        return 0
    expand(block, count, width)
    orthogonalise(block, count, width)
    solve_orthogonalised(block, count, width)
    return 1


@entry
def _solve_in_either_way(block, count, width, factor):
    write_matrix(block, count, factor)
    solve(block, count, width)
    return LinearSystem(block).by_pivots[0]


class System:
    """A block with `bodies`, and rows of pairs of them; the number behind the last body is the ground."""

    def __init__(self, bodies, pairs):
        self.bodies, self.pairs = bodies, np.array(pairs)
        self.block = allocate(dict.fromkeys(GIVEN_SIZES, 0) | {"bodies": bodies, "joint_rows": len(pairs)})
        field_of(self.block, "body_rank")[:] = elimination_order(range(bodies), [tuple(pair) for pair in pairs])

    def dense(self, entries):
        """Rows of all columns from those of two bodies each."""
        D = np.zeros((len(entries), 3 * self.bodies + 3))
        for row, (one, other), values in zip(D, self.pairs, entries, strict=False):
            row[3 * one : 3 * one + 3] = values[:3]
            row[3 * other : 3 * other + 3] = values[3:]
        return D[:, :-3]

    def solve(self, entries, b, by=_solve_in):
        """z, multipliers, and whether pivots were needed."""
        count = len(entries)
        for name in ("jacobian", "solution", "multiplier", "dual", "coefficient", "spread", "lower", "pivot"):
            field_of(self.block, name)[...] = np.nan  # what a motion that failed has left behind
        for r, ((one, other), values) in enumerate(zip(self.pairs[:count], entries, strict=True)):
            field_of(self.block, "row_body")[r] = one, other
            field_of(self.block, "jacobian")[r, 3 * one : 3 * one + 3] = values[:3]
            field_of(self.block, "jacobian")[r, 3 * other : 3 * other + 3] = values[3:]
        field_of(self.block, "right_side")[:count] = b
        factor = np.r_[np.ones(3 * self.bodies), np.zeros(3)]
        by_pivots = by(self.block, count, 3 * self.bodies, factor)
        solution, multiplier = (field_of(self.block, name) for name in ("solution", "multiplier"))
        return solution[: 3 * self.bodies].copy(), multiplier[:count].copy(), by_pivots


def chain(n):
    return n, [pair for k in range(n) for pair in 2 * [(k, k - 1 if k else n)]]


def loops(n):
    """N-four-bar: rods between neighbours of a row of rockers, each on the ground."""
    rockers, rods = range(n + 1), range(n + 1, 2 * n + 1)
    pairs = [pair for k in rockers for pair in 2 * [(k, 2 * n + 1)]]
    pairs += [pair for k, rod in enumerate(rods) for end in (k, k + 1) for pair in 2 * [(rod, end)]]
    return 2 * n + 1, pairs


def blocks(n):
    """Blocks that stand on the ground on two contacts each, and push against the one beside them."""
    return n, [pair for k in range(n) for pair in (*2 * [(k, n)], *[(k, k - 1)] * (k > 0))]


def planets(n, *, ring=False):
    """A carrier with planets, which mesh with a sun; and with a ring on the ground, more often than needed."""
    return n + 2, [
        (n, n + 2),
        (n, n + 2),
        (n + 1, n + 2),
        (n + 1, n + 2),
        *((k, n) for k in range(n) for _ in "xy"),
        *((k, n + 1) for k in range(n)),
        *((k, n + 2) for k in range(n) if ring),
    ]


STRUCTURES = {
    "chain": chain(50),
    "loops": loops(20),
    "100 blocks": blocks(100),
    "planets": planets(20),
    "one": (1, [(0, 1)]),
}


def rows_of(pairs, random, *, arms_apart=False):
    """Of two rows of the same pair of bodies in turn: those of a pin; or of two contacts with the same normal."""
    rows, before = [], None
    for pair in pairs:
        second = pair == before
        before = None if second else pair
        if not second:
            angle, arms = random.uniform(0.0, math.pi), random.uniform(-1.0, 1.0, 4)
        elif arms_apart:
            arms = arms + 2.0
        else:
            angle += math.pi / 2
        x, y = math.cos(angle), math.sin(angle)
        rows.append([x, y, arms[0] * y - arms[1] * x, -x, -y, arms[3] * x - arms[2] * y])
    return np.array(rows)


@pytest.mark.parametrize("name", STRUCTURES)
def test_agrees_with_the_dense_solution(name):
    bodies, pairs = STRUCTURES[name]
    system = System(bodies, pairs)
    random = np.random.default_rng(1)
    for _ in range(5):
        entries = rows_of(pairs, random, arms_apart=name == "100 blocks")
        D, b = system.dense(entries), random.standard_normal(len(entries))
        z, multiplier, by_pivots = system.solve(entries, b)
        assert not by_pivots
        exact = np.linalg.lstsq(D, b)[0]
        assert np.abs(z - exact).max() <= 1e-15 * np.linalg.cond(D) * len(b) * np.abs(exact).max()
        assert np.abs(D @ z - b).max() <= 1e-13 * np.abs(z).max()
        assert np.abs(D.T @ multiplier - z).max() <= 1e-13 * np.abs(multiplier).max()


@st.composite
def structures(draw):
    bodies = draw(st.integers(1, 8))
    pairs = list(itertools.combinations(range(bodies + 1), 2))
    return bodies, draw(st.lists(st.sampled_from(pairs), min_size=1, max_size=2 * bodies))


@settings(deadline=None, max_examples=100)
@given(structures(), st.integers(0, 2**32 - 1), st.booleans())
def test_any_rows_give_the_minimum_norm(structure, seed, repeats):
    """Of rows that depend on each other, too, after which the same block solves others."""
    system = System(structure[0], [*structure[1], *structure[1][:1]])
    random = np.random.default_rng(seed)
    entries = random.standard_normal((len(system.pairs), 6))
    if repeats:
        entries[-1] = -2.0 * entries[0]
    for some in (entries, entries[:1], entries):
        D, b = system.dense(some), random.standard_normal(len(some))
        z, multiplier, _ = system.solve(some, b)
        inverse = np.linalg.pinv(D, rcond=1e-10)
        size = np.linalg.norm(inverse)
        assert np.abs(z - inverse @ b).max() <= 1e-13 * (1 + np.linalg.norm(D) * size) * size * np.linalg.norm(b)
        assert np.abs(D.T @ multiplier - z).max() <= 1e-12 * (1 + size) * np.abs(z).max()


def beside(one, other):
    """Both structures in one, which have nothing but the ground in common."""
    first, second = one[0], other[0]
    ground = first + second
    pairs = [tuple(ground if b == first else b for b in pair) for pair in one[1]]
    return ground, pairs + [tuple(ground if b == second else b + first for b in pair) for pair in other[1]]


def test_what_carries_much_does_not_spoil_what_carries_little():
    """Where rows are so nearly parallel that corrections are needed, each row is right by its own terms."""
    bodies, pairs = beside(chain(20), chain(20))
    system, count = System(bodies, pairs), len(pairs) // 2
    random = np.random.default_rng(3)
    entries, b = rows_of(pairs, random), random.standard_normal(2 * count)
    entries[1::2] = entries[::2] + 1e-3 * entries[1::2]
    b[:count] *= 1e9
    z, _, by_pivots = system.solve(entries, b)
    assert not by_pivots
    D = system.dense(entries)
    assert (np.abs(D @ z - b) <= 2e-13 * (np.abs(D) @ np.abs(z) + np.abs(b))).all()


REDUNDANT = {
    "mesh": planets(20, ring=True),
    "two meshes": beside(planets(6, ring=True), planets(8, ring=True)),
    "a mesh beside a chain": beside(planets(8, ring=True), chain(10)),
    "stacked blocks": (5, [pair for k in range(5) for pair in 5 * [(k, k - 1 if k else 5)]]),
    "blocks apart": (9, [pair for k in range(9) for pair in 5 * [(k, 9)]]),
}


@pytest.mark.parametrize("name", REDUNDANT)
def test_redundant_rows_are_solved_island_by_island(name):
    """Rows on a floor or of a mesh that repeat what others say: minimum norm, island by island."""
    bodies, pairs = REDUNDANT[name]
    system = System(bodies, pairs)
    random = np.random.default_rng(2)
    for _ in range(5):
        entries = random.standard_normal((len(pairs), 6))
        D = system.dense(entries)
        b = D @ random.standard_normal(3 * bodies)
        z, multiplier, by_pivots = system.solve(entries, b, _solve_in_either_way)
        assert by_pivots
        values = np.linalg.svd(D, compute_uv=False)
        rank = int((values > 1e-10 * values[0]).sum())
        assert field_of(system.block, "rank")[0] == rank < len(pairs)
        condition = values[0] / values[rank - 1]
        inverse = np.linalg.pinv(D, rcond=1e-10)
        exact, forces = inverse @ b, inverse.T @ (inverse @ b)
        assert np.abs(z - exact).max() <= 1e-15 * condition * len(b) * np.abs(exact).max()
        assert np.abs(multiplier - forces).max() <= 1e-15 * condition**2 * len(b) * np.abs(forces).max()


def test_entries_are_few_where_a_good_order_exists():
    for name, most in (("chain", 2.5), ("loops", 4.0), ("100 blocks", 6.0)):
        system = System(*STRUCTURES[name])
        count = len(system.pairs)
        system.solve(np.random.default_rng(0).standard_normal((count, 6)), np.ones(count))
        assert field_of(system.block, "fill_count").sum() <= most * count, name


def test_few_rows_are_solved_by_pivots_and_many_are_not_unless_they_depend():
    bodies, pairs = STRUCTURES["chain"]
    system = System(bodies, [*pairs, pairs[-1]])
    entries = rows_of(pairs, np.random.default_rng(1))
    entries = np.vstack([entries, entries[-1]])
    expected = {10: 1, len(pairs): 0, len(pairs) + 1: 1}
    found = {n: system.solve(entries[:n], np.ones(n), _solve_in_either_way)[2] for n in expected}
    assert found == expected
