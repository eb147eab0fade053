"""Charts that tell which goals a tick reaches, and behave as before.

A transition raises a flag in its transition action, which runs on complete paths only (rule G6).  A boundary
is seen by a probe in front of the transition that is tested: a segment to a junction from which no path leads
on, so that its condition action runs and the path goes back (rule G8).  Interpreter and engines read the same
chart.
"""

from collections.abc import Collection, Container, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import prod

from rovercheck.checker.system.instrument.entries import ChartTransitions, Segment, TransitionGroup
from rovercheck.checker.system.instrument.goals import CoverGoal, GoalKind, Watched
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import (
    Block,
    Chart,
    Component,
    Enabled,
    Junction,
    Path,
    State,
    Transition,
)
from rovercheck.spec_model.lang.domain import Bool, Num, boolean, integer
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, Temporal, Var, When
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.walk import children, nodes, structure, variables

# --- the comparisons and timers that a formula consists of, and when each is at a boundary -------------

COUNTED = (When.AFTER, When.DURATION, When.HELD)
MOST = 4096
"""Combinations of values that are tried to find the nearest beside a boundary; beyond, any value counts."""
CONNECTIVES = (Op.NOT, Op.AND, Op.OR, Op.ITE)


@dataclass(frozen=True)
class AtomSide:
    """A side of a boundary in words, and the condition under which a formula is evaluated there."""

    text: str
    condition: Expr


def sides(expr: Expr, step_ms: int) -> Iterator[AtomSide]:
    """Every side of every comparison and timer in a formula; equal ones once."""
    seen: set[tuple[object, ...]] = set()
    for atom in _atoms(expr):
        key = structure(atom)
        if key not in seen:
            seen.add(key)
            yield from _sides(atom, step_ms)


def _atoms(expr: Expr) -> Iterator[Expr]:
    """The conditions in a formula that no connective builds, inside arithmetic and timers too."""
    match expr:
        case Apply(op, _, Bool()) if op not in CONNECTIVES:
            yield expr
        case Var(_, domain) if isinstance(domain.sort, Bool):
            yield expr
        case Temporal():
            yield expr
    for child in children(expr):
        inside = _truth_of_a_datum(expr, child)
        yield from () if inside else _atoms(child)


def _truth_of_a_datum(expr: Expr, child: Expr) -> bool:
    """Whether the child is a truth value whose comparison already is the condition."""
    return isinstance(expr, Apply) and expr.op in COMPARISONS and isinstance(child, Var)


def _sides(atom: Expr, step_ms: int) -> Iterator[AtomSide]:
    match atom:
        case Temporal(when, _, span) if when in COUNTED and span is not None:
            yield from _timer(atom, step_ms)
        case Apply(op, (left, right), _) if op in COMPARISONS and isinstance(left.sort, Num):
            yield from _numbers(atom, left, right)
        case _:
            yield AtomSide(f"{text(atom)} true", atom)
            yield AtomSide(f"{text(atom)} false", ~atom)


def _timer(word: Temporal, step_ms: int) -> Iterator[AtomSide]:
    """The step before a timer runs out, the step in which it does, and the one after."""
    assert word.span is not None
    last = word.span.ticks(step_ms) + (1 if word.when is When.DURATION and word.strict else 0)
    for count, said in ((last - 1, "one step early"), (last, "just run out"), (last + 1, "one step late")):
        exactly = _at_least(word, count) & ~_at_least(word, count + 1)
        yield AtomSide(f"{text(word)} {said}", exactly)


def _at_least(word: Temporal, count: int) -> Expr:
    """The condition that the timer has counted so far."""
    always = count < 0 if word.when is When.HELD else count <= 0
    return TRUE if always else replace(word, span=count * ticks, strict=False)


def _numbers(atom: Expr, left: Expr, right: Expr) -> Iterator[AtomSide]:
    """The nearest difference of two numbers below zero, none, and the nearest above."""
    assert isinstance(left.sort, Num)
    difference = Apply(Op.SUB, (left, right), left.sort)
    below, above = _nearest(difference)

    def compared(op: Op, value: int) -> Expr:
        return Apply(op, (difference, Const(value, difference.sort)), Bool())

    low = TRUE if below is None else compared(Op.GE, below)
    high = TRUE if above is None else compared(Op.LE, above)
    yield AtomSide(f"{text(atom)} just below", compared(Op.LT, 0) & low)
    yield AtomSide(f"{text(atom)} at it", compared(Op.EQ, 0))
    yield AtomSide(f"{text(atom)} just above", compared(Op.GT, 0) & high)


