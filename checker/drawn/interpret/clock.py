"""Times of a chart: steps since a state was entered, how long conditions hold, what changed since the step
before.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction

from rovercheck.checker.drawn.calls import refuse_seconds
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.grammar.syntax import Applied, Expression, Name, parts
from rovercheck.checker.drawn.grammar.trees import expressions_of
from rovercheck.checker.drawn.interpret.evaluate import CallFrame, Evaluator
from rovercheck.checker.drawn.interpret.memory import datum_of
from rovercheck.checker.drawn.interpret.values import MatlabValue, Scalar, double, logical, scalar
from rovercheck.checker.drawn.parsed import JunctionNode, ParsedChart, StateNode, TransitionNode
from rovercheck.checker.drawn.stores import CHANGES_OF_STORES

UNITS = {"sec": Fraction(1), "msec": Fraction(1, 1000), "usec": Fraction(1, 10**6)}
LIMITS: dict[str, Callable[[Fraction, Fraction], bool]] = {
    "after": lambda count, limit: count >= limit,
    "before": lambda count, limit: count < limit,
    "at": lambda count, limit: count == limit,
    "every": lambda count, limit: count > 0 and limit > 0 and count % limit == 0,
}
DURATIONS = ("duration", "count")


class ChartClock:
    """The times of one chart with steps of so many seconds, as written."""

    def __init__(self, chart: ParsedChart, step: str) -> None:
        self._chart = chart
        self._step: Fraction | None = None
        with suppress(ValueError, ZeroDivisionError):  # as ``auto``
            self._step = Fraction(step.strip())
        self._ticks: dict[StateNode, int] = {}
        self._seen: dict[tuple[StateNode, str], int] = {}
        self._held: dict[tuple[int, StateNode], int] = {}
        # a section of two kinds has its texts twice
        self._operators = list({(id(one), node): (one, node) for one, node in _durations(chart)}.values())
        self._executed = 0

    def begin(self, active: Iterable[StateNode]) -> None:
        """A step begins: all active states have been so for one more."""
        self._executed += 1
        for node in active:
            self._ticks[node] = self._ticks.get(node, 0) + 1

    def end(self, active: set[StateNode], holds: Callable[[Expression, StateNode], bool]) -> None:
        """A step ends: conditions that hold now have done so for one more."""
        for operator, node in self._operators:
            if node in active:
                key = id(operator), node
                held = holds(operator.arguments[0], node)
                self._held[key] = self._held.get(key, 0) + 1 if held else 0

    def entered(self, node: StateNode) -> None:
        """A state is entered: its times begin."""
        self._ticks[node] = 0
        self._seen = {key: times for key, times in self._seen.items() if key[0] is not node}
        self._held = {key: steps for key, steps in self._held.items() if key[1] is not node}

    def saw(self, event: str, active: Iterable[StateNode]) -> None:
        """An event was sent while these states are active."""
        for node in active:
            self._seen[node, event] = self._seen.get((node, event), 0) + 1

    # --- words ---------------------------------------------------------------------------------------------

    def word(
        self, expression: Expression, frame: CallFrame, event: str, evaluator: Evaluator
    ) -> MatlabValue | None:
        """The value of a word of time or change; ``None`` if it is none."""
        match expression:
            case Applied(Name(name), (limit, unit)) if name in LIMITS:
                return self._limit(name, limit, unit, frame, event, evaluator)
            case Applied(Name("temporalCount" | "elapsed" as name), arguments):
                unit = arguments[0] if arguments else Name("sec")
                count = self._count(frame.node, unit)
                return double(count if _word(unit) not in UNITS else float(count * self._seconds(unit)))
            case Applied(Name("count"), (condition,)):
                return double(self._duration(expression, condition, frame, evaluator))
            case Applied(Name("duration"), (condition, *rest)):
                held = self._duration(expression, condition, frame, evaluator)
                return double(float(held * self._seconds(rest[0] if rest else Name("sec"))))
            case Applied(Name("hasChanged" | "hasChangedTo" | "hasChangedFrom" as name), (of, *values)):
                return self._changed(name, of, values, frame, evaluator)
            case Applied(Name("rising" | "falling" | "crossing" as name), (of,)):
                return self._edge(name, of, frame, evaluator)
        return None

    def _limit(
        self,
        name: str,
        limit: Expression,
        unit: Expression,
        frame: CallFrame,
        event: str,
        evaluator: Evaluator,
    ) -> MatlabValue:
        written = evaluator.value(limit, frame)
        value = Fraction(str(scalar(written).value))
        word = _word(unit)
        if word in UNITS:
            value = value / self._seconds(unit)
        if word in UNITS or word == "tick":
            return logical(LIMITS[name](Fraction(self._ticks.get(frame.node, 0)), value))
        return logical(event == word and LIMITS[name](Fraction(self._seen.get((frame.node, word), 0)), value))

    def _count(self, node: StateNode, unit: Expression) -> int:
        word = _word(unit)
        in_steps = word in UNITS or word == "tick"
        return self._ticks.get(node, 0) if in_steps else self._seen.get((node, word), 0)

    def _seconds(self, unit: Expression) -> Fraction:
        """A step in a unit of time."""
        if self._step is None:
            raise DrawnFault("the length of a step is not known, and a time in seconds is asked for")
        word = _word(unit)
        if word not in UNITS:
            raise DrawnFault(f"{word} is no unit of time: write sec, msec or usec")
        refuse_seconds(word, self._chart.root.events.values())
        return self._step / UNITS[word]

    def _duration(self, operator: Expression, condition: Expression, frame: CallFrame, by: Evaluator) -> int:
        """Steps for which a condition holds; once it is seen not to, they begin anew."""
        key = id(operator), frame.node
        if not by.truth(condition, frame):
            self._held[key] = 0
        return self._held.get(key, 0)

    def _changed(
        self, name: str, of: Expression, values: Sequence[Expression], frame: CallFrame, by: Evaluator
    ) -> MatlabValue:
        now, before = self._starts(of, frame, by)
        if before is None:
            return logical(False)
        wanted = [by.value(one, frame) for one in values]
        here = now != before
        if name == "hasChangedTo":
            here = here and _equal(now, wanted[0])
        elif name == "hasChangedFrom":
            here = here and _equal(before, wanted[0])
        return logical(here)

    def _edge(self, name: str, of: Expression, frame: CallFrame, by: Evaluator) -> MatlabValue:
        now, before = self._starts(of, frame, by)
        if before is None:
            return logical(False)
        one, other = scalar(before).value, scalar(now).value
        rises, falls = one <= 0 < other, one >= 0 > other
        return logical({"rising": rises, "falling": falls, "crossing": rises or falls}[name])

    def _starts(
        self, of: Expression, frame: CallFrame, by: Evaluator
    ) -> tuple[MatlabValue, MatlabValue | None]:
        """A datum at the start of this step, and of the step before."""
        datum = datum_of(frame.node, of.name) if isinstance(of, Name) else None
        if datum is None:
            raise DrawnFault("changes are seen of a datum: name one")
        memory = by.memory
        if datum.ssid in memory.shared:
            raise DrawnFault(CHANGES_OF_STORES)
        now = memory.start.get(datum.ssid, memory.values[datum.ssid])  # there is no start at initialization
        return now, memory.before.get(datum.ssid)


def _equal(one: MatlabValue, other: MatlabValue) -> bool:
    return isinstance(one, Scalar) and isinstance(other, Scalar) and one.value == other.value


def _word(unit: Expression) -> str:
    if isinstance(unit, Name):
        return "tick" if unit.name == "wakeup" else unit.name
    raise DrawnFault("times are counted in sec, msec, usec, tick or in an event")


def _durations(chart: ParsedChart) -> Iterator[tuple[Applied, StateNode]]:
    """Every operator that measures how long a condition holds, with the states whose time it is."""
    for node in chart.root.every():
        for expression in expressions_of(node.sections, node.on_events):
            yield from _measures(expression, node)
        for one in _reached([*node.outer, *node.inner, *node.defaults]):
            for expression in expressions_of(one.label):
                yield from _measures(expression, node)


def _measures(expression: Expression, node: StateNode) -> Iterator[tuple[Applied, StateNode]]:
    for part in parts(expression):
        match part:
            case Applied(Name(name)) if name in DURATIONS:
                yield part, node


def _reached(transitions: Iterable[TransitionNode]) -> Iterator[TransitionNode]:
    """Some transitions, and those that follow them through junctions."""
    waiting, seen = list(transitions), set[int]()
    while waiting:
        one = waiting.pop()
        if id(one) not in seen:
            seen.add(id(one))
            yield one
            if isinstance(one.target, JunctionNode):
                waiting += one.target.outgoing


__all__ = ["ChartClock"]
