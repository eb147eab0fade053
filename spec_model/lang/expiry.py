"""Free expiry: a system whose timers may expire at any time, so that counters need no memory.

The counter behind a temporal word only ever rises tick by tick or returns to 0.  The pass keeps what
its first tick tells and leaves the rest to a free input:

    after(3 s)          over1 & after(1 tick)           not in the step in which the state is entered
    duration(c) > 3 s   over1 & (duration(c) >= 1 tick)  c held at the end of the last step, and still does
    held(c, 3 s)        over1 & held(c, 0 s)             c holds at the start of the step

Giving ``over1`` the value that the exact counter would have shows that every run of the system is a
run of the free one; ``tests/lang/test_expiry.py`` does that on random charts.
"""

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, replace

from rovercheck.spec_model.lang.action import Action, Assign, If, kept
from rovercheck.spec_model.lang.chart import Chart, Component, Enabled, Junction, Path, State, Transition
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import Apply, Expr, Named, Temporal, Var, When, any_of, flag
from rovercheck.spec_model.lang.system import FREE, System
from rovercheck.spec_model.lang.time import tick
from rovercheck.spec_model.lang.walk import nodes, structure
from rovercheck.spec_model.lang.words import named

Counter = tuple[Path, When, tuple[object, ...]]
"""What counts: the state whose transitions ask (none for ``held``), the word, its condition."""

Change = Callable[[Expr], Expr]

LONG = 60
"""Characters of a condition that a note no longer repeats."""


def free_timers(system: System, keep: Collection[str] = (), *, name: str = "", text: str = "") -> System:
    """The system with the timers of its charts free, except those of the states in ``keep``.

    A name in ``keep`` is that of a state or of a chart, and covers what is inside; a word on a
    junction that several states lead to stays exact too.  The result is an over-approximation: what
    never happens in it never happens in ``system``.  A system without such timers is returned as it
    is.  Raises ``ModelError`` for a name in ``keep`` that no chart knows.
    """
    _known(system, keep)
    charts = [(c, Expiry(c, system.step_ms, keep)) for c in system.charts]
    freed = [word for _, free in charts for word in free.freed]
    if not freed:
        return system
    return replace(
        system,
        name=name or system.name + FREE,
        text=text or f"As {system.name}; timers may expire at any time.",
        components=tuple(_components(system.components, {id(c): free.chart() for c, free in charts})),
        notes=(*system.notes, _note(freed)),
        over=True,
        concrete=system.concrete or system.name,
    )


def _known(system: System, keep: Collection[str]) -> None:
    names = {n for c in system.charts for n in (c.name, *(".".join(p) for p in c.states if p))}
    names |= {p[-1] for c in system.charts for p in c.states if p}
    for wanted in keep:
        if not any(n == wanted or n.endswith(f".{wanted}") for n in names):
            raise ModelError(
                f"No chart of {system.name} has a state {wanted!r} whose timer could be kept; write the "
                f"name of a state or of a chart. {did_you_mean(wanted, names)}"
            )


def _label(word: Temporal) -> str:
    """The word as drawn, its condition left out where that is long."""
    return str(word) if word.arg is None or len(str(word.arg)) <= LONG else f"{word.when}(...) of {word.span}"


def _note(freed: Sequence[tuple[str, str]]) -> str:
    words = dict.fromkeys(word for word, _ in freed)
    listed = (f"`{word}` of {', '.join(state for w, state in freed if w == word)}" for word in words)
    return f"These may be over in any step after their first, which only adds runs: {'; '.join(listed)}."


def _components(components: Sequence[Component], charts: dict[int, Chart]) -> Iterator[Component]:
    for component in components:
        match component:
            case Chart():
                yield charts[id(component)]
            case Enabled():
                inside = _components(component.components, charts)
                yield Enabled(component.by, *inside, name=component.name)
            case _:
                yield component


@dataclass(frozen=True)
class _Word:
    """A temporal word as a test of its counter against the least value that makes it true."""

    counter: Counter
    least: int


