"""A chart at work, as Stateflow executes it: searching paths, leaving and entering states, sending events.

The rules are those of the user's guide of Stateflow, in the order in which it gives them.
"""

from collections.abc import Mapping, Sequence
from contextlib import suppress

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.labels import SectionKind
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage, Applied, Expression, Member, Name
from rovercheck.checker.drawn.interpret.activity import activity
from rovercheck.checker.drawn.interpret.chart_functions import END, ChartFunctions, Found
from rovercheck.checker.drawn.interpret.clock import ChartClock
from rovercheck.checker.drawn.interpret.evaluate import CallFrame, Dropped
from rovercheck.checker.drawn.interpret.memory import ChartMemory, FreeValues, SharedCell, TypeTable
from rovercheck.checker.drawn.interpret.names import names_in, state_of
from rovercheck.checker.drawn.interpret.output_events import OutputEvents
from rovercheck.checker.drawn.interpret.scope import chain_to, scope_of
from rovercheck.checker.drawn.interpret.statements import StatementRunner
from rovercheck.checker.drawn.interpret.values import MatlabValue, NumberRules, Scalar, logical
from rovercheck.checker.drawn.parsed import (
    ParsedChart,
    StateNode,
    TransitionNode,
)

MOST_SEGMENTS = 100_000
"""Transitions that are tried in one search, after which junctions are taken for a loop without end."""
MOST_NESTED = 50
"""Events that are sent while others are answered."""


