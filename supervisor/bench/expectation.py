"""What a scenario expects of its run: a signal with a value at a time, within a time or for a time."""

from dataclasses import dataclass

from rovercheck.supervisor.bench.errors import ScenarioError
from rovercheck.supervisor.bench.quantities import shown, time_us
from rovercheck.supervisor.bench.signals import Scalar, parse_value, pick_signal
from rovercheck.supervisor.bench.table import Table, number

KEYS = ("at", "within", "during", "signal", "value", "min", "max")


@dataclass(frozen=True)
class Expectation:
    """One ``[[expect]]``.

    The signal has ``value``, or lies from ``least`` to ``most``: at ``at_us``; with ``within_us`` at some
    time from then on, at most so much later; with ``during_us`` all the time from then on for so long.
    """

    path: str
    signal: str
    at_us: int
    value: Scalar | None = None
    least: float | None = None
    most: float | None = None
    within_us: int = 0
    during_us: int = 0

    @property
    def end_us(self) -> int:
        return self.at_us + self.within_us + self.during_us

    def holds(self, value: Scalar) -> bool:
        """Whether a value of the signal is as expected."""
        if self.value is not None:
            return value == self.value
        above = self.least is None or value >= self.least
        return above and (self.most is None or value <= self.most)


def parse_expectation(table: Table, duration_us: int) -> Expectation:
    """The expectation that a table writes; ScenarioError if it has no meaning."""
    at_us = time_us(table.at("at"), table.need("at", '"2.5 s"'))
    name = table.need("signal", '"board1.current_action"')
    signal = pick_signal(table.at("signal"), name)
    within_us, during_us = table.time_us("within"), table.time_us("during")
    value, least, most = (table.take(key) for key in ("value", "min", "max"))
    table.end(KEYS)
    if within_us and during_us:
        raise ScenarioError(table.path, "within and during exclude each other; write one of them.")
    if (value is None) == (least is None and most is None):
        raise ScenarioError(table.path, "write value = ..., or a number as min = ..., max = ... or both.")
    expectation = Expectation(
        path=table.path,
        signal=name,
        at_us=at_us,
        value=None if value is None else parse_value(table.at("value"), signal, value),
        least=None if least is None else _bound(table.at("min"), signal.is_number, least),
        most=None if most is None else _bound(table.at("max"), signal.is_number, most),
        within_us=within_us,
        during_us=during_us,
    )
    if expectation.end_us > duration_us:
        raise ScenarioError(
            table.at("at"),
            f"{shown(expectation.end_us)} is after the run, which lasts {shown(duration_us)}; "
            "look earlier or let the run last longer.",
        )
    return expectation


def _bound(path: str, is_number: bool, written: object) -> float:
    if not is_number:
        raise ScenarioError(path, "the signal is no number; write value = ... instead.")
    return number(path, written)
