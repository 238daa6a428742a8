"""In which order parts depend on each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence


def dependency_order(nodes: Sequence[str], edges: Iterable[tuple[str, str]]) -> tuple[list[str], list[list[str]]]:
    """Nodes such that each comes behind those that it follows, but in cycles, and the cycles.

    By strongly connected components (R. Tarjan, SIAM J. Comput. 1 (1972)); within a cycle, and among nodes that do not
    depend on each other, the given order stays.

    Args:
        nodes: all of them.
        edges: pairs (from, to): `to` follows `from`.
    """
    pairs = set(edges)
    follows = {node: [other for other in nodes if (other, node) in pairs] for node in nodes}
    groups = _Groups(follows).found
    order = [node for group in groups for node in sorted(group, key=list(nodes).index)]
    cycles = [sorted(g, key=list(nodes).index) for g in groups if len(g) > 1 or (g[0], g[0]) in pairs]
    return order, cycles


class _Groups:
    """Strongly connected components; each comes behind those that it follows."""

    def __init__(self, follows: Mapping[str, Sequence[str]]) -> None:
        self.found: list[list[str]] = []
        self._follows = follows
        self._number: dict[str, int] = {}
        self._lowest: dict[str, int] = {}
        self._stack: list[str] = []
        for node in follows:
            if node not in self._number:
                self._visit(node)

    def _visit(self, node: str) -> None:
        self._number[node] = self._lowest[node] = len(self._number)
        self._stack.append(node)
        for other in self._follows[node]:
            if other not in self._number:
                self._visit(other)
                self._lowest[node] = min(self._lowest[node], self._lowest[other])
            elif other in self._stack:
                self._lowest[node] = min(self._lowest[node], self._number[other])
        if self._lowest[node] == self._number[node]:
            place = self._stack.index(node)
            self.found.append(self._stack[place:])
            del self._stack[place:]
