"""Real variables of a component in another process."""

from __future__ import annotations

from collections.abc import MutableSequence

from .round_trips import RoundTrips


class RemoteReals:
    """Some of them, bound once (a `machine.component.Reals`)."""

    def __init__(self, trips: RoundTrips, names: tuple[str, ...]) -> None:
        self.values: MutableSequence[float] = [0.0] * len(names)
        self._trips, self._names = trips, names
        self._number = 0

    def read(self) -> None:
        """Fill `values` with those of now."""
        self.values[:] = self._trips.ask("read", self._names)

    def read_slopes(self) -> bool:
        """Fill `values` with derivatives of outputs [unit/s]; False where the component does not tell some of them."""
        told, slopes = self._trips.ask("read_slopes", self._names)
        self.values[:] = slopes
        return bool(told)

    def write(self) -> None:
        """Set the variables to `values`, before the next call."""
        if self._names:
            self._trips.order("write", self._bound(), list(self.values))
            self._trips.changed(self._names)

    def write_slopes(self) -> None:
        """Let inputs change by `values` [unit/s] in the next step."""
        if self._names:
            self._trips.order("write_slopes", self._bound(), list(self.values))
            self._trips.slopes_changed()

    def _bound(self) -> int:
        """By what the other side knows them; only those that are written need it."""
        if not self._number:
            self._number = self._trips.number()
            self._trips.order("bind", self._number, self._names)
        return self._number
