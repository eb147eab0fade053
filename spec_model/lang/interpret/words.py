"""Temporal words of one chart, counted in executed steps (rules G13 to G15, and ``held``, also in ms).

Nothing saturates here: counts are plain numbers, kept per source state and per word.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Expr, Named, Temporal, Var, When
from rovercheck.spec_model.lang.walk import nodes


@dataclass
class _Count:
    """A word with what is remembered for it."""

    word: Temporal
    ticks: int
    count: int = 0
    in_ms: bool = False


class InterpretedWords:
    """Counters and memories of the temporal words of one chart."""

    def __init__(self, chart: Chart, tick_ms: int, elapsed: Var | None = None) -> None:
        self._tick_ms, self._elapsed = tick_ms, elapsed
        self._since: dict[Path, int] = {}
        self._durations = {p: self._durations_of(chart, p) for p in chart.states}
        self._held = {id(w): self._count_of_held(w) for w in _words(chart, When.HELD)}
        self._edges = {id(w): w for w in _words(chart, When.RISING)}
        self._before: dict[int, int] = {}
        self._now: dict[int, int] = {}
        self._temporal = {id(e) for e in chart.expressions if any(isinstance(n, Temporal) for n in nodes(e))}

    def _ticks(self, word: Temporal) -> int:
        return 0 if word.span is None else word.span.ticks(self._tick_ms)

    def _count_of_held(self, word: Temporal) -> _Count:
        if word.span is not None and word.span.measured(self._elapsed):
            return _Count(word, word.span.ticks(1), in_ms=True)
        return _Count(word, self._ticks(word))

    def _durations_of(self, chart: Chart, path: Path) -> dict[int, _Count]:
        """The durations that guards of paths leaving the state may ask for."""
        found: dict[int, _Count] = {}
        todo = [(path[:-1], t) for t in chart.states[path].transitions]
        while todo:
            level, segment = todo.pop()
            if segment.guard is not None:
                words = (n for n in nodes(segment.guard) if isinstance(n, Temporal))
                found |= {id(w): _Count(w, self._ticks(w)) for w in words if w.when is When.DURATION}
            target = chart.resolve(level, segment.target)
            if target is not None and target in chart.junctions:
                todo += [(target[:-1], t) for t in chart.junctions[target].transitions]
        return found

    # --- when things happen ---

    def start_of_step(self, at: Mapping[str, int]) -> None:
        """Read the arguments of ``rising`` and ``held``; states active now are one step older."""
        for held in self._held.values():
            # The first tick of a row is not counted in ms: it only begins here.
            passed = self._passed(at) if held.in_ms and held.count else 1
            held.count = held.count + passed if _argument(held.word, at) else 0
        now = {key: _argument(word, at) for key, word in self._edges.items()}
        self._before, self._now = self._now or {key: 1 for key in now}, now
        self._since = {path: age + 1 for path, age in self._since.items()}

    def _passed(self, at: Mapping[str, int]) -> int:
        assert self._elapsed is not None
        return at[self._elapsed.name]

    def entered(self, path: Path) -> None:
        self._since[path] = 0
        for timer in self._durations[path].values():
            timer.count = 0

    def left(self, path: Path) -> None:
        del self._since[path]

    def executed(self, path: Path, at: Mapping[str, int]) -> None:
        """Before the transitions of a state are tested: a false condition restarts its duration (G14)."""
        for timer in self._durations[path].values():
            if not _argument(timer.word, at):
                timer.count = 0

    def end_of_step(self, at: Mapping[str, int]) -> None:
        """Durations of the states active now, with end-of-step values (rule G14)."""
        for path in self._since:
            for timer in self._durations[path].values():
                timer.count = timer.count + 1 if _argument(timer.word, at) else 0

    # --- reading ---

    def value(self, expr: Expr, at: Mapping[str, int], source: Path | None = None) -> int:
        """The value of a formula of the chart; ``source`` is the state that its path leaves."""
        return evaluate(self._known(expr, source) if id(expr) in self._temporal else expr, at)

    def part(self, expr: Expr, at: Mapping[str, int], source: Path | None) -> int:
        """The value of a part of a formula of the chart."""
        return evaluate(self._known(expr, source), at)

    def _known(self, expr: Expr, source: Path | None) -> Expr:
        """The formula with each temporal word replaced by its truth value."""
        match expr:
            case Temporal():
                return TRUE if self._true(expr, source) else FALSE
            case Named(name, body):
                return Named(name, self._known(body, source))
            case Apply(op, args, sort):
                return Apply(op, tuple(self._known(a, source) for a in args), sort)
            case _:
                return expr

    def _true(self, word: Temporal, source: Path | None) -> bool:
        match word.when:
            case When.RISING:
                return bool(self._now[id(word)] and not self._before[id(word)])
            case When.HELD:
                held = self._held[id(word)]
                return held.count >= held.ticks + 1
            case When.AFTER if source is not None:
                return self._since[source] >= self._ticks(word)
            case When.DURATION if source is not None:
                timer = self._durations[source][id(word)]
                return timer.count > timer.ticks if word.strict else timer.count >= timer.ticks
        raise ModelError(f"`{word}` has no meaning where no state is being left.")


def _words(chart: Chart, when: When) -> list[Temporal]:
    return [n for n in nodes(*chart.expressions) if isinstance(n, Temporal) and n.when is when]


def _argument(word: Temporal, at: Mapping[str, int]) -> int:
    assert word.arg is not None
    return evaluate(word.arg, at)