def _nearest(difference: Expr) -> tuple[int | None, int | None]:
    """The largest negative and the least positive value, or None: none, or too many combinations to try."""
    data = variables(difference)
    if prod(len(v.domain) for v in data.values()) > MOST:
        return None, None
    combinations = product(*(v.domain.values for v in data.values()))
    found = {evaluate(difference, dict(zip(data, values, strict=True))) for values in combinations}
    return max((v for v in found if v < 0), default=None), min((v for v in found if v > 0), default=None)


EVERY = tuple(GoalKind)


def watched(
    system: System, kinds: Collection[GoalKind] = EVERY, only: Container[str] | None = None
) -> Watched:
    """The system with flags for every goal of some kinds, or ``only`` for goals of some ids."""
    goals: list[CoverGoal] = []
    wanted = _Wanted(frozenset(kinds), only, system.step_ms, goals)
    components = tuple(_component(c, wanted) for c in system.components)
    reset = Block("goals not reached", [Assign(goal.flag, FALSE) for goal in goals])
    return Watched(replace(system, components=(reset, *components)), tuple(goals))


@dataclass(frozen=True)
class _Wanted:
    """Which goals are wanted, and those found so far."""

    kinds: frozenset[GoalKind]
    only: Container[str] | None
    step_ms: int
    found: list[CoverGoal]


def _component(component: Component, wanted: _Wanted) -> Component:
    match component:
        case Enabled(by=by, components=inside, name=name):
            return Enabled(by, *(_component(c, wanted) for c in inside), name=name)
        case Block():
            goals = _Goals(component.name, wanted)
            return Block(component.name, goals.actions(component.do, component.name), text=component.text)
        case Chart():
            return _Chart(component, _Goals(component.name, wanted)).watched()


class _Goals:
    """The goals of one part, numbered by kind as they are met."""

    def __init__(self, part: str, wanted: _Wanted) -> None:
        self._part = part
        self._wanted = wanted
        self._boundaries = 0

    def goal(self, kind: GoalKind, number: str, text: str) -> tuple[Action, ...]:
        """A goal as the action that raises its flag; none for one that is not wanted."""
        id, wanted = f"{self._part}.{kind.in_id}.{number}", self._wanted
        if kind not in wanted.kinds or not (wanted.only is None or id in wanted.only):
            return ()
        flag = Var(f"goal {id}", boolean, 0, text, hidden=True)
        wanted.found.append(CoverGoal(id, kind, self._part, text, flag))
        return (Assign(flag, TRUE),)

    def wants(self, kind: GoalKind) -> bool:
        return kind in self._wanted.kinds

    def boundaries(self, expr: Expr | None, where: str) -> Iterator[tuple[AtomSide, tuple[Action, ...]]]:
        """A goal for each side of each boundary in a formula."""
        if expr is None or not self.wants(GoalKind.BOUNDARIES):
            return
        for side in sides(expr, self._wanted.step_ms):
            self._boundaries += 1
            raised = self.goal(GoalKind.BOUNDARIES, str(self._boundaries), f"{side.text}, in {where}")
            if raised:
                yield side, raised

    def actions(self, actions: Sequence[Action], where: str) -> tuple[Action, ...]:
        """Actions, each after a look at the boundaries in it."""
        out: list[Action] = []
        for action in actions:
            match action:
                case Assign(_, value):
                    out += self._looks(value, where)
                case If(condition, then, otherwise):
                    out += self._looks(condition, where)
                    action = If(condition, self.actions(then, where), self.actions(otherwise, where))
            out.append(action)
        return tuple(out)

    def _looks(self, expr: Expr, where: str) -> list[Action]:
        return [If(side.condition, raised) for side, raised in self.boundaries(expr, where)]


