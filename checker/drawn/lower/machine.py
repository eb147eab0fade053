"""A chart as the program of its step: what is done in it, written out for every state that may be active.

The rules are numbered in the user's guide of Stateflow by their subjects: order of an execution, paths,
leaving and entering, events, early return.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from rovercheck.checker.drawn.activity import NONE, activity_members
from rovercheck.checker.drawn.grammar.actions import ActionStatement
from rovercheck.checker.drawn.grammar.labels import SectionKind
from rovercheck.checker.drawn.grammar.syntax import Applied, Expression, Member, Name
from rovercheck.checker.drawn.lower.builtins import greatest, least
from rovercheck.checker.drawn.lower.chart_paths import TransitionPath
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.names import TextScope, state_in, words
from rovercheck.checker.drawn.lower.program import ProgramPart, ProgramWriter, joined
from rovercheck.checker.drawn.lower.symbols import NotLowered, SymbolicScalar, chosen, folded, single_of
from rovercheck.checker.drawn.lower.transitions import TransitionWriter
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.parsed import ParsedChart, StateNode, output_events
from rovercheck.checker.drawn.records import DrawnData
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var

MOST_WAITING = 255
"""Times that an event to other blocks may wait, as each step gives one of them."""


class ChartWriter(TransitionWriter):
    """One chart.  ``named`` are the values of parameters as texts, ``data_names`` names the data."""

    def __init__(
        self, chart: ParsedChart, view: ChartView, table: DataTable, writer: ProgramWriter, step: str,
        named: Mapping[str, str], data_names: Callable[[DrawnData, StateNode], str],
    ) -> None:  # fmt: skip
        super().__init__(chart, view, table, writer, step, named, data_names)
        self._parts: dict[object, ProgramPart] = {}
        self._flows_only = not chart.root.children
        self.called: Mapping[str, ProgramPart] | None = None
        """What function calls call, by their names; nothing is before the first step."""
        self.borrowed: Mapping[str, Var] = {}
        """The temporaries of what is called."""
        self._declare_all()

    # --- a step --------------------------------------------------------------------------------------------

    def step(self, occurs: Sequence[tuple[str, Expr]] | None) -> None:
        """One step; with input events one execution for each that occurs."""
        self._begin_step()
        for event, condition in [("", TRUE)] if occurs is None else occurs:
            self.writer.choose(condition, partial(self._once, event))
        self._end_step()

    def woken(self, events: Sequence[str], feed: Callable[[], None]) -> list[ProgramPart]:
        """What each of some events does that other charts call; ``feed`` reads the inputs."""

        def begin() -> None:
            feed()
            self._begin_step()

        first = self.writer.alone(begin)
        every = [self.writer.alone(partial(self._once, event)) for event in events]
        last = self.writer.alone(self._end_step)  # when all that is to be counted is known
        return [joined(first, one, last) for one in every]

    def initialize(self) -> None:
        """What happens before the first step, if it is so drawn."""

        def first() -> None:
            self._stack.append((0, ""))
            self._first()
            if self._flows_only:
                self._flow()
            self._stack.pop()

        self.writer.choose(folded(~self._has_begun), first)
        self.writer.known[self.view.begun.name] = Const(1, self.view.begun.sort)

    def _begin_step(self) -> None:
        self._begin_regions()
        for node in self.chart.root.every():
            self.times.begin(node, self._is_timed(node))
        if self.chart.drawn.initializes_outputs:
            for one in self.chart.root.data.values():
                if one.scope == "output":
                    self._reset(one, self._name_of(one, self.chart.root))
        for name, (_, now) in self._memories().items():
            self._starts[name] = self.writer.kept("start", now)

    def _note(self, event: str) -> None:
        """All active states have seen an event once more."""
        for node in self.chart.root.every():
            self.times.saw(event, node, self._is_timed(node))

    def _is_timed(self, node: StateNode) -> Expr:
        """Whether the times of a state go on: those of the chart itself do not, as it is no state."""
        return FALSE if node.parent is None else self.active(node)

    def _end_step(self) -> None:
        for one in self.chart.root.data.values():
            if one.activity_of is not None:
                self.table.write(self.writer, single_of(self.cells[one.ssid]), self._activity(one))
        by_node: dict[str, dict[str, Callable[[], Expr]]] = {}
        for (what, _), (node, condition) in self._conditions.items():
            by_node.setdefault(node.path, {})[what] = condition
        for node in self.chart.root.every():
            self.times.end(node, self._is_timed(node), by_node.get(node.path, {}))
        self._give()
        for name, (before, _) in self._memories().items():
            if name in self._starts:
                self.table.write(self.writer, before, self._starts[name].expr)
        if self._starts:
            self.writer.assign(self._stepped, TRUE)

    def _activity(self, one: DrawnData) -> Expr:
        """What an output tells of the active states."""
        if one.activity == "self":
            state = self.chart.states.get(one.activity_of or 0)
            return (
                self.active(state) if state is not None else self._has_begun if not one.activity_of else FALSE
            )
        owner = one.type.partition(":")[2].strip()

        def member(name: str) -> Expr:
            found = self.table.kinds.member(name, owner)
            if found is None:
                raise NotLowered(f"{one.name}: {owner} has no member {name}, as a state is named")
            return found.expr

        made = member(NONE)
        for ssid, name in activity_members(self.chart.drawn, one).items():
            made = chosen(self.active(self.chart.states[ssid]), member(name), made)
        return made

    def _once(self, event: str) -> None:
        self._stack.append((0, event))
        if event:
            self._note(event)
        if self._flows_only:
            self._flow()
        elif self.chart.drawn.at_initialization:
            self._compute()
            self._execute_root()
        else:
            self.writer.choose(self._has_begun, self._execute_root, self._first)
            self.writer.end_alike(self.view.begun.name)
        self._stack.pop()

    def _compute(self) -> None:
        """The outputs of a Moore chart, before it takes transitions: those of outer states first."""
        for node in self.chart.root.every():
            if actions := node.sections.get(SectionKind.STATE):
                self.writer.choose(self.active(node), partial(self._answer, node, actions))

    def _first(self) -> None:
        self.writer.assign(self.view.begun, Const(1, self.view.begun.sort))
        if self._flows_only:
            return
        with self._dropping():
            self._enter_children(self.chart.root, [])

    def _flow(self) -> None:
        """A chart without states runs its flow chart in every step."""
        root = self.chart.root

        def complete(path: TransitionPath) -> None:
            self._fired(path, None)
            for one in path:
                self.run(one.label.transition_actions, self._scope(one.holder))

        with self._dropping():
            self._search(root.defaults, self._scope(root), complete)

    # --- executing -----------------------------------------------------------------------------------------

    def _execute_root(self) -> None:
        if self._flows_only:
            self._flow()
        else:
            self._execute_children(self.chart.root)

    def _execute(self, node: StateNode) -> None:
        """An active state: outer transitions, during and on-event actions, inner transitions, children."""
        event = self._event
        if self._stack.count((node.ssid, event)) >= self.table.nested:
            said = (
                f"{event or 'a step'} may be answered by {node.path} {self.table.nested} times within itself"
            )
            self.table.met.add("nested")
            self.writer.fault(said)
            return
        key = (node.ssid, event, tuple(sorted(self._stack)) if self.sends else ())
        if key not in self._parts:
            dropped, self._dropped = self._dropped, None
            self._stack.append((node.ssid, event))
            self._parts[key] = self.writer.alone(lambda: self._execution(node))
            self._stack.pop()
            self._dropped = dropped
        self.writer.include(*self._parts[key])

    def _execution(self, node: StateNode) -> None:
        for one in node.lineage():
            if one.parent is not None and not one.parent.parallel:
                place = self.view.location(one.parent)
                self.writer.known[place.name] = Const(place.domain.raw(self.view.name(one)), place.sort)
            elif one.ssid in self._regions:
                self.writer.known[self._regions[one.ssid].name] = TRUE
        self.writer.known[self.view.begun.name] = Const(1, self.view.begun.sort)
        with self._dropping(), self.writer.until("taken") as taken:

            def take(path: TransitionPath) -> None:
                self._take(path, node)
                self.writer.end(taken)

            self._search(node.outer, self._scope(node, node), take)
            self.run(node.sections.get(SectionKind.DURING, ()), self._scope(node, node))
            for condition, actions in node.on_events:
                self.writer.choose(
                    self._occurs(condition, self._scope(node, node)),
                    partial(self._answer, node, actions),
                )
            self._search(node.inner, self._scope(node, node), take)
            self._execute_children(node)

    def _answer(self, node: StateNode, actions: Sequence[ActionStatement]) -> None:
        self.run(actions, self._scope(node, node))

    def _execute_children(self, node: StateNode) -> None:
        if node.parallel:
            sure = node.parent is None and self._stays and len(self._stack) == 1
            for region in node.children:
                self.writer.choose(TRUE if sure else self.active(region), partial(self._execute, region))
        else:
            self._for_active_child(node, node.children, self._execute)

    # --- events --------------------------------------------------------------------------------------------

    def sent(self, expression: Expression, scope: TextScope) -> bool:
        """Send an event to the whole chart, or to one state, and have it answered at once."""
        owner: Expression | None
        match expression:
            case Applied(Name("send"), (event, *to)) if len(to) < 2:
                name = words(event)[-1]
                owner = to[0] if to else event.owner if isinstance(event, Member) else None
            case Name(name) if self._is_event(name, scope):
                owner = None
            case Member(owner, name) if self._is_event(name, scope):
                pass
            case _:
                return False
        if name in self.given:
            self._wait(name)
            return True
        if name in (one.name for one in output_events(self.chart.root)):
            self._call_out(name)
            return True
        receiver = None if owner is None else state_in(scope.node, words(owner))
        self._broadcast(name, receiver)
        if scope.left is not None and scope.alive is not None:
            self.writer.end(scope.left, folded(~scope.alive()))
        return True

    def _call_out(self, name: str) -> None:
        """Execute what a function call calls, here and now."""
        if self.called is None:
            raise NotLowered(f"{name} is a function call, sent before the first step: send it in a step")
        if (part := self.called.get(name)) is not None:
            self.writer.include(*part)

    def _wait(self, name: str) -> None:
        """An event to other blocks changes its signal at the end of this step, or of a later one."""
        _, waiting = self.given[name]
        now = single_of(self._now(waiting)).expr
        self.writer.choose(
            folded(now == MOST_WAITING),
            lambda: self.writer.fault(f"{name} may be sent while {MOST_WAITING} of it wait"),
            lambda: self.table.write(
                self.writer, waiting, folded(least(now + 1, Const(MOST_WAITING, Num())))
            ),
        )

    def _give(self) -> None:
        """Each event to other blocks that waits changes its signal, once in a step."""
        for signal, waiting in self.given.values():
            now, was = (single_of(self._now(one)).expr for one in (waiting, signal))

            def change(
                signal: SymbolicScalar = signal, waiting: SymbolicScalar = waiting,
                now: Expr = now, was: Expr = was,
            ) -> None:  # fmt: skip
                self.table.write(self.writer, signal, folded(~was))
                self.table.write(self.writer, waiting, folded(greatest(now - 1, Const(0, Num()))))

            self.writer.choose(folded(now > 0), change)

    def _broadcast(self, name: str, receiver: StateNode | None) -> None:
        def answer() -> None:
            self._note(name)
            if receiver is None:
                if self._stack.count((0, name)) >= self.table.nested:
                    self.table.met.add("nested")
                    self.writer.fault(f"{name} may be sent {self.table.nested} times within itself")
                    return
                self._stack.append((0, name))
                dropped, self._dropped = self._dropped, None
                self._execute_root()
                self._dropped = dropped
            else:
                self._stack.append((-1, name))
                self._execute(receiver)
            self._stack.pop()

        self.writer.choose(TRUE if receiver is None else self.active(receiver), answer)


__all__ = ["ChartWriter"]
