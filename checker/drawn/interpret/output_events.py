"""Events of a chart to other blocks: a signal for each, which changes where the event occurs, or a call."""

from collections.abc import Callable, Iterator

from rovercheck.checker.drawn.calls import FUNCTION_CALL
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
        self.call: Callable[[str], None] | None = None
        """Executes what a function call calls, by the name of the event; none before the first step."""

    def __contains__(self, name: str) -> bool:
        return name in self._events

    def signals(self) -> Iterator[Scalar]:
        """The signals, in the order of their ports."""
        return iter(self._signals.values())

    def send(self, name: str) -> None:
        """The signal of an event changes at the end of this step, or of a later one; a function call is done.

        Raises ``DrawnFault`` where too many wait, and for a function call before the first step.
        """
        if self._events[name].trigger == FUNCTION_CALL:
            if self.call is None:
                raise DrawnFault(f"{name} is a function call, sent before the first step: send it in a step")
            self.call(name)
            return
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