class _Chart:
    """One chart being rewritten."""

    def __init__(self, chart: Chart, goals: _Goals) -> None:
        self._chart = chart
        self._goals = goals
        self._transitions = ChartTransitions(chart)
        self._ends: list[Junction] = []

    def watched(self) -> Chart:
        root = self._state((), self._chart.root)
        return Chart(
            self._chart.name, root.states, default=root.default, parallel=root.parallel,
            junctions=(*root.junctions, *self._ends), text=self._chart.text, local_to=self._chart.local_to,
        )  # fmt: skip

    def _state(self, path: Path, state: State) -> State:
        at = ".".join(path)
        return State(
            state.name,
            entry=self._goals.actions(state.entry, f"the entry of {at}"),
            during=self._goals.actions(state.during, f"the during of {at}"),
            exit=self._goals.actions(state.exit, f"the exit of {at}"),
            states=[self._state((*path, child.name), child) for child in state.states],
            transitions=self._group(TransitionGroup(path)),
            junctions=[
                Junction(j.name, self._group(TransitionGroup((*path, j.name)))) for j in state.junctions
            ],
            default=self._group(TransitionGroup(path, True)),
            parallel=state.parallel,
        )

    def _group(self, group: TransitionGroup) -> list[Transition]:
        return [
            t for s in self._transitions.by_group.get(group, ()) for t in (*self._probes(s), self._taken(s))
        ]

    def _probes(self, segment: Segment) -> Iterator[Transition]:
        """What looks at the boundaries of a guard just before it is tested."""
        found = list(self._goals.boundaries(segment.drawn.guard, segment.text))
        if found:
            end = self._dead_end(segment)
            event = segment.drawn.event
            plain = tuple(If(side.condition, raised) for side, raised in found if not _counts(side.condition))
            timed = [(side, raised) for side, raised in found if _counts(side.condition)]
            yield from [Transition(end, None, event, plain)] if plain else []
            yield from (Transition(end, side.condition, event, raised) for side, raised in timed)

    def _dead_end(self, segment: Segment) -> str:
        """A junction whose only transition, never valid, goes where the segment goes: it adds no path."""
        name, goal = f"looked at {segment.number}", self._transitions.target(segment)
        while goal in self._chart.junctions:
            goal = self._transitions.target(self._transitions.by_group[TransitionGroup(goal)][0])
        self._ends.append(Junction(name, [Transition(".".join(goal), FALSE)]))
        return name

    def _taken(self, segment: Segment) -> Transition:
        drawn, goals = segment.drawn, self._goals
        raised = goals.goal(GoalKind.TRANSITIONS, str(segment.number), segment.text)
        return replace(
            drawn,
            do=goals.actions(drawn.do, segment.text),
            then=(
                *goals.actions(drawn.then, segment.text),
                *raised,
                *self._follows(segment),
                *self._entered(segment),
            ),
        )

    # --- pairs: which transition entered the state that another one leaves ---

    def _follows(self, segment: Segment) -> Iterator[Action]:
        state = segment.group.owner
        if segment.group.default or state not in self._transitions.entering:
            return
        for before in self._transitions.entering[state]:
            text = f"{before.text}, then {segment.text}"
            raised = self._goals.goal(GoalKind.PAIRS, f"{before.number}-{segment.number}", text)
            if raised:
                yield If(_is(self._memory(state), before.number), raised)

    def _entered(self, segment: Segment) -> Iterator[Action]:
        if not self._goals.wants(GoalKind.PAIRS):
            return
        for state, entering in self._transitions.entering.items():
            if segment in entering:
                memory = self._memory(state)
                note = Assign(memory, Const(segment.number, memory.sort))
                sure = self._transitions.enters(segment, state)
                yield note if sure else If(self._chart.active_path(state), (), (note,))

    def _memory(self, state: Path) -> Var:
        name = ".".join((self._chart.name, *state))
        domain = integer(0, len(self._transitions.segments))
        return Var(
            f"arrow into {name}", domain, 0, f"the transition by which {name} was entered", hidden=True
        )


def _counts(condition: Expr) -> bool:
    """Whether the condition asks for a time since a state was entered, as only a guard may."""
    return any(isinstance(n, Temporal) and n.when in COUNTED for n in nodes(condition))


def _is(memory: Var, number: int) -> Expr:
    return memory == number
