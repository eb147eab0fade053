"""Control flow of a chart as a structured program: rules G2 to G12, nested executions inlined."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from spec_model.lang.action import Action, Assign, If, Send
from spec_model.lang.chart import NOWHERE, Chart, Path, Transition
from spec_model.lang.domain import boolean
from spec_model.lang.expr import FALSE, TRUE, Const, Var, any_of
from spec_model.lang.lower.ranges import guarded
from spec_model.lang.lower.timers import Timers
from spec_model.lang.system import Statement

Statements = list[Statement]


@dataclass(frozen=True)
class Way:
    """A path being followed: from a source state, or (default) into a composite.

    ``then`` collects transition actions; ``done`` are the flags to raise on completion, one for each
    enclosing point of backtracking.
    """

    source: Path | None = None
    event: str | None = None
    composite: Path = ()
    then: tuple[Action, ...] = ()
    done: tuple[Var, ...] = ()


class Flow:
    """One chart being lowered."""

    def __init__(self, chart: Chart, tick_ms: int) -> None:
        self.chart = chart
        self.timers = Timers(chart, tick_ms)
        self.flags: list[Var] = []
        self._executions: dict[tuple[Path, str | None], tuple[Statement, ...]] = {}

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
        key = (path, event)
        if key not in self._executions:
            state = self.chart.states[path]
            body = self._body(path, event)
            arrows = self.attempt(state.transitions, path[:-1], Way(path, event), lambda: body)
            self._executions[key] = (*self.timers.on_execution(path), *arrows)
        return self._executions[key]

    def _body(self, path: Path, event: str | None) -> Statements:
        state = self.chart.states[path]
        during = self.actions(state.during)
        if not state.states:
            return during
        if state.parallel:
            regions = [s for child in state.states for s in self.execute((*path, child.name), event)]
            return during + regions
        return during + self._active_child(path, lambda child: list(self.execute(child, event)))

    def _active_child(self, path: Path, act: Callable[[Path], Statements]) -> Statements:
        """Do something to the active child of an exclusive composite."""
        switch: Statements = []
        for child in reversed(self.chart.states[path].states):
            there = (*path, child.name)
            inside = act(there)
            if inside or switch:
                switch = [If(self.chart.active_path(there), tuple(inside), tuple(switch))]
        return switch

    # --- arrows (G5 to G8) ---

    def attempt(
        self, segments: Sequence[Transition], level: Path, way: Way, otherwise: Callable[[], Statements]
    ) -> Statements:
        """Test segments drawn at ``level`` in order; ``otherwise`` runs if none completes a path."""
        if not segments:
            return otherwise()
        segment, rest = segments[0], segments[1:]
        if segment.event is not None and segment.event != way.event:
            return self.attempt(rest, level, way, otherwise)
        guard = None if segment.guard is None else self.timers.plainly(segment.guard, way.source)
        if self._always_completes(level, segment, way.event):
            inside = self._follow(segment, level, way)
            if guard is None:
                return inside
            return [If(guard, tuple(inside), tuple(self.attempt(rest, level, way, otherwise)))]
        flag = self._flag()
        inside = self._follow(segment, level, replace(way, done=(*way.done, flag)))
        tried: Statements = inside if guard is None else [If(guard, tuple(inside))]
        remaining = self.attempt(rest, level, way, otherwise)
        return [Assign(flag, FALSE), *tried, If(flag, (), tuple(remaining))]

    def _follow(self, segment: Transition, level: Path, way: Way) -> Statements:
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

    def take(self, way: Way, target: Path) -> Statements:
        """Exit, run transition actions, enter."""
        if way.source is None:
            return self.actions(way.then) + self.enter(way.composite, target)
        scope = common_composite(way.source, target)
        left = way.source[: len(scope) + 1]
        return self.leave(left) + self.actions(way.then) + self.enter(scope, target)

    def leave(self, path: Path) -> Statements:
        """Exit the active state at ``path`` and everything active in it, innermost first."""
        state = self.chart.states[path]
        inside: Statements = []
        if state.parallel:
            for child in reversed(state.states):
                inside += self.leave((*path, child.name))
        elif state.states:
            inside = self._active_child(path, self.leave)
        parent = path[:-1]
        out = inside + self.actions(state.exit) + self.timers.on_exit(path)
        if not self.chart.states[parent].parallel:
            out.append(self._locate(parent, NOWHERE))
        return out + self._forget(path)

    def _forget(self, path: Path) -> Statements:
        """Data local to the state that was left return to their initial values."""
        out: Statements = []
        for data, owners in self.chart.local_to:
            paths = [self.chart.path(o) for o in owners]
            if path in paths:
                reset = Assign(data, Const(data.init, data.sort))
                others = [self.chart.active_path(p) for p in paths if p[:-1] != path[:-1]]
                out.append(If(any_of(*others), (), (reset,)) if others else reset)
        return out

    def enter(self, scope: Path, target: Path) -> Statements:
        """Enter the states below ``scope`` down to ``target``, then complete the target."""
        if scope == target:
            return self.complete(target)
        below = target[: len(scope) + 1]
        if not self.chart.states[scope].parallel:
            return self._activate(below) + self.enter(below, target)
        out: Statements = []
        for child in self.chart.states[scope].states:
            region = (*scope, child.name)
            onward = self.enter(region, target) if region == below else self.complete(region)
            out += self._activate(region) + onward
        return out

    def complete(self, path: Path) -> Statements:
        """Enter the default child of an exclusive composite, or all regions of a parallel one."""
        state = self.chart.states[path]
        if state.parallel:
            regions = [(*path, child.name) for child in state.states]
            return [s for r in regions for s in self._activate(r) + self.complete(r)]
        return self.attempt(state.default, path, Way(composite=path), lambda: [])

    def _activate(self, path: Path) -> Statements:
        parent = path[:-1]
        place: Statements = [] if self.chart.states[parent].parallel else [self._locate(parent, path[-1])]
        return place + self.actions(self.chart.states[path].entry)

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
                    out.append(If(self.chart.active_path(path), self.execute(path, event)))
        return out


def common_composite(source: Path, target: Path) -> Path:
    """The innermost composite that properly contains both ends of an arrow."""
    depth = 0
    while depth < min(len(source), len(target)) - 1 and source[depth] == target[depth]:
        depth += 1
    return source[:depth]


