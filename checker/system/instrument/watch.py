"""Charts that tell which goals a tick reaches, and behave as before.

A transition raises a flag in its transition action, which runs on complete paths only (rule G6).  A side of
a condition is seen by a probe in front of the transition that is tested: a segment to a junction from which
no path leads on, so that its condition action runs and the path goes back (rule G8).  Interpreter and engines
read the same chart.
"""

from collections import Counter
from collections.abc import Collection, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.system.instrument.entries import ChartTransitions, Segment, TransitionGroup
from rovercheck.checker.system.instrument.goals import KEPT, CoverGoal, GoalKind, Watched
from rovercheck.checker.system.instrument.sides import COUNTED, AtomSide, deciding_sides, sides
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
from rovercheck.spec_model.lang.domain import boolean, integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Temporal, Var
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import Program, Statement, System
from rovercheck.spec_model.lang.walk import nodes


def watched(
    system: System, kinds: Collection[GoalKind] = KEPT, only: Container[str] | None = None
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
        case ProgrammedChart():
            return _programmed(component, wanted)
        case Chart():
            return WatchedChart(component, _Goals(component.name, wanted)).watched()


_SIDES = {GoalKind.BOUNDARIES: sides, GoalKind.CONDITIONS: deciding_sides}


class _Goals:
    """The goals of one part, numbered by kind as they are met."""

    def __init__(self, part: str, wanted: _Wanted) -> None:
        self._part = part
        self._wanted = wanted
        self._numbers = Counter[GoalKind]()

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

    def sides(self, expr: Expr | None, where: str) -> Iterator[tuple[AtomSide, tuple[Action, ...]]]:
        """A goal for each side of each boundary in a formula, and for each side on which it decides."""
        for kind, found in _SIDES.items():
            if expr is None or not self.wants(kind):
                continue
            for side in found(expr, self._wanted.step_ms):
                self._numbers[kind] += 1
                raised = self.goal(kind, str(self._numbers[kind]), f"{side.text}, in {where}")
                if raised:
                    yield side, raised

    def actions(self, actions: Sequence[Action], where: str) -> tuple[Action, ...]:
        """Actions, each after a look at the conditions in it."""
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
        return [If(side.condition, raised) for side, raised in self.sides(expr, where)]


def _programmed(chart: ProgrammedChart, wanted: _Wanted) -> Chart:
    """An imported chart: a goal for each path that it, or a chart that it calls, may take.

    There are none for sides of conditions.
    """
    raised: dict[str, tuple[Action, ...]] = {}
    parts: dict[str, tuple[_Goals, dict[object, tuple[Action, ...]]]] = {}
    for marker, path in chart.program.fired.items():
        goals, known = parts.setdefault(path.chart, (_Goals(path.chart, wanted), {}))
        drawn = (path.source, path.target, path.order, path.label, path.place)  # with whatever event
        if drawn not in known:
            start = ".".join(path.source) if path.order else "default"
            text = f"{start} -> {'.'.join(path.target)}{f' {path.label}' if path.label else ''}"
            known[drawn] = goals.goal(GoalKind.TRANSITIONS, str(len(known) + 1), text)
        raised[marker] = known[drawn]

    return chart.with_program(replace(chart.program, statements=raising(chart.program.statements, raised)))


def raising(statements: Program, raised: Mapping[str, Sequence[Action]]) -> Program:
    """The statements of an imported chart, with assignments before those of some markers."""
    out: list[Statement] = []
    for one in statements:
        if isinstance(one, If):
            then, otherwise = (
                raising(tuple(a for a in part if isinstance(a, Assign | If)), raised)
                for part in (one.then, one.otherwise)
            )
            one = If(one.condition, then, otherwise)
        elif one.var.name in raised:
            out += (a for a in raised[one.var.name] if isinstance(a, Assign))
        out.append(one)
    return tuple(out)


class WatchedChart:
    """One chart being rewritten."""

    def __init__(self, chart: Chart, goals: "_Goals | None" = None) -> None:
        self._chart = chart
        self._goals = goals or _Goals(chart.name, _Wanted(frozenset(), None, 1, []))
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
        """What looks at the conditions of a guard just before it is tested."""
        found = self._looked(segment)
        if found:
            end = self._dead_end(segment)
            event = segment.drawn.event
            plain = tuple(If(condition, raised) for condition, raised in found if not _counts(condition))
            timed = [(condition, raised) for condition, raised in found if _counts(condition)]
            yield from [Transition(end, None, event, plain)] if plain else []
            yield from (Transition(end, condition, event, raised) for condition, raised in timed)

    def _looked(self, segment: Segment) -> list[tuple[Expr, tuple[Action, ...]]]:
        """What is asked where a guard is tested, and what is done where it holds."""
        return [
            (side.condition, raised) for side, raised in self._goals.sides(segment.drawn.guard, segment.text)
        ]

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


__all__ = ["WatchedChart", "raising", "watched"]
