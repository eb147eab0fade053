"""Events of a chart to other blocks: a signal for each, which changes where the event occurs."""

from collections.abc import Iterator

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.values import FALSE, Scalar, logical
from rovercheck.checker.drawn.parsed import ParsedChart, output_events

MOST_WAITING = 255
"""Times that an event may wait, as each step gives one of them."""


class OutputEvents:
    """Those of one chart with their signals."""

    def __init__(self, chart: ParsedChart) -> None:
        self._events = {one.name: one for one in output_events(chart.root)}
        self._signals = dict.fromkeys(self._events, FALSE)
        self._waiting = dict.fromkeys(self._events, 0)

    def __contains__(self, name: str) -> bool:
        return name in self._events

    def signals(self) -> Iterator[Scalar]:
        """The signals, in the order of their ports."""
        return iter(self._signals.values())

    def send(self, name: str) -> None:
        """The signal of an event changes at the end of this step, or of a later one.

        Raises ``DrawnFault`` for a function call, and where too many wait.
        """
        if self._events[name].trigger == "function call":
            raise DrawnFault(
                f"{name} is a function call of other blocks, which is not known here: make its trigger "
                "Either Edge, and that of the blocks either"
            )
        if self._waiting[name] == MOST_WAITING:
            raise DrawnFault(f"{name} is sent while {MOST_WAITING} of it wait: each step gives one")
        self._waiting[name] += 1

    def end_step(self) -> None:
        """Each event that waits occurs once."""
        for name, waiting in self._waiting.items():
            if waiting:
                self._signals[name] = logical(not self._signals[name].truth)
                self._waiting[name] -= 1


__all__ = ["OutputEvents"]
