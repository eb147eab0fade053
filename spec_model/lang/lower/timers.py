"""Temporal words of a chart as saturating counters and one-tick memories (rules G13-G15, section 7).

A counter stops one above what is ever asked of it and is 0 while its state is not active, so that
states that behave alike are equal.  One that is only asked for its first tick is set anew in each
step and belongs to no state.  Where ticks last unlike times, ``held`` counts milliseconds: 1 in the first
tick, and in each later one what has elapsed.
"""

from collections.abc import Iterator
from functools import cached_property

from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.chart import Chart, Path, Transition
from rovercheck.spec_model.lang.domain import boolean, integer
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var, When, ite
from rovercheck.spec_model.lang.system import Statement
from rovercheck.spec_model.lang.walk import nodes, structure
from rovercheck.spec_model.lang.words import minimum


class ChartTimers:
    """The counters of one chart, and formulas with their temporal words replaced by them."""

    def __init__(self, chart: Chart, tick_ms: int, elapsed: Var | None = None) -> None:
        self.chart = chart
        self.tick_ms, self.elapsed = tick_ms, elapsed
        self.after: dict[Path, Var] = {}
        self.durations: dict[Path, dict[tuple[object, ...], tuple[Temporal, Var]]] = {}
        self.risings: dict[tuple[object, ...], tuple[Expr, Var]] = {}
        self.helds: dict[tuple[object, ...], tuple[Temporal, Var]] = {}
        for path, state in chart.states.items():
            segments = self._segments(path, state.transitions)
            self._of_state(path, [w for t in segments for w in _words(t.guard)])
        for word in (w for e in chart.expressions for w in _words(e)):
            self._of_chart(word)

    def _segments(self, source: Path, transitions: tuple[Transition, ...]) -> Iterator[Transition]:
        """The segments of every path that leaves the source."""
        seen: set[Path] = set()
        stack = [(source[:-1], t) for t in transitions]
        while stack:
            level, segment = stack.pop()
            yield segment
            target = self.chart.resolve(level, segment.target)
            if target in self.chart.junctions and target not in seen:
                seen.add(target)
                stack += [(target[:-1], t) for t in self.chart.junctions[target].transitions]

    def _of_state(self, path: Path, words: list[Temporal]) -> None:
        name = ".".join((self.chart.name, *path))
        longest = [self._ticks(w) for w in words if w.when is When.AFTER]
        if longest:
            doc = f"ticks since {name} was entered"
            self.after[path] = Var(f"{name}.after", integer(0, max(longest)), 0, doc)
        for word in words:
            if word.when is When.DURATION and structure(word) not in self.durations.setdefault(path, {}):
                number = len(self.durations[path]) + 1
                top = self._ticks(word) + (1 if word.strict else 0)
                counter = Var(f"{name}.duration{number}", integer(0, top), 0, f"ticks for which {word.arg}")
                self.durations[path][structure(word)] = (word, counter)

    def _of_chart(self, word: Temporal) -> None:
        if word.when is When.RISING and word.arg is not None and structure(word) not in self.risings:
            name = f"{self.chart.name}.rising{len(self.risings) + 1}"
            memory = Var(name, boolean, 1, f"{word.arg} in the step before")
            self.risings[structure(word)] = (word.arg, memory)
        if word.when is When.HELD and structure(word) not in self.helds:
            name = f"{self.chart.name}.held{len(self.helds) + 1}"
            self.helds[structure(word)] = (word, self._counter_of_held(name, word))

    def _counter_of_held(self, name: str, word: Temporal) -> Var:
        top, measured = self._ticks(word) + 1, self._measured(word)
        unit, counted = ("ms", "ms with") if measured else ("", "ticks in a row with")
        return Var(name, integer(0, top, unit), 0, f"{counted} {word.arg}")

    def _measured(self, word: Temporal) -> bool:
        return word.when is When.HELD and word.span is not None and word.span.measured(self.elapsed)

    def _ticks(self, word: Temporal) -> int:
        assert word.span is not None
        return word.span.ticks(1 if self._measured(word) else self.tick_ms)

    @cached_property
    def variables(self) -> tuple[Var, ...]:
        """Every counter and memory."""
        durations = [v for timers in self.durations.values() for _, v in timers.values()]
        others = [v for _, v in (*self.risings.values(), *self.helds.values())]
        return (*self.after.values(), *durations, *others)

    def plainly(self, expr: Expr, source: Path | None = None) -> Expr:
        """The formula with temporal words replaced; ``source`` is the state its transition leaves."""
        match expr:
            case Temporal():
                return self._counter_test(expr, source)
            case Named(name, body):
                inside = self.plainly(body, source)
                return expr if inside is body else Named(name, inside)
            case Apply(op, args, sort):
                changed = tuple(self.plainly(a, source) for a in args)
                same = all(a is b for a, b in zip(args, changed, strict=True))
                return expr if same else Apply(op, changed, sort)
            case _:
                return expr

    def _counter_test(self, word: Temporal, source: Path | None) -> Expr:
        match word.when:
            case When.AFTER if source in self.after:
                return self.after[source] >= self._ticks(word)
            case When.DURATION if source is not None:
                counter = self.durations[source][structure(word)][1]
                return counter > self._ticks(word) if word.strict else counter >= self._ticks(word)
            case When.RISING:
                arg, memory = self.risings[structure(word)]
                return arg & ~memory
            case When.HELD:
                counter = self.helds[structure(word)][1]
                return counter >= self._ticks(word) + 1
        raise AssertionError(f"{word} has no counter; wellformed charts have none such")

    def at_start(self) -> list[Statement]:
        """What counts at the start of every executed step of the chart, the first included."""
        counts: list[Statement] = [
            _count(counter, word.arg, self.elapsed if self._measured(word) else None)
            for word, counter in self.helds.values()
        ]
        return counts + [
            Assign(c, ite(self.chart.active_path(path), _one(c), _zero(c)))
            for path, c in self.after.items()
            if c.domain.high == 1
        ]

    def at_start_entered(self) -> list[Statement]:
        """What counts at the start of every later step (rule G13)."""
        return [
            If(self.chart.active_path(path), (Assign(c, minimum(c + 1, c.domain.high)),))
            for path, c in self.after.items()
            if c.domain.high > 1
        ]

    def on_execution(self, path: Path) -> list[Statement]:
        """A duration restarts when its state is executed with a false condition (rule G14)."""
        return [
            If(_argument(word), (), (Assign(counter, _zero(counter)),))
            for word, counter in self.durations.get(path, {}).values()
        ]

    def on_exit(self, path: Path) -> list[Statement]:
        """Counters of a state that is left return to 0."""
        mine = [self.after[path]] if path in self.after else []
        mine += [counter for _, counter in self.durations.get(path, {}).values()]
        return [Assign(counter, _zero(counter)) for counter in mine]

    def at_end(self) -> list[Statement]:
        """What counts at the end of every executed step of the chart."""
        counts: list[Statement] = [
            If(self.chart.active_path(path), (_count(counter, word.arg),))
            for path, timers in self.durations.items()
            for word, counter in timers.values()
        ]
        return counts + [Assign(memory, arg) for arg, memory in self.risings.values()]


def _words(expr: Expr | None) -> list[Temporal]:
    return [] if expr is None else [e for e in nodes(expr) if isinstance(e, Temporal)]


def _argument(word: Temporal) -> Expr:
    assert word.arg is not None
    return word.arg


def _zero(counter: Var) -> Const:
    return Const(0, counter.sort)


def _one(counter: Var) -> Const:
    return Const(1, counter.sort)


def _count(counter: Var, condition: Expr | None, elapsed: Var | None = None) -> Assign:
    assert condition is not None
    more: Expr = minimum(counter + 1, counter.domain.high) if counter.domain.high > 1 else _one(counter)
    if elapsed is not None:
        more = ite(counter > 0, minimum(counter + elapsed, counter.domain.high), _one(counter))
    return Assign(counter, ite(condition, more, _zero(counter)))
