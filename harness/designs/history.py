"""The designs of a search, in the order in which it asks for them; what is there already is not run again."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from ..description import Value
from ..errors import UsageError
from .store import Store
from .task import Design, Result
from .workers import Crew

#: A search that asks so often in a row for what it has had will not come to anything new.
_MOST_IDLE = 50

#: Of a design, in the order of the variables.
_Values = tuple[Value, ...]


class EnoughError(Exception):
    """The search has had all designs that it may have."""


class InterruptedSearchError(Exception):
    """Somebody wants it to end; what there is, is kept."""


class History:
    """All designs that a search has asked for.

    A search that is the same each time asks for the same designs in the same order. So one that was interrupted begins
    anew and is answered from the disk until it comes to what is not there.

    Attributes:
        designs: asked for so far, in this run of the command.
        results: theirs.
        limit: how many may be asked for.
        earlier: how many were on the disk when it began.
    """

    def __init__(
        self,
        store: Store,
        crew: Crew,
        limit: int,
        stop_requested: Callable[[], bool],
        on_progress: Callable[[History], None],
    ) -> None:
        """Begin, with what a store has of earlier runs."""
        self.designs: list[Design] = []
        self.results: list[Result] = []
        self._seen: dict[_Values, Result] = {}
        self.allow(limit)
        self._kept = store.pairs()
        self.earlier = len(self._kept)
        self._store, self._crew = store, crew
        self._stop_requested, self._on_progress = stop_requested, on_progress

    def allow(self, limit: int) -> None:
        """Begin a part of the search, which may go on to so many designs in all."""
        self.limit = limit
        self._idle = 0

    def results_of(self, candidates: Sequence[Mapping[str, Value]]) -> list[Result]:
        """Results of designs, in their order; those behind the first that exceeds the limit are left out.

        Values that were asked for before are answered from memory and count no second time.

        Raises:
            EnoughError: there is no room for a single one, or the search has nothing new to ask for.
            InterruptedSearchError: somebody wants it to end.
            UsageError: what is kept belongs to another search, or the disk refuses.
        """
        new: dict[_Values, Design] = {}
        wanted: list[_Values] = []
        for candidate in candidates:
            values = tuple(candidate.values())
            if values not in self._seen and values not in new:
                if len(self.designs) + len(new) == self.limit:
                    break
                new[values] = Design(len(self.designs) + len(new) + 1, dict(candidate))
            wanted.append(values)
        self._idle = 0 if new else self._idle + 1
        if not wanted or self._idle > _MOST_IDLE:
            raise EnoughError
        self._run(list(new.values()))
        return [self._seen[values] for values in wanted]

    def _run(self, designs: Sequence[Design]) -> None:
        """Find the results of designs, on the disk or by running them."""
        found = {design.number: self._known(design) for design in designs if design.number in self._kept}
        missing = [design for design in designs if design.number not in found]
        for pairs in self._crew(missing, self._stop_requested) if missing else ():
            self._store.append(pairs)
            found |= {design.number: result for design, result in pairs}
        if len(found) < len(designs):
            raise InterruptedSearchError
        for design in designs:
            self.designs.append(design)
            self.results.append(found[design.number])
            self._seen[tuple(design.values.values())] = found[design.number]
        self._on_progress(self)

    def _known(self, design: Design) -> Result:
        values, result = self._kept[design.number]
        if values != design.values:
            raise UsageError(
                f"Design {design.number} in '{self._store.folder}' has other values than the search asks for now: it "
                f"was found with other versions of scipy or optuna. Choose another folder with -o."
            )
        return result