class Expiry:
    """One chart whose timers are made free.

    ``flags`` holds the free inputs: for each counter, by the least value that the exact counter must have
    for the input to be true.
    """

    def __init__(self, chart: Chart, step_ms: int, keep: Collection[str]) -> None:
        self.original, self.step_ms = chart, step_ms
        self.exact = {p for p in chart.states if _covered(chart, p, keep)}
        self.leaving = _sources(chart)
        self.flags: dict[Counter, dict[int, Var]] = {}
        self.freed: list[tuple[str, str]] = []
        for expr, source in self._formulas():
            for node in nodes(expr):
                if isinstance(node, Temporal):
                    self._note(node, source)

    def _formulas(self) -> Iterator[tuple[Expr, Path | None]]:
        """Every formula with the state its transition leaves, where that is one state only."""
        for path, state in self.original.states.items():
            yield from ((t.guard, path) for t in state.transitions if t.guard is not None)
        for path, junction in self.original.junctions.items():
            guards = (t.guard for t in junction.transitions if t.guard is not None)
            yield from ((g, self.leaving.get(path)) for g in guards)
        yield from ((e, None) for e in self.original.expressions)

    def _word(self, word: Temporal, source: Path | None) -> _Word | None:
        """The word if it is to be free."""
        if word.span is None or word.when not in (When.AFTER, When.DURATION, When.HELD):
            return None
        owner = () if word.when is When.HELD else source
        if owner is None or owner in self.exact:
            return None
        ticks = word.span.ticks(self.step_ms)
        least = ticks + int(word.when is When.HELD or word.strict)
        counter = (owner, word.when, () if word.arg is None else structure(word.arg))
        return _Word(counter, least) if least > 1 else None

    def _note(self, word: Temporal, source: Path | None) -> None:
        found = self._word(word, source)
        if found is None or found.least in self.flags.setdefault(found.counter, {}):
            return
        state = ".".join((self.original.name, *found.counter[0]))
        number = 1 + sum(len(f) for c, f in self.flags.items() if c[0] == found.counter[0])
        self.flags[found.counter][found.least] = flag(f"{state}.over{number}", f"`{word}` may be over")
        self.freed.append((_label(word), _short(self.original, found.counter[0])))

    def _free(self, word: Temporal, source: Path | None) -> Expr:
        """The word with its counter cut off after one tick; a longer time is over only if a shorter is."""
        found = self._word(word, source)
        if found is None:
            return word
        over = any_of(*(f for least, f in self.flags[found.counter].items() if least >= found.least))
        span = 0 * tick if word.when is When.HELD else 1 * tick
        return named(f"{word}", over & Temporal(word.when, word.arg, span))

    def chart(self) -> Chart:
        """The chart with its words replaced."""
        root = self._state((), self.original.root)
        return Chart(
            root.name, root.states, default=root.default, junctions=root.junctions, parallel=root.parallel,
            text=self.original.text, local_to=self.original.local_to, place=root.place,
        )  # fmt: skip

    def _state(self, path: Path, state: State) -> State:
        plain, own = self._change(None), self._change(path)
        return replace(
            state,
            entry=_actions(state.entry, plain),
            during=_actions(state.during, plain),
            exit=_actions(state.exit, plain),
            states=tuple(self._state((*path, s.name), s) for s in state.states),
            transitions=_transitions(state.transitions, own, plain),
            default=_transitions(state.default, plain, plain),
            junctions=tuple(self._junction((*path, j.name), j) for j in state.junctions),
        )

    def _junction(self, path: Path, junction: Junction) -> Junction:
        own = self._change(self.leaving.get(path))
        return Junction(junction.name, _transitions(junction.transitions, own, self._change(None)))

    def _change(self, source: Path | None) -> Change:
        return lambda expr: self._replaced(expr, source) if _asks(expr) else expr

    def _replaced(self, expr: Expr, source: Path | None) -> Expr:
        match expr:
            case Temporal():
                return self._free(expr, source)
            case Named(name, body):
                return Named(name, self._replaced(body, source))
            case Apply(op, args, sort):
                return Apply(op, tuple(self._replaced(a, source) for a in args), sort)
            case _:
                return expr


def _asks(expr: Expr) -> bool:
    """Whether the formula has a temporal word at all: most have none, and stay as they are."""
    return any(isinstance(node, Temporal) for node in nodes(expr))


def _covered(chart: Chart, path: Path, keep: Collection[str]) -> bool:
    """Whether the state, a state around it or its chart is named."""
    if chart.name in keep:
        return True
    dotted = [".".join(path[start:end]) for end in range(1, len(path) + 1) for start in range(end)]
    return any(name in keep for name in dotted)


def _short(chart: Chart, path: Path) -> str:
    """As little of the path as names one state of the chart."""
    alike = [p for p in chart.states if p[-1:] == path[-1:] and p != path]
    length = next(n for n in range(1, len(path) + 2) if all(p[-n:] != path[-n:] for p in alike))
    return ".".join(path[-length:]) or chart.name


def _sources(chart: Chart) -> dict[Path, Path]:
    """The state that paths through a junction leave, for junctions that only one state leads to."""
    leading: dict[Path, set[Path]] = {}
    for source, state in chart.states.items():
        todo = [(source[:-1], t) for t in state.transitions]
        while todo:
            level, segment = todo.pop()
            target = chart.resolve(level, segment.target)
            if target in chart.junctions and source not in leading.setdefault(target, set()):
                leading[target].add(source)
                todo += [(target[:-1], t) for t in chart.junctions[target].transitions]
    return {junction: sources.pop() for junction, sources in leading.items() if len(sources) == 1}


def _transitions(transitions: Sequence[Transition], own: Change, plain: Change) -> tuple[Transition, ...]:
    return tuple(
        replace(
            t,
            guard=None if t.guard is None else own(t.guard),
            do=_actions(t.do, plain),
            then=_actions(t.then, plain),
        )
        for t in transitions
    )


def _actions(actions: Sequence[Action], change: Change) -> tuple[Action, ...]:
    return tuple(_action(a, change) for a in actions)


def _action(action: Action, change: Change) -> Action:
    match action:
        case Assign(var, value):
            return kept(action, Assign(var, change(value)))
        case If(condition, then, otherwise):
            return kept(action, If(change(condition), _actions(then, change), _actions(otherwise, change)))
        case _:
            return action


__all__ = ["Counter", "Expiry", "free_timers"]
