"""The designs of a search, in the order in which it asks for them; what is there already is not run again."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from ..description import Value
from ..errors import UsageError
from .store import Store
from .task import Design, Result
from .workers import Crew


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
        self.limit = limit
        self._kept = store.pairs()
        self.earlier = len(self._kept)
        self._store, self._crew = store, crew
        self._stop_requested, self._on_progress = stop_requested, on_progress

    def results_of(self, candidates: Sequence[Mapping[str, Value]]) -> list[Result]:
        """Results of designs, in their order; those that exceed the limit are left out.

        Raises:
            EnoughError: there is no room for a single one.
            InterruptedSearchError: somebody wants it to end.
            UsageError: what is kept belongs to another search, or the disk refuses.
        """
        first = len(self.designs) + 1
        room = self.limit - len(self.designs)
        if room <= 0:
            raise EnoughError
        designs = [Design(first + k, dict(values)) for k, values in enumerate(candidates[:room])]
        found = {design.number: self._known(design) for design in designs if design.number in self._kept}
        missing = [design for design in designs if design.number not in found]
        if missing:
            for pairs in self._crew(missing, self._stop_requested):
                self._store.append(pairs)
                found |= {design.number: result for design, result in pairs}
        if len(found) < len(designs):
            raise InterruptedSearchError
        results = [found[design.number] for design in designs]
        self.designs += designs
        self.results += results
        self._on_progress(self)
        return results

    def _known(self, design: Design) -> Result:
        values, result = self._kept[design.number]
        if values != design.values:
            raise UsageError(
                f"Design {design.number} in '{self._store.folder}' has other values than the search asks for now: it "
                f"was found with other versions of scipy or optuna. Choose another folder with -o."
            )
        return result
