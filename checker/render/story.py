"""A trace as a story: the ticks in which something happened, and the quiet stretches between them.

No event is: a timer that counts up; a transition from a state to itself that fires as it did in the tick
before; the location of a chart whose transition is told anyway; the bookkeeping of the property.  A stretch
of ticks without any event is one line, with the first and the last value of each timer.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from rovercheck.checker.render.durations import duration
from rovercheck.checker.render.limits import bounds, timer
from rovercheck.checker.results.trace import TakenTransition, Tick, Trace, counted_ticks
from rovercheck.checker.results.verdict import StoredRun
from rovercheck.spec_model.lang.domain import Enum, Num
from rovercheck.spec_model.lang.expr import Expr, Named
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.walk import variables

RISING = re.compile(r"\.rising\d+$")
"""Names of what remembers what ``rising`` compares."""

TIMER = re.compile(r"\.(after|duration\d*|held\d*)$")
"""Names of the counters behind ``after``, ``duration`` and ``held``."""


@dataclass(frozen=True)
class StoryChange:
    """A value that differs from the tick before; ``old`` is empty for an input in the first tick.

    ``limit`` is what a guard compares a count with, and ``needed`` tells that the input had to be so.
    """

    name: str
    old: str
    new: str
    is_input: bool
    limit: str = ""
    needed: bool = False

    def __str__(self) -> str:
        shown = f"{self.name}: {self.old} → {self.new}" if self.old else f"{self.name} = {self.new}"
        return f"{shown}, limit {self.limit}" if self.limit else shown


@dataclass(frozen=True)
class StoryEvent:
    """A tick in which something happened; ``ms`` is the time at its end, counted from the start."""

    number: int
    ms: int
    changes: tuple[StoryChange, ...]
    transitions: tuple[TakenTransition, ...]


@dataclass(frozen=True)
class Quiet:
    """Ticks ``first`` to ``last`` in which, for ``lasts`` ms, nothing but ``counters`` changed."""

    first: int
    last: int
    lasts: int
    counters: tuple[StoryChange, ...]

    @property
    def count(self) -> int:
        return self.last - self.first + 1

    @property
    def what(self) -> str:
        """The stretch in one sentence."""
        span = f"ticks {self.first}–{self.last}" if self.count > 1 else f"tick {self.first}"
        ticks = f"{counted_ticks(self.count)} = {duration(self.lasts)}"
        if not self.counters:
            return f"{span}: nothing changes; {ticks}"
        return f"{span}: nothing but timers ({'; '.join(map(str, self.counters))}); {ticks}"


@dataclass(frozen=True)
class Conjunct:
    """A conjunct of the property: its name, what that stands for, the values of its variables at the end.

    It is ``true``, or false, in every tick from ``since`` on.
    """

    name: str
    formula: str
    values: tuple[tuple[str, str], ...]
    since: int
    true: bool = False

    @property
    def verdict(self) -> str:
        """``False since tick 7``."""
        return f"{self.true} since tick {self.since}"


@dataclass(frozen=True)
class Repeats:
    """What follows repeats for ever: ticks ``first`` to ``last``."""

    first: int
    last: int

    @property
    def what(self) -> str:
        """The mark in one sentence."""
        span = f"ticks {self.first}–{self.last} repeat" if self.last > self.first else "this tick repeats"
        return f"from here on {span} for ever"


Row = StoryEvent | Quiet | Repeats


def value(trace: Trace, name: str, raw: int) -> str:
    """A value with its unit, as a person writes it."""
    sort = trace.system.variables[name].sort
    unit = str(sort.unit) if isinstance(sort, Num) else ""
    return f"{trace.show(name, raw)} {unit}".rstrip()


def of_model(trace: Trace, name: str) -> bool:
    """Whether a reader knows the variable from the model; others are bookkeeping, of the property too."""
    return name != trace.property.id and not trace.system.variables[name].hidden and not RISING.search(name)


def rows(trace: Trace, ends: frozenset[int] = frozenset()) -> Iterator[Row]:
    """Events and quiet stretches in order, and the start of a loop; the last tick is always an event.

    A quiet stretch ends after each tick of ``ends``.
    """
    telling = _Telling(trace)
    at = telling.at
    start: int | None = None
    for i, tick in enumerate(trace.ticks):
        if start is not None and (i == trace.loop or i in ends):
            yield telling.quiet(start, i)
            start = None
        if i == trace.loop:
            yield Repeats(i + 1, len(trace))
        last = i == len(trace.ticks) - 1
        transitions = tuple(a for a in tick.transitions if not _repeats(a, trace.ticks[i - 1] if i else None))
        told = {a.chart for a in transitions}
        news = [n for n in _changed(trace, at[i], at[i + 1]) if not _implies(trace, n, told)]
        news = [n for n in news if last or not _counts(trace, at, n, i)]
        if not news and not transitions and not last:
            start = i if start is None else start
            continue
        if start is not None:
            yield telling.quiet(start, i)
            start = None
        yield telling.event(i, transitions, news)


def _changed(trace: Trace, old: Mapping[str, int], new: Mapping[str, int]) -> list[str]:
    """Variables a reader knows whose value differs, those without an old value included."""
    return [n for n, v in new.items() if old.get(n) != v and of_model(trace, n)]


def _repeats(transition: TakenTransition, before: Tick | None) -> bool:
    """Whether the transition keeps its state, for the same reason as in the tick before."""
    if before is None or transition.source != transition.target:
        return False
    return any(
        (a.chart, a.target, a.label) == (transition.chart, transition.target, transition.label)
        for a in before.transitions
    )


def _implies(trace: Trace, name: str, told: set[str]) -> bool:
    """Whether a transition that is told implies this change of a location."""
    sort = trace.system.variables[name].sort
    if not isinstance(sort, Enum) or not sort.name.startswith("states of "):
        return False
    return any(name == chart or name.startswith(f"{chart}.") for chart in told)


def _counts(trace: Trace, at: list[dict[str, int]], name: str, i: int) -> bool:
    """Whether the change in the i-th tick is one step of a steady count."""
    if not isinstance(trace.system.variables[name].sort, Num) or name not in at[i]:
        return False
    step = at[i + 1][name] - at[i][name]
    if TIMER.search(name):
        return step == 1
    before = i > 0 and name in at[i - 1] and at[i][name] - at[i - 1][name] == step
    behind = i + 2 < len(at) and at[i + 2][name] - at[i + 1][name] == step
    return before or behind


class _Telling:
    """A trace with what is looked up again and again while it is told."""

    def __init__(self, trace: Trace) -> None:
        self.trace = trace
        self.at = values_at(trace)
        self._bounds = bounds(trace)
        self._needed = {(one.number, one.name) for one in trace.needed()}

    def quiet(self, start: int, end: int) -> Quiet:
        names = [n for n in _changed(self.trace, self.at[start], self.at[end]) if n in self.at[start]]
        counters = tuple(self._counted(n, start, end) for n in names)
        return Quiet(start + 1, end, self.trace.ms(end) - self.trace.ms(start), counters)

    def event(self, i: int, transitions: tuple[TakenTransition, ...], names: list[str]) -> StoryEvent:
        changes = [self._change(n, i) for n in names]
        changes.sort(key=lambda change: not change.is_input)
        number = self.trace.ticks[i].number
        return StoryEvent(number, self.trace.ms(number), tuple(changes), transitions)

    def _change(self, name: str, i: int) -> StoryChange:
        trace, old, new = self.trace, self.at[i], self.at[i + 1]
        if TIMER.search(name) and name in old:
            return self._counted(name, i, i + 1)
        shown = value(trace, name, old[name]) if name in old else ""
        needed = (trace.ticks[i].number, name) in self._needed
        return StoryChange(
            name, shown, value(trace, name, new[name]), name in trace.system.inputs, needed=needed
        )

    def _counted(self, name: str, start: int, end: int) -> StoryChange:
        """A count that went on, with the limit that it has yet to pass; of a timer, as times."""
        old, new = self.at[start][name], self.at[end][name]
        shown = counted_on(self.trace, name, old, new)
        if timer(self.trace, name) is not None:
            return shown
        ahead = [text for raw, text in self._bounds.get(name, ()) if raw >= new > old]
        return replace(shown, limit=ahead[0] if ahead else "")


def values_at(trace: Trace) -> list[dict[str, int]]:
    """All values before the first tick and after each one."""
    return [dict(trace.before), *({**t.after, **t.inputs} for t in trace.ticks)]


def counted_on(trace: Trace, name: str, old: int, new: int) -> StoryChange:
    """The change of a count; of a timer, as times and with the limit of its guard."""
    known = timer(trace, name)
    if known is not None:
        return StoryChange(name, known.shown(old), known.shown(new), False, known.limit if new else "")
    return StoryChange(name, value(trace, name, old), value(trace, name, new), name in trace.system.inputs)


def start_values(trace: Trace) -> tuple[tuple[str, str], ...]:
    """The frozen choices of the run: those that it names, and values that no tick holds as its own."""
    frozen = [
        n
        for n in trace.before
        if n in trace.system.frozen or not trace.ticks or n not in trace.ticks[0].after
    ]
    return tuple((n, value(trace, n, trace.before[n])) for n in frozen)


def false_parts(trace: Trace) -> tuple[Conjunct, ...]:
    """Which conjuncts of the property are false after the last tick, since when, and why."""
    return tuple(part for part in conjuncts(trace) if not part.true)


def conjuncts(trace: Trace) -> tuple[Conjunct, ...]:
    """All conjuncts of the property, where more than those that are false are known."""
    at = {**trace.ticks[-1].after, **trace.ticks[-1].inputs} if trace.ticks else dict(trace.before)
    return tuple(_conjunct(trace, expr, at) for expr in trace.property.parts or trace.property.false_parts)


def _conjunct(trace: Trace, expr: Expr, at: Mapping[str, int]) -> Conjunct:
    names = [n for n in variables(expr) if n in at and n in trace.system.variables]
    values = tuple((n, value(trace, n, at[n])) for n in names)
    shown = text(expr, unfold=True)
    true = all(expr is not false for false in trace.property.false_parts)
    return Conjunct(expr.name if isinstance(expr, Named) else "", shown, values, trace.since(expr), true)


OMITTED = "Omitted: running counters, repeated self-transitions, monitor variables."


def heading(trace: Trace) -> str:
    """One line about the whole run."""
    count = len(trace)
    ticks = counted_ticks(count) if trace.ends else f"{counted_ticks(count)} of {trace.system.tick_ms} ms"
    return f"{trace.system.name}: {ticks}, {duration(trace.ms(count))}{repeating(trace)}"


def repeating(trace: Trace | StoredRun) -> str:
    """Which ticks at the end repeat for ever, after a comma; empty if none does."""
    if trace.loop is None:
        return ""
    again = len(trace) - trace.loop
    return f", the last {again} ticks for ever" if again > 1 else ", the last tick for ever"


def ending(trace: Trace) -> str:
    """What a run without end comes back to, or what a trapped run can no longer reach; else empty."""
    if trace.loop is not None:
        back = f"tick {trace.loop}" if trace.loop else "the start"
        return f"Loop: back to {back}, with all that the property depends on as it was then."
    if trace.trapped is not None:
        count = f"any of the {trace.trapped:,} states" if trace.trapped > 1 else "the only state"
        return f"No way back: what is false now is false in {count} that can follow."
    return ""


def standstill(trace: Trace, event: StoryEvent) -> str:
    """What there is to say of a tick of which nothing else is told; empty if something is."""
    if event.changes or event.transitions:
        return ""
    broken = event.number == len(trace) and trace.loop is None and trace.breaks()
    return "nothing changes, which breaks the property" if broken else "nothing changes"


def start_of(transition: TakenTransition) -> str:
    """Where a transition starts and ends: ``A → B (transition 2)``, or ``default → B``."""
    start = transition.source if transition.order else "default"
    number = f" (transition {transition.order})" if transition.order else ""
    event = f" on {transition.event}" if transition.event and transition.event not in transition.label else ""
    return f"{start} → {transition.target}{number}{event}"
