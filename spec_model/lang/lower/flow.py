"""Control flow of a chart as a structured program: rules G2 to G12, nested executions inlined."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from rovercheck.spec_model.lang.action import Action, Assign, If, Send
from rovercheck.spec_model.lang.chart import NOWHERE, Chart, Path, Transition
from rovercheck.spec_model.lang.domain import Bool, boolean
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, Var, any_of
from rovercheck.spec_model.lang.lower.ranges import guarded
from rovercheck.spec_model.lang.lower.timers import ChartTimers
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Statement

Statements = list[Statement]

FEW = 8
"""States, or transitions, that are distinguished one after the other; more are halved first, so that a step
is never nested as deep as a level has states."""


@dataclass(frozen=True)
class FlowWay:
    """A path being followed: from a source state, or (default) into a composite.

    ``then`` collects transition actions; ``done`` are the flags to raise on completion, one for each
    enclosing point of backtracking.
    """

    source: Path | None = None
    event: str | None = None
    composite: Path = ()
    then: tuple[Action, ...] = ()
    done: tuple[Var, ...] = ()


class ChartFlow:
    """One chart being lowered."""

    def __init__(self, chart: Chart, tick_ms: int, elapsed: Var | None = None) -> None:
        self.chart = chart
        self.timers = ChartTimers(chart, tick_ms, elapsed)
        self.flags: list[Var] = []
        self._executions: dict[object, tuple[Statement, ...]] = {}
        self._absent: frozenset[Path] = frozenset()
        self._left: dict[Path, Var] = {}

    def step(self) -> Statements:
        """One executed step of the chart (rules G1, G2)."""
        later = [*self.timers.at_start_entered(), *self.execute((), None)]
        first: Statements = []
        if self.chart.root.parallel:
            first.append(Assign(self.chart.entered, Const(1, self.chart.entered.sort)))
        first += self.complete(())
        middle = If(self.chart.active_path(()), tuple(later), tuple(first))
        return [*self.timers.at_start(), middle, *self.timers.at_end()]

    # --- execution of an active state (G4) ---

    def execute(self, path: Path, event: str | None) -> tuple[Statement, ...]:
        """Execute the active state at ``path``; ``event`` is the local event being processed."""
        key = (path, event, self._absent)
        if key not in self._executions:
            state = self.chart.states[path]
            body = self._body(path, event)
            transitions = self.attempt(state.transitions, path[:-1], FlowWay(path, event), lambda: body)
            self._executions[key] = (*self.timers.on_execution(path), *transitions)
        return self._executions[key]

    def _body(self, path: Path, event: str | None) -> Statements:
        state = self.chart.states[path]
        during = self.actions(state.during)
        if not state.states:
            return during
        if state.parallel:
            return during + self._regions(path, event)
        return during + self._active_child(path, lambda child: list(self.execute(child, event)))

    def _regions(self, path: Path, event: str | None) -> Statements:
        """The regions in order (G3); those after one whose transition leaves the composite do not execute."""
        regions = [list(self.execute(region, event)) for region in self._children(path)]
        if path not in self._left:
            return [s for region in regions for s in region]
        left = self._left[path]
        out = regions[-1]
        for region in reversed(regions[:-1]):
            out = [*region, If(left, (), tuple(out))]
        return [Assign(left, FALSE), *out]

    def _children(self, path: Path) -> list[Path]:
        return [(*path, child.name) for child in self.chart.states[path].states]

    def _active_child(self, path: Path, act: Callable[[Path], Statements]) -> Statements:
        """Do something to the active child of an exclusive composite."""
        done = [(child, act(child)) for child in reversed(self._children(path))]
        return self._switch(path, done[::-1])

    def _switch(self, path: Path, done: Sequence[tuple[Path, Statements]]) -> Statements:
        """What is done to the child that is active, of some that follow each other."""
        if len(done) > FEW:
            half, place = len(done) // 2, self.chart.location(path)
            last = Const(place.domain.raw(done[half - 1][0][-1]), place.sort)
            one, other = (tuple(self._switch(path, part)) for part in (done[:half], done[half:]))
            return [If(Apply(Op.LE, (place, last), Bool()), one, other)] if one or other else []
        switch: Statements = []
        for child, inside in reversed(done):
            if inside or switch:
                switch = [If(self.chart.active_path(child), tuple(inside), tuple(switch))]
        return switch

    # --- transitions (G5 to G8) ---

    def attempt(
        self, segments: Sequence[Transition], level: Path, way: FlowWay, otherwise: Callable[[], Statements]
    ) -> Statements:
        """Test segments drawn at ``level`` in order; ``otherwise`` runs if none completes a path."""
        tried: list[_Tried] = []
        for segment in segments:
            if segment.event is not None and segment.event != way.event:
                continue
            guard = None if segment.guard is None else self.timers.plainly(segment.guard, way.source)
            if self._always_completes(level, segment, way.event):
                inside = self._follow(segment, level, way)
                if guard is None:
                    return _in_order(tried, inside)
                tried.append((guard, inside, None))
            else:
                flag = self._flag()
                tried.append(
                    (guard, self._follow(segment, level, replace(way, done=(*way.done, flag))), flag)
                )
        return _in_order(tried, otherwise())

    def _follow(self, segment: Transition, level: Path, way: FlowWay) -> Statements:
        """What happens once a segment has been found valid."""
        target = self.chart.resolve(level, segment.target)
        assert target is not None
        acts = self.actions(segment.do)
        onward = replace(way, then=(*way.then, *segment.then))
        if target in self.chart.junctions:
            segments = self.chart.junctions[target].transitions
            return acts + self.attempt(segments, target[:-1], onward, lambda: [])
        return acts + self.take(onward, target) + [Assign(flag, TRUE) for flag in way.done]

    def _always_completes(self, level: Path, segment: Transition, event: str | None) -> bool:
        """Whether a path is sure to be completed once the segment has been found valid."""
        target = self.chart.resolve(level, segment.target)
        if target not in self.chart.junctions:
            return True
        return any(
            t.guard is None and t.event in (None, event) and self._always_completes(target[:-1], t, event)
            for t in self.chart.junctions[target].transitions
        )

    def _flag(self) -> Var:
        flag = Var(f"{self.chart.name}.taken{len(self.flags) + 1}", boolean)
        self.flags.append(flag)
        return flag

    # --- taking a path (G9) ---

    def take(self, way: FlowWay, target: Path) -> Statements:
        """Exit, run transition actions, enter."""
        if way.source is None:
            return self.actions(way.then) + self.enter(way.composite, target)
        scope = common_composite(way.source, target)
        left = way.source[: len(scope) + 1]
        gone: Statements = [Assign(flag, TRUE) for flag in self._composites_left(way.source, scope)]
        return self.leave(left) + self.actions(way.then) + self.enter(scope, target) + gone

    def _composites_left(self, source: Path, scope: Path) -> list[Var]:
        """A flag for each parallel composite that a transition from inside one of its regions leaves."""
        found = [source[:depth] for depth in range(len(scope) + 1, len(source))]
        return [self._left_flag(path) for path in found if self.chart.states[path].parallel]

    def _left_flag(self, path: Path) -> Var:
        if path not in self._left:
            self._left[path] = self._flag()
        return self._left[path]

    def leave(self, path: Path) -> Statements:
        """Exit the active state at ``path`` and everything active in it, innermost first."""
        state, before = self.chart.states[path], self._absent
        inside: Statements = []
        if state.parallel:
            for region in reversed(self._children(path)):
                inside += self.leave(region)
                self._absent |= {region}
        elif state.states:
            inside = self._active_child(path, self.leave)
        parent = path[:-1]
        out = inside + self.actions(state.exit) + self.timers.on_exit(path)
        if not self.chart.states[parent].parallel:
            out.append(self._locate(parent, NOWHERE))
        out += self._forget(path)
        self._absent = before
        return out

    def _forget(self, path: Path) -> Statements:
        """Data local to the state that was left return to their initial values."""
        out: Statements = []
        exclusive = not self.chart.states[path[:-1]].parallel
        for data, owners in self.chart.local_to:
            paths = [self.chart.path(o) for o in owners]
            if path in paths:
                reset = Assign(data, Const(data.init, data.sort))
                siblings = [p for p in paths if exclusive and p[:-1] == path[:-1]]
                others = [p for p in paths if p != path and p not in siblings and not self._is_absent(p)]
                still = any_of(*(self.chart.active_path(p) for p in others))
                out.append(If(still, (), (reset,)) if others else reset)
        return out

    def _is_absent(self, path: Path) -> bool:
        """Whether a region that the state is in, or is, has not been entered yet or has been left already."""
        return any(path[: len(region)] == region for region in self._absent)

    def enter(self, scope: Path, target: Path) -> Statements:
        """Enter the states below ``scope`` down to ``target``, then complete the target."""
        if scope == target:
            return self.complete(target)
        below = target[: len(scope) + 1]
        if not self.chart.states[scope].parallel:
            return self._activate(below) + self.enter(below, target)
        return self._in_turn(
            scope, lambda region: self.enter(region, target) if region == below else self.complete(region)
        )

    def _in_turn(self, path: Path, onward: Callable[[Path], Statements]) -> Statements:
        """Enter the regions of a parallel composite; those not entered yet receive no event."""
        regions, before = self._children(path), self._absent
        out: Statements = []
        for number, region in enumerate(regions, start=1):
            self._absent = before | {*regions[number:]}
            out += self._activate(region) + onward(region)
        self._absent = before
        return out

    def complete(self, path: Path) -> Statements:
        """Enter the default child of an exclusive composite, or all regions of a parallel one."""
        state = self.chart.states[path]
        if state.parallel:
            return self._in_turn(path, self.complete)
        return self.attempt(state.default, path, FlowWay(composite=path), lambda: [])

    def _activate(self, path: Path) -> Statements:
        parent, state, before = path[:-1], self.chart.states[path], self._absent
        place: Statements = [] if self.chart.states[parent].parallel else [self._locate(parent, path[-1])]
        self._absent = before | {*(self._children(path) if state.parallel else [])}
        entry = self.actions(state.entry)
        self._absent = before
        return place + entry

    def _locate(self, composite: Path, child: str) -> Assign:
        place = self.chart.location(composite)
        return Assign(place, Const(place.domain.raw(child), place.sort))

    # --- actions (G10, G11) ---

    def actions(self, actions: Sequence[Action]) -> Statements:
        """Actions without sends and temporal words; a send becomes the receiver's execution."""
        out: Statements = []
        for action in actions:
            match action:
                case Assign(var, value):
                    out.append(guarded(Assign(var, self.timers.plainly(value))))
                case If(condition, then, otherwise):
                    test = self.timers.plainly(condition)
                    out.append(If(test, tuple(self.actions(then)), tuple(self.actions(otherwise))))
                case Send(event, receiver):
                    path = self.chart.path(receiver)
                    if not self._is_absent(path):
                        out.append(If(self.chart.active_path(path), self.execute(path, event)))
        return out


