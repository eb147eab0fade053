"""The possible next steps of a system: how each of its charts can react in a tick, and to which inputs.

A *reaction* of a chart is the set of transitions that it takes in a tick.  A solver finds all reactions of
each chart, from formulas in which the state is already known (``checker.encode.one_tick``).  How reactions of
several charts combine is too much to list: what can happen with some of them is asked for by requiring these.
Of a system without charts, the values that its data can take are found in the same way.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import islice

from rovercheck.checker.encode.one_tick import ChosenValues, OneTick
from rovercheck.checker.results.trace import TakenTransition
from rovercheck.checker.system.instrument.entries import ChartTransitions, Segment, TransitionGroup
from rovercheck.checker.system.instrument.goals import GoalKind
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.system.live_variables import live_before
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import TRUE, Apply, Const, Expr, Var
from rovercheck.spec_model.lang.fired_transition import path_label
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import System, TransitionSystem
from rovercheck.spec_model.lang.walk import variables

MOST = 64
"""Reactions of one chart, or values of one variable, that are listed; where there are more, it is said."""


@dataclass(frozen=True)
class PossibleStep:
    """A reaction of a chart, or a value of a variable, that the next tick can have.

    ``key`` names it, also in a later listing from the same state.  ``transitions`` are those that the chart
    takes, none where it stays as it is, ``states`` its innermost active states afterwards.  ``inputs`` and
    ``frozen`` are admissible and lead there; ``changed`` names those of them that differ from how they stand.
    ``also`` are transitions of other charts that the inputs as they stand do not
    lead to.  ``standing``: it is what happens with the
    inputs as they stand.  ``moves``: another state is active afterwards.
    """

    key: str
    of: str
    transitions: tuple[TakenTransition, ...]
    states: tuple[str, ...]
    inputs: Mapping[str, int]
    frozen: Mapping[str, int]
    changed: tuple[str, ...]
    also: tuple[TakenTransition, ...] = ()
    standing: bool = False
    moves: bool = False
    shown: str = ""
    becomes: tuple[str, int] | None = None
    """Of a system without charts: a variable and its raw value afterwards."""

    @property
    def title(self) -> str:
        """``Relay: B1_actuating → B2_actuating``, ``Relay: no transition``."""
        ways = [f"{t.source or 'default'} → {t.target}" for t in self.transitions]
        if self.becomes is not None:
            return f"{self.of} = {self.shown}"
        return f"{self.of}: {', '.join(ways) or 'no transition'}"


@dataclass(frozen=True)
class NextSteps:
    """What can happen in the next tick.

    ``steps`` are all reactions of each chart that can react in several ways, those that change a state first;
    ``anyway`` the transitions that are taken whatever the inputs are.  ``bounded`` says of which parts not
    all were listed; empty: it is all.  ``problems`` say that some inputs lead out of a domain, or that there
    are no admissible inputs at all.
    """

    steps: tuple[PossibleStep, ...]
    anyway: tuple[TakenTransition, ...] = ()
    bounded: tuple[str, ...] = ()
    problems: tuple[str, ...] = ()

    def of(self, key: str) -> PossibleStep | None:
        """The step of that name."""
        return next((step for step in self.steps if step.key == key), None)


@dataclass(frozen=True)
class _Part:
    """A chart, its segments by the flag that tells of each, and what can be told of a tick in it."""

    chart: Chart
    segments: Mapping[str, Segment]
    transitions: ChartTransitions

    def taken(self, flags: Iterable[str]) -> tuple[TakenTransition, ...]:
        """The transitions that segments with these flags make, from a state (or default) to a state."""
        on = [self.segments[flag] for flag in flags]
        starts = [s for s in on if s.group.default or s.group.owner in self.chart.states]
        return tuple(self._from(start, on) for start in sorted(starts, key=lambda s: s.number))

    def _from(self, start: Segment, on: Sequence[Segment]) -> TakenTransition:
        path = [start]
        while (end := self.transitions.target(path[-1])) in self.chart.junctions:
            follow = [s for s in on if s.group == TransitionGroup(end) and s not in path]
            if not follow:
                break
            path.append(follow[0])
        default = start.group.default
        return TakenTransition(
            self.chart.name,
            "" if default else ".".join(start.group.owner),
            ".".join(end),
            path_label([s.drawn for s in path]),
            0 if default else start.order,
        )


@dataclass
class StepFinder:
    """Finds the possible next steps of one system, from any state of it; for one thread at a time.

    Raises ``ModelError`` for a chart that was read from a file: its transitions are those of its program.
    """

    system: System
    _lowered: TransitionSystem = field(init=False)
    _parts: list[_Part] = field(init=False)

    def __post_init__(self) -> None:
        seen = watched(self.system, (GoalKind.TRANSITIONS,))
        flags: dict[str, dict[str, str]] = {}
        for goal in seen.goals:
            flags.setdefault(goal.part, {})[goal.id.rpartition(".")[2]] = goal.flag.name
        self._parts = []
        for chart in self.system.charts:
            if isinstance(chart, ProgrammedChart):
                raise ModelError(
                    f"{chart.name} was read from a file, and what it can do next is not listed; write step, "
                    "or reach CONDITION."
                )
            transitions = ChartTransitions(chart)
            named = {flags[chart.name][str(s.number)]: s for s in transitions.segments}
            self._parts.append(_Part(chart, named, transitions))
        self._lowered = self._only_what_is_told(lower(seen.system))

    def _only_what_is_told(self, system: TransitionSystem) -> TransitionSystem:
        """The system with those statements of its step on which what is told of a tick depends in it."""
        if not self._parts:
            return system
        told = {flag for part in self._parts for flag in part.segments}
        told |= {place.name for part in self._parts for place in part.chart.locations}
        told |= {check.name for check, _ in system.checks}
        return replace(system, step=live_before(system.step, frozenset(told))[1])

    def find(
        self,
        state: Mapping[str, int],
        standing: Mapping[str, int],
        required: Sequence[str] = (),
        *,
        first: bool = False,
    ) -> NextSteps:
        """What can happen in the tick after a state, where inputs stand at some values.

        ``first``: it is the first tick, before which frozen values are still to be chosen.  Of ``required``
        keys of such a listing, only what can happen together with them.
        """
        system = self._lowered
        now = {**standing, **({v.name: state[v.name] for v in system.frozen} if first else {})}
        tick = OneTick(system, state, (*system.inputs, *(system.frozen if first else ())))
        under, problems = self._meaningful(tick, now)
        if problems and not under:
            return NextSteps((), problems=problems)
        demanded = [f for key in required for f in self._demanded(tick, key)]
        search = _Search(system, self._parts, tick, now, [*under, *demanded], state)
        found, bounded = search.steps()
        found.sort(key=lambda step: (not step.moves, not step.transitions, len(step.changed)))
        return NextSteps(tuple(found), search.anyway(), bounded, problems)

    def _meaningful(self, tick: OneTick, now: Mapping[str, int]) -> tuple[list[Expr], tuple[str, ...]]:
        """The conditions that every value stays in its domain, and what is wrong with some or all inputs."""
        if next(tick.choices((), (), now), None) is None:
            return [], ("No inputs are admissible in this tick: what is assumed contradicts itself here.",)
        problems, under = [], []
        for check, text in self._lowered.checks:
            raised = tick.after(check.name)
            if isinstance(raised, Const) and not raised.value:
                continue
            under.append(~raised)
            if next(tick.choices((), [raised], now), None) is not None:
                problems.append(
                    f"Some inputs are left out, because the model has no meaning for them: {text}"
                )
        if under and next(tick.choices((), under, now), None) is None:
            return [], tuple(problems) or ("Whatever the inputs are, the next tick leaves a domain.",)
        return under or [TRUE], tuple(problems)

    def _demanded(self, tick: OneTick, key: str) -> Iterator[Expr]:
        of, _, rest = key.partition(":")
        part = next((p for p in self._parts if p.chart.name == of), None)
        if part is None:
            var = next((v for v in self._lowered.variables if v.name == of), None)
            if var is not None and rest.lstrip("-").isdigit():
                yield Apply(Op.EQ, (tick.after(of), Const(int(rest), var.sort)), Bool())
            return
        on = set(rest.split(",")) - {""}
        for flag, segment in part.segments.items():
            value = tick.after(flag)
            if not isinstance(value, Const):
                yield value if str(segment.number) in on else ~value


@dataclass
class _Search:
    """The search from one state: ``now`` are the values that stand of all that is open, ``under`` what is
    required of the tick."""

    system: TransitionSystem
    parts: Sequence[_Part]
    tick: OneTick
    now: Mapping[str, int]
    under: Sequence[Expr]
    state: Mapping[str, int]

    def __post_init__(self) -> None:
        at = self._standing = ChosenValues(self.now)
        self._stands = self.tick.admits(self.now) and all(at.of(u) for u in self.under)
        self._sure = {p.chart.name: [f for f in p.segments if self._is_sure(f)] for p in self.parts}
        self._open = {p.chart.name: [f for f in p.segments if self.tick.is_open(f)] for p in self.parts}
        self._usual = {p.chart.name: self._moved(p, at) for p in self.parts}
        self._reads = {n: frozenset(variables(*map(self.tick.after, f))) for n, f in self._open.items()}

    def _is_sure(self, flag: str) -> bool:
        return not self.tick.is_open(flag) and bool(evaluate(self.tick.after(flag), {}))

    def steps(self) -> tuple[list[PossibleStep], tuple[str, ...]]:
        """All that each part can do, and of which parts not all was listed."""
        found: list[PossibleStep] = []
        bounded: list[str] = []
        for of, formulas, made in self._asked():
            ways = list(islice(self.tick.choices(formulas, self.under, self.now), MOST + 1))
            if len(ways) > MOST:
                bounded.append(f"Of {of} the first {MOST} possibilities are listed; there are more.")
            found += [made(self._nearest(formulas, way)) for way in ways[:MOST]]
        return found, tuple(bounded)

    def anyway(self) -> tuple[TakenTransition, ...]:
        """The transitions of charts that can react in one way only."""
        sure = [p for p in self.parts if not self._open[p.chart.name]]
        return tuple(t for part in sure for t in part.taken(self._on(part, self._standing)))

    def _asked(self) -> Iterator[tuple[str, list[Expr], Callable[[dict[str, int]], PossibleStep]]]:
        """Each part that can do several things, with the formulas that tell these apart."""
        for part in self.parts:
            if flags := self._open[part.chart.name]:
                yield part.chart.name, [self.tick.after(f) for f in flags], partial(self._reaction, part)
        if not self.parts:
            for var in self.system.variables:
                if not var.hidden and self.tick.is_open(var.name):
                    yield var.name, [self.tick.after(var.name)], partial(self._value, var)

    def _on(self, part: _Part, at: ChosenValues) -> list[str]:
        name = part.chart.name
        decided = (flag for flag in self._open[name] if at.of(self.tick.after(flag)))
        return [*self._sure[name], *decided]

    def _moved(self, part: _Part, at: ChosenValues) -> tuple[TakenTransition, ...]:
        """The transitions of a chart that lead to another state."""
        return tuple(t for t in part.taken(self._on(part, at)) if t.source != t.target)

    def _also(self, part: _Part, at: ChosenValues, changed: Collection[str]) -> list[TakenTransition]:
        """What other charts do that they would not do with the inputs as they stand."""
        concerned = (
            p for p in self.parts if p is not part and not self._reads[p.chart.name].isdisjoint(changed)
        )
        return [t for p in concerned for t in self._moved(p, at) if t not in self._usual[p.chart.name]]

    def _nearest(self, formulas: Sequence[Expr], way: Mapping[str, int]) -> dict[str, int]:
        """Values with the same effect on the formulas, of which few differ from those that stand."""
        at = ChosenValues(way)
        kept = [(formula, at.of(formula)) for formula in formulas]
        if self._stands and all(self._standing.of(f) == wanted for f, wanted in kept):
            return dict(self.now)
        return self.tick.nearest(way, self.now, [*kept, *((u, 1) for u in self.under)])

    def _reaction(self, part: _Part, chosen: dict[str, int]) -> PossibleStep:
        at = ChosenValues(chosen)
        on = self._on(part, at)
        places = [v.name for v in part.chart.locations]
        after = {part.chart.entered.name: 1, **{n: at.of(self.tick.after(n)) for n in places}}
        states = tuple(".".join(path) for path in innermost(part.chart, after))
        before = tuple(".".join(path) for path in innermost(part.chart, self.state))
        numbers = ",".join(str(n) for n in sorted(part.segments[flag].number for flag in on))
        step = self._step(f"{part.chart.name}:{numbers}", part.chart.name, chosen)
        also = tuple(self._also(part, at, step.changed))
        moves = sorted(states) != sorted(before)
        return replace(step, transitions=part.taken(on), states=states, also=also, moves=moves)

    def _value(self, var: Var, chosen: dict[str, int]) -> PossibleStep:
        raw = evaluate(self.tick.after(var.name), chosen)
        step = self._step(f"{var.name}:{raw}", var.name, chosen)
        return replace(
            step, becomes=(var.name, raw), shown=var.domain.show(raw), moves=raw != self.state[var.name]
        )

    def _step(self, key: str, of: str, chosen: dict[str, int]) -> PossibleStep:
        inputs = {v.name: chosen[v.name] for v in self.system.inputs}
        frozen = {name: raw for name, raw in chosen.items() if name not in inputs}
        changed = tuple(name for name, raw in chosen.items() if raw != self.now[name])
        return PossibleStep(key, of, (), (), inputs, frozen, changed, standing=self._stands and not changed)


def innermost(chart: Chart, at: Mapping[str, int]) -> Iterator[Path]:
    """The innermost active states of a chart, in the order in which they execute."""
    states = [p for p in chart.states if p and evaluate(chart.active_path(p), at)]
    return (p for p in states if not any(q[: len(p)] == p and q != p for q in states))
