"""One chart being run: which states are active, and how an execution changes that (rules G1 to G11)."""

from collections.abc import Callable, MutableMapping, Sequence
from dataclasses import dataclass
from functools import partial

from rovercheck.spec_model.lang.action import Action, Assign, If, Send
from rovercheck.spec_model.lang.chart import NOWHERE, Chart, Path, State, Transition
from rovercheck.spec_model.lang.domain import Bool, Enum, Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.fired_transition import FiredTransition, path_label
from rovercheck.spec_model.lang.interpret.words import InterpretedWords
from rovercheck.spec_model.lang.programmed import is_fault

Values = MutableMapping[str, int]
Admits = Callable[[Var, int], bool]
"""Whether a variable may hold a raw value."""
ValueOf = Callable[[Expr], int]
"""The value of a part of a guard at the moment it is tested."""
Testing = Callable[[str, Path | None, Transition, bool, ValueOf], None]
"""Told of every transition tested: its chart, the state left (None: a default one), itself, whether valid."""


@dataclass(frozen=True)
class _Route:
    """A complete path: its segments and the state it ends on."""

    segments: tuple[Transition, ...]
    target: Path


class ChartRun:
    """The run of one chart over values shared with the other components.

    ``at`` holds all data; the chart keeps its own location variables there up to date.  ``fired``
    receives every path taken, in order, and ``tested`` is told of every transition tested.
    """

    def __init__(
        self,
        chart: Chart,
        at: Values,
        fired: list[FiredTransition],
        tick_ms: int,
        admits: Admits | None = None,
        tested: Testing | None = None,
        elapsed: Var | None = None,
    ) -> None:
        self.chart = chart
        self._tested = tested
        self._at = at
        self._admits = admits or contains
        self._fired = fired
        self._words = InterpretedWords(chart, tick_ms, elapsed)
        self._active: dict[Path, int] = {}
        self._entries = 0
        self._owners = [(data, {chart.path(o) for o in owners}) for data, owners in chart.local_to]
        self._labels: dict[tuple[int, ...], str] = {}
        self._places = {p: chart.location(p) for p, s in chart.states.items() if s.states and not s.parallel}
        for place in self._places.values():
            at[place.name] = place.init
        at[chart.entered.name] = 0

    def step(self) -> None:
        """One executed step: the first enters the chart, later ones execute it (rules G1, G2)."""
        self._words.start_of_step(self._at)
        if self._at[self.chart.entered.name]:
            self._execute_inside((), None)
        else:
            self._at[self.chart.entered.name] = 1
            self._complete((), None)
        self._words.end_of_step(self._at)

    # --- execution of an active state ---

    def execute(self, path: Path, event: str | None) -> None:
        """Transitions in priority order, else the during action and what is inside (rules G4, G5)."""
        self._words.executed(path, self._at)
        state = self.chart.states[path]
        for order, transition in enumerate(state.transitions, start=1):
            route = self._route([transition], path[:-1], path, event)
            if route is not None:
                self._take(path, route, order, event)
                return
        entry = self._active[path]
        self._run(state.during, event)
        if self._active.get(path) == entry:
            self._execute_inside(path, event)

    def _execute_inside(self, path: Path, event: str | None) -> None:
        """The active child, or each region in order as long as the state has not been left (G3, G4)."""
        state, entry = self.chart.states[path], self._active.get(path)
        children = [(*path, child.name) for child in state.states]
        for child in children if state.parallel else [c for c in children if c in self._active]:
            if child in self._active and self._active.get(path) == entry:
                self.execute(child, event)

    # --- finding a path ---

    def _route(
        self,
        transitions: Sequence[Transition],
        level: Path,
        source: Path | None,
        event: str | None,
        so_far: tuple[Transition, ...] = (),
    ) -> _Route | None:
        """The first complete path; condition actions run as soon as their segment is valid (G6 to G8)."""
        for transition in transitions:
            valid = self._valid(transition, source, event)
            if self._tested is not None:
                self._tested(self.chart.name, source, transition, valid, partial(self._part, source))
            if not valid:
                continue
            self._run(transition.do, event)
            target, segments = self._resolve(level, transition), (*so_far, transition)
            junction = self.chart.junctions.get(target)
            if junction is None:
                return _Route(segments, target)
            onward = self._route(junction.transitions, target[:-1], source, event, segments)
            if onward is not None:
                return onward
        return None

    def _valid(self, transition: Transition, source: Path | None, event: str | None) -> bool:
        if transition.event is not None and transition.event != event:
            return False
        return transition.guard is None or bool(self._words.value(transition.guard, self._at, source))

    def _part(self, source: Path | None, part: Expr) -> int:
        return self._words.part(part, self._at, source)

    def _resolve(self, level: Path, transition: Transition) -> Path:
        target = self.chart.resolve(level, transition.target)
        if target is None:
            raise ModelError(
                f"{self.chart.name}: a transition goes to {transition.target!r}, which is no state."
            )
        return target

    # --- taking it ---

    def _take(self, source: Path, route: _Route, order: int, event: str | None) -> None:
        """Exit inside out, run transition actions, enter outside in (rule G9)."""
        self._record(source, route, order, event)
        scope = self._scope(source, route.target)
        self._leave(source[: len(scope) + 1], event)
        self._transition_actions(route, event)
        self._enter(scope, route.target, event)

    def _scope(self, source: Path, target: Path) -> Path:
        """The innermost composite with both ends inside it, so that a self-loop leaves its state."""
        inside = min(len(source), len(target)) - 1
        while source[:inside] != target[:inside]:
            inside -= 1
        return source[:inside]

    def _transition_actions(self, route: _Route, event: str | None) -> None:
        for segment in route.segments:
            self._run(segment.then, event)

    def _record(self, source: Path, route: _Route, order: int, event: str | None) -> None:
        key = tuple(map(id, route.segments))
        label = self._labels.get(key)
        if label is None:
            label = self._labels[key] = path_label(route.segments)
        place = route.segments[0].place
        self._fired.append(FiredTransition(self.chart.name, source, route.target, label, order, event, place))

    def _leave(self, path: Path, event: str | None) -> None:
        """Leave an active state and everything active in it; regions in reverse order."""
        state = self.chart.states[path]
        for child in reversed(state.states):
            if (*path, child.name) in self._active:
                self._leave((*path, child.name), event)
        self._run(state.exit, event)
        del self._active[path]
        self._words.left(path)
        self._locate(path[:-1], NOWHERE)
        self._forget(path)

    def _forget(self, left: Path) -> None:
        """Data local to states none of which is active any more return to their initial value."""
        for data, owners in self._owners:
            if left in owners and not owners & self._active.keys():
                self._at[data.name] = data.init

    def _enter(self, scope: Path, target: Path, event: str | None) -> None:
        """Enter what lies below ``scope`` on the way to ``target``, then what the target needs."""
        if scope == target:
            self._complete(target, event)
            return
        onward = target[: len(scope) + 1]
        for child in self._entered_together(scope, onward):
            self._activate(child, event)
            self._enter(child, target if child == onward else child, event)

    def _entered_together(self, scope: Path, child: Path) -> list[Path]:
        """The child, with its sibling regions if it is one."""
        state = self.chart.states[scope]
        return [(*scope, region.name) for region in state.states] if state.parallel else [child]

    def _complete(self, path: Path, event: str | None) -> None:
        """Enter all regions in order, or follow the default transition (rules G2, G9)."""
        state = self.chart.states[path]
        if state.parallel:
            for region in state.states:
                self._activate((*path, region.name), event)
                self._complete((*path, region.name), event)
        elif state.states:
            self._follow_default(path, state, event)

    def _follow_default(self, path: Path, state: State, event: str | None) -> None:
        route = self._route(state.default, path, None, event)
        if route is None:
            where = ".".join((self.chart.name, *path))
            raise ModelError(
                f"{self.chart.name}: no default transition of {where} is valid when it is entered; "
                "end them with one that has no guard."
            )
        self._record((), route, 0, event)
        self._transition_actions(route, event)
        self._enter(path, route.target, event)

    def _activate(self, path: Path, event: str | None) -> None:
        self._entries += 1
        self._active[path] = self._entries
        self._words.entered(path)
        self._locate(path[:-1], path[-1])
        self._run(self.chart.states[path].entry, event)

    def _locate(self, composite: Path, child: str) -> None:
        place = self._places.get(composite)
        if place is not None:
            self._at[place.name] = place.domain.raw(child)

    # --- actions ---

    def _run(self, actions: Sequence[Action], event: str | None) -> None:
        """Actions in order; a send executes its receiver at once if that is active (rules G10, G11)."""
        for action in actions:
            match action:
                case Assign(data, value):
                    store(self._at, self.chart.name, data, self._words.value(value, self._at), self._admits)
                case If(condition, then, otherwise):
                    chosen = then if self._words.value(condition, self._at) else otherwise
                    self._run(chosen, event)
                case Send(sent, receiver):
                    path = self.chart.path(receiver)
                    if path in self._active:
                        self.execute(path, sent)


def contains(data: Var, raw: int) -> bool:
    """Whether the value is one of the domain."""
    return raw in data.domain.values


def within(data: Var, raw: int) -> bool:
    """Whether a number lies less than a step of the domain beyond its ends; others must be of the domain.

    The last grid point of an angle below 180 degrees is 177.5, and measured angles lie above it too.
    """
    domain = data.domain
    if isinstance(domain.sort, Num):
        return domain.values[0] - 1 < raw < domain.values[-1] + 1
    return raw in domain.values


def store(at: Values, writer: str, data: Var, raw: int, admits: Admits = contains) -> None:
    """Assign a raw value.  Raises ``ModelError`` outside the variable's domain, and for a fault."""
    if is_fault(data):
        raise ModelError(f"{writer}: {data.doc}.")
    if not admits(data, raw):
        known = isinstance(data.sort, Bool | Enum)
        shown = str(raw) if known else data.domain.show(raw)
        raise ModelError(
            f"{writer}: {data.name} := {shown} leaves its domain, {data.domain}; "
            "widen the domain or limit the value with minimum() and maximum()."
        )
    at[data.name] = raw