_Tried = tuple[Expr | None, Statements, Var | None]
"""The guard of a segment, what happens where it holds, and a flag for whether that completed a path.

None for the guard: it always holds; for the flag: a path is then always completed.
"""


def _in_order(tried: Sequence[_Tried], rest: Statements) -> Statements:
    """What the first segment that completes a path does, ``rest`` where none does."""
    out, sure = rest, list[tuple[Expr, Statements]]()
    for guard, inside, flag in reversed(tried):
        if guard is not None and flag is None:
            sure.append((guard, inside))
            continue
        out, sure = _first(sure[::-1], out), []
        attempted = inside if guard is None else [If(guard, tuple(inside))]
        assert flag is not None
        out = [Assign(flag, FALSE), *attempted, If(flag, (), tuple(out))]
    return _first(sure[::-1], out)


def _first(sure: Sequence[tuple[Expr, Statements]], rest: Statements) -> Statements:
    """What belongs to the first guard that holds, ``rest`` where none does."""
    if len(sure) > FEW:
        half = len(sure) // 2
        some = any_of(*(guard for guard, _ in sure[:half]))
        return [If(some, tuple(_first(sure[:half], [])), tuple(_first(sure[half:], rest)))]
    for guard, inside in reversed(sure):
        rest = [If(guard, tuple(inside), tuple(rest))]
    return rest


def common_composite(source: Path, target: Path) -> Path:
    """The innermost composite that properly contains both ends of a transition."""
    depth = 0
    while depth < min(len(source), len(target)) - 1 and source[depth] == target[depth]:
        depth += 1
    return source[:depth]
