"""Islands: rows that share bodies, or are joined by others that do; the ground joins nothing."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import LinearSystem
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small


@jit
def find_islands(block: Array, count: int) -> int:
    """Sort the first `count` rows of D by islands, in the order of their first rows; return how many these are.

    Writes where each island begins among the sorted rows, how many columns its bodies have, and the columns of each
    body in its island.
    """
    keep_apart()
    system = LinearSystem(block)
    ground = Sizes(block).bodies
    body = system.scaled_body
    for b in range(ground + 1):
        system.leader[b] = b
        system.island_of[b] = codes.NONE
    for r in range(count):
        if body[r, 0] != ground and body[r, 1] != ground:
            one, other = leader_of(system, body[r, 0]), leader_of(system, body[r, 1])
            system.leader[max(one, other)] = min(one, other)
    islands = 0
    for r in range(count):
        leader = leader_of(system, _first_body(system, r, ground))
        if system.island_of[leader] == codes.NONE:
            system.island_of[leader] = islands
            system.island_range[islands, 1] = 0
            system.island_width[islands] = 0
            islands += 1
        system.island_range[system.island_of[leader], 1] += 1
    system.islands[0] = islands
    begin = 0
    for island in range(islands):
        size = system.island_range[island, 1]
        system.island_range[island, 0] = begin
        system.island_range[island, 1] = begin  # up to where its rows are there
        begin += size
    for r in range(count):
        island = system.island_of[leader_of(system, _first_body(system, r, ground))]
        spot = system.island_range[island, 1]
        system.island_row[spot] = r
        system.island_spot[r] = spot
        system.island_range[island, 1] += 1
    for b in range(ground):
        island = system.island_of[leader_of(system, b)]
        if island != codes.NONE:
            system.island_column[b] = system.island_width[island]
            system.island_width[island] += 3
    return islands


@jit
def _first_body(system: LinearSystem, row: int, ground: int) -> int:
    """The first body of a row that is not the ground; the ground where it has no other."""
    first: int = system.scaled_body[row, 0]
    if first == ground:
        first = system.scaled_body[row, 1]
    return first


@jit
def leader_of(system: LinearSystem, body: int) -> int:
    """The body that stands for all that are joined so far; the way there is halved."""
    keep_small()
    leader = system.leader
    while leader[body] != body:
        leader[body] = leader[leader[body]]
        body = leader[body]
    return body