class ChartMachine(ChartFunctions):
    """One chart with its memory.  ``named`` are values of parameters, as written, by their names, ``free``
    those that what is free has in the step that is executed.

    Raises ``DrawnFault`` for what has no value.
    """

    def __init__(
        self, chart: ParsedChart, types: TypeTable, step: str, named: Mapping[str, str] | None = None,
        free: FreeValues | None = None, shared: Mapping[int, SharedCell] | None = None,
    ) -> None:  # fmt: skip
        self.chart = chart
        self.rules = NumberRules(chart.language.name != "MATLAB", chart.drawn.saturates)
        self.memory = ChartMemory(types, self.rules, free, shared or {})
        self._step, self.clock = step, ChartClock(chart, step)
        self._runner = StatementRunner(self.memory, self)
        self._persistent = {}
        self.active: set[StateNode] = set()
        self._child: dict[StateNode, StateNode] = {}
        self._last: dict[StateNode, StateNode] = {}
        self._events: list[str] = []
        self._nested = 0
        self._tried = 0
        self.begun = False
        self._activities = [d for d in chart.root.data.values() if d.activity_of is not None]
        self.output_events = OutputEvents(chart)
        self.executed = {}
        self.fired: list[TransitionNode] = []
        """The transitions taken in this step, those of flow charts too."""
        self.memory.declare_all(chart, named or {}, self._initial)

    def _initial(self, text: str) -> MatlabValue:
        tree = parse_expression(text, ActionLanguage.MATLAB)  # as a parameter, whatever the chart's language
        return self._runner.value(tree, self._frame(self.chart.root))

    def _frame(self, node: StateNode, holds: StateNode | None = None) -> CallFrame:
        """Where a text of a state stands; what it does further is dropped once ``holds`` is not active."""
        if holds is None:
            return CallFrame(node, self.rules)
        return CallFrame(node, self.rules, lambda: self._is_active(holds))

    def _is_active(self, node: StateNode) -> bool:
        return node.parent is None or node in self.active

    # --- a step --------------------------------------------------------------------------------------------

    def initialize(self) -> None:
        """Enter the chart before the first step, if it is so drawn."""
        if self.chart.drawn.at_initialization:
            self._first()

    def begin_anew(self) -> None:
        """All is as before the first step: no state is active, and data have their initial values."""
        self.active.clear()
        self._child.clear()
        self._last.clear()
        self._persistent.clear()
        self.begun = False
        self.clock = ChartClock(self.chart, self._step)
        self.memory.reset_all()

    def step(self, events: Sequence[str] = ()) -> None:
        """One step with the inputs as they are; with input events, one execution for each of them."""
        self.memory.note_start()
        self.clock.begin(self.active)
        if self.chart.drawn.initializes_outputs:
            for one in self.chart.root.data.values():
                if one.scope == "output":
                    self.memory.reset(one.ssid)
        for event in events or ("",):
            self._events = [event] if event else []
            if event:
                self.clock.saw(event, self.active)
            if self.begun:
                self._give()
                self._execute_root()
            else:
                self._first()
            self._events = []
        for one in self._activities:
            self.memory.write(one.ssid, activity(one, self.chart, self.active, self.memory.types))
        self.output_events.end_step()
        self.clock.end(self.active, self._holds)

    def _first(self) -> None:
        self.begun = True
        root = self.chart.root
        if root.children or any(one.label.events for one in root.defaults):
            with suppress(Dropped):
                self._enter_children(root, [])
        else:
            self._flow(root)

    def _give(self) -> None:
        """A Moore chart computes its outputs before it takes transitions: outer states before inner ones."""
        for node in self.chart.root.every():
            if node in self.active:
                self._runner.run(node.sections.get(SectionKind.STATE, ()), self._frame(node))

    def _execute_root(self) -> None:
        root = self.chart.root
        if root.children:
            self._execute_children(root)
        else:
            self._flow(root)

    def _flow(self, root: StateNode) -> None:
        """A chart without states runs its flow chart in every step."""
        found = self._path(root.defaults, root)
        if isinstance(found, list):
            for one in found:
                self._runner.run(one.label.transition_actions, self._frame(one.holder))

    def _execute(self, node: StateNode) -> None:
        """An active state: its outer transitions, its during actions, its inner transitions, its children."""
        try:
            found = self._path(node.outer, node)
            if isinstance(found, list):
                self._take(found, node)
                return
            frame = self._frame(node, node)
            self._runner.run(node.sections.get(SectionKind.DURING, ()), frame)
            for event, actions in node.on_events:
                if self._occurs(event, frame):
                    self._runner.run(actions, frame)
            found = self._path(node.inner, node)
        except Dropped:
            return
        if isinstance(found, list):
            self._take(found, node)
        else:
            self._execute_children(node)

    def _execute_children(self, node: StateNode) -> None:
        if not node.parallel:
            if (child := self._child.get(node)) is not None:
                self._execute(child)
            return
        for region in node.children:
            if region in self.active:  # none is, once the state around them was left
                self._execute(region)

    # --- paths ---------------------------------------------------------------------------------------------

    def _path(self, transitions: Sequence[TransitionNode], source: StateNode) -> Found:
        """The first complete path that begins with one of some transitions.  Raises ``Dropped``."""
        self._tried = 0
        return self._search(transitions, self._frame(source, source))

    def _search(
        self, transitions: Sequence[TransitionNode], frame: CallFrame, in_function: bool = False
    ) -> Found:
        """The same, with the texts in a frame; in a function transition actions run at once, too."""
        waiting, path = [iter(transitions)], list[TransitionNode]()
        while waiting:
            one = next(waiting[-1], None)
            if one is None:  # back to the transitions beside the one that led here
                waiting.pop()
                del path[-1:]
                continue
            self._tried += 1
            if self._tried > MOST_SEGMENTS:
                raise DrawnFault(f"{one} is in a loop of junctions without end: no guard ends it")
            if not self._valid(one, frame):
                continue
            self._runner.run(one.label.condition_actions, frame)
            if in_function:
                self._runner.run(one.label.transition_actions, frame)
            if one.target is None:
                continue
            path.append(one)
            if isinstance(one.target, StateNode) or one.target.history:
                return path
            if not one.target.outgoing:
                return END
            waiting.append(iter(one.target.outgoing))
        return None

    def _valid(self, one: TransitionNode, frame: CallFrame) -> bool:
        label = one.label
        if label.events and not any(self._occurs(event, frame) for event in label.events):
            return False
        try:
            return label.guard is None or self._runner.truth(label.guard, frame)
        except DrawnFault as fault:
            raise DrawnFault(f"{one}: {fault}") from fault

    def _occurs(self, event: Expression, frame: CallFrame) -> bool:
        """Whether an event is the current one, or a temporal condition holds."""
        match event:
            case Name("tick" | "wakeup" as name) if not self._is_event(name, frame):
                return not self._nested
            case Name(name) | Member(_, name):
                return bool(self._events) and self._events[-1] == name
        value = self.clock.word(event, frame, self._now, self._runner)
        if value is None:
            raise DrawnFault("it is neither an event nor a time")
        return isinstance(value, Scalar) and value.truth

    @property
    def _now(self) -> str:
        return self._events[-1] if self._events else ""

    # --- leaving and entering ------------------------------------------------------------------------------

    def _take(self, path: Sequence[TransitionNode], source: StateNode) -> None:
        """Leave, act and enter along a path; what an early return drops is dropped."""
        self.fired += path
        scope = scope_of(self.chart.root, path)
        with suppress(Dropped):
            self._exit_children(scope)
            for one in path:
                frame = CallFrame(source, self.rules, lambda: self._may_go_on(scope))
                self._runner.run(one.label.transition_actions, frame)
            target = path[-1].target
            assert target is not None, "a complete path ends at a state"
            self._enter_children(scope, chain_to(scope, target))

    def _may_go_on(self, scope: StateNode) -> bool:
        """Whether a transition may still be ended: its scope is active, and no state in it."""
        return self._is_active(scope) and not any(child in self.active for child in scope.children)

    def _exit_children(self, node: StateNode) -> None:
        for child in [one for one in reversed(node.children) if one in self.active]:
            if child in self.active:
                self._exit(child)

    def _exit(self, node: StateNode) -> None:
        """Inner states first; it is active while its exit action runs."""
        self._exit_children(node)
        if node not in self.active:
            return
        self._runner.run(node.sections.get(SectionKind.EXIT, ()), self._frame(node, node))
        self.active.discard(node)
        if node.parent is not None:
            self._last[node.parent] = node
            self._child.pop(node.parent, None)

    def _enter(self, node: StateNode, chain: Sequence[StateNode]) -> None:
        """A state becomes active, then its entry action runs, then what is in it is entered."""
        assert node.parent is not None
        self.active.add(node)
        self._child[node.parent] = node
        self.clock.entered(node)
        self._runner.run(node.sections.get(SectionKind.ENTRY, ()), self._frame(node, node))
        self._enter_children(node, chain)

    def _enter_children(self, node: StateNode, chain: Sequence[StateNode]) -> None:
        if node.parallel:
            for region in node.children:
                if not self._is_active(node):
                    raise Dropped
                if region not in self.active:
                    self._enter(region, chain[1:] if chain and chain[0] is region else [])
        elif chain:
            self._enter(chain[0], chain[1:])
        elif node.history is not None and node in self._last:
            self._enter(self._last[node], [])
        elif node.children:
            found = self._path(node.defaults, node)
            if not isinstance(found, list):
                raise DrawnFault(f"no default transition of {node.path} leads to a state now")
            self.fired += found
            for one in found:
                frame = CallFrame(node, self.rules, lambda: self._may_go_on(node))
                self._runner.run(one.label.transition_actions, frame)
            target = found[-1].target
            assert target is not None
            self._enter_children(node, chain_to(node, target))

    # --- words of the chart --------------------------------------------------------------------------------

    def word(self, expression: Expression, frame: CallFrame) -> MatlabValue | None:
        """Times, changes, and whether a state is active."""
        match expression:
            case Applied(Name("in"), (state,)):
                return logical(state_of(state, frame.node) in self.active)
        return self.clock.word(expression, frame, self._now, self._runner)

    def _holds(self, condition: Expression, node: StateNode) -> bool:
        return self._runner.truth(condition, self._frame(node))

    def sent(self, expression: Expression, frame: CallFrame) -> bool:
        """Send an event to the whole chart, or to one state, and have it answered at once."""
        match expression:
            case Applied(Name("send"), (event, *to)) if len(to) < 2:
                name, state = names_in(event)[-1], to[0] if to else None
                owner = event.owner if isinstance(event, Member) and state is None else state
            case Name(name) if self._is_event(name, frame):
                owner = None
            case Member(owner, name) if self._is_event(name, frame):
                pass
            case _:
                return False
        if name in self.output_events:
            self.output_events.send(name)
        else:
            self._broadcast(name, None if owner is None else state_of(owner, frame.node))
        return True

    def _is_event(self, name: str, frame: CallFrame) -> bool:
        if name in (frame.local or {}):
            return False
        return any(name in node.events for node in self.chart.root.every())

    def _broadcast(self, name: str, receiver: StateNode | None) -> None:
        if len(self._events) >= MOST_NESTED:
            raise DrawnFault(f"{name} is sent while {MOST_NESTED} events are answered: they send each other")
        if receiver is not None and receiver not in self.active:
            return
        self.clock.saw(name, self.active)
        self._events.append(name)
        self._nested += 1
        tried, self._tried = self._tried, 0
        try:
            if receiver is None:
                self._execute_root()
            else:
                self._execute(receiver)
        finally:
            self._events.pop()
            self._nested -= 1
            self._tried = tried


__all__ = ["ChartMachine"]
