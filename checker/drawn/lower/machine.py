"""A chart as the program of its step: what Stateflow does with it, written out for every state that may be
active.

The rules are numbered in the user's guide of Stateflow by their subjects: order of an execution, paths,
leaving and entering, events, early return.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace

from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.labels import SectionKind
from rovercheck.checker.drawn.grammar.syntax import Applied, BinaryOperation, Expression, Member, Name
from rovercheck.checker.drawn.lower.conversions import IntegerRules, as_number, each_converted
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.kinds import sizes
from rovercheck.checker.drawn.lower.names import Scope, datum_in, state_in, words
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.statements import StatementWriter
from rovercheck.checker.drawn.lower.symbols import (
    LOGICAL,
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    chosen,
    filled,
    flat,
    folded,
    leaves,
    matrix,
    single_of,
    size_of,
    truth,
)
from rovercheck.checker.drawn.lower.times import COUNTED, LIMITS, ChartTimes, compared_limit
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.parsed import (
    FunctionNode,
    JunctionNode,
    ParsedChart,
    StateNode,
    TransitionNode,
)
from rovercheck.checker.drawn.records import DrawnData
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var, all_of, any_of, const
from rovercheck.spec_model.lang.system import Statement

MOST_VISITS = 1_000
"""Times that a path goes through one junction, where each is sure."""
Path = list[TransitionNode]


class ChartWriter(StatementWriter):
    """One chart.  ``inputs`` are the values of its input data, by name; ``named`` those of parameters."""

    def __init__(
        self, chart: ParsedChart, view: ChartView, table: DataTable, writer: ProgramWriter, step: str,
        named: Mapping[str, str], data_names: Callable[[DrawnData, StateNode], str],
    ) -> None:  # fmt: skip
        super().__init__(table, writer)
        self.chart, self.view = chart, view
        self.rules = IntegerRules(chart.language.name != "MATLAB", chart.drawn.saturates)
        self.times = ChartTimes(chart.drawn.path, step, table, writer)
        self._values_named, self._name_of = named, data_names
        self._parts: dict[object, tuple[list[Statement], int]] = {}
        self._stack: list[tuple[int, str]] = []
        self._most: int | None = None
        self._conditions: dict[str, tuple[StateNode, Callable[[], Expr]]] = {}
        self._watched: dict[str, tuple[SymbolicScalar, SymbolicScalar]] = {}
        self._starts: dict[str, SymbolicScalar] = {}
        self.sends = _sends(chart)
        self._regions: dict[int, Var] = {}
        self._last: dict[int, Var] = {}
        self._dropped: Var | None = None
        root = chart.root
        self._flows_only = not root.children
        for node in root.every():
            if node.parallel and self.sends:
                for region in node.children:
                    name = f"{writer.name}.{'.'.join(view.paths[region.ssid])}.active"
                    self._regions[region.ssid] = Var(
                        name, boolean, table.starting.get(name, 0), "whether the region is active", True
                    )
            if node.history is not None and node.children and not node.parallel:
                place = view.location(node)
                self._last[node.ssid] = Var(
                    f"{place.name}.last", place.domain, table.starting.get(f"{place.name}.last", 0),
                    "the child left last", True,
                )  # fmt: skip
        self._declare_all()

    # --- data ----------------------------------------------------------------------------------------------

    def _declare_all(self) -> None:
        for node in self.chart.root.every():
            for one in node.data.values():
                if one.scope != "input":
                    self.cells[one.ssid] = self._declared(one, node)
            for function in node.functions.values():
                for one in function.data.values():
                    self.cells[one.ssid] = self._declared(one, node, function)

    def _declared(self, one: DrawnData, node: StateNode, function: FunctionNode | None = None) -> Symbolic:
        name = (
            self._name_of(one, node)
            if function is None
            else f"{self.writer.name}.{function.signature.name}.{one.name}"
        )
        value = self._initial(one, name)
        if one.scope in ("parameter", "constant"):
            return value
        cells = self.table.declared(name, value, hidden=function is not None, doc=self._described(one))
        if function is not None or one.scope == "temporary":
            for _, cell in leaves(cells, name):
                assert isinstance(cell.expr, Var)
                self.writer.temporaries[cell.expr.name] = cell.expr
        return cells

    def _described(self, one: DrawnData) -> str:
        return f"{one.scope} of {self.chart.drawn.path}, {one.type}"

    def _initial(self, one: DrawnData, name: str) -> Symbolic:
        kind, (rows, columns) = self.table.kinds.kind(one.type), sizes(one.size)
        text = one.initial
        if one.scope == "parameter" or one.from_workspace:
            if one.name not in self._values_named:
                raise NotLowered(
                    f"the value of {one.name} stands in no file: name a script that says `{one.name} = ...`"
                )
            text = self._values_named[one.name]
        given = None
        if text.strip():
            scope = Scope(self.chart.root, self.rules)
            given = self.value(parse_expression(text, self.chart.language), scope)
        if not kind:
            seen = self.table.kind_of(name)
            if seen is None and given is not None:
                seen = ("double" if given.kind == UNTYPED else given.kind, *size_of(given))
            kind, rows, columns = seen or ("double", rows, columns)
        if given is None:
            return self.table.kinds.first_value(kind, rows, columns)
        made = each_converted(given, kind, self.rules, self.table.kinds)
        if size_of(made) == (1, 1) != (rows, columns):
            return matrix([single_of(made)] * (rows * columns), rows, columns)
        return made

    def datum(self, one: DrawnData, value: Symbolic) -> Symbolic:
        """The cells of a datum; one without a type takes that of its first value."""
        if not self.table.kinds.kind(one.type) and one.scope != "input":
            kind = "double" if value.kind == UNTYPED else value.kind
            cells = self.cells[one.ssid]
            name = next(leaf for leaf, _ in leaves(cells, self._datum_name(one)))
            if not one.initial.strip():
                self.table.saw(self._datum_name(one), kind, *size_of(value))
            if cells.kind != kind and self.table.kind_of(self._datum_name(one)) != (
                cells.kind,
                *size_of(cells),
            ):
                self.table.changed.add(name)
        if one.scope in ("input", "parameter", "constant"):
            raise NotLowered(f"{one.name} is {one.scope} data, and written to")
        return self.cells[one.ssid]

    def _datum_name(self, one: DrawnData) -> str:
        for node in self.chart.root.every():
            if one.name in node.data and node.data[one.name] is one:
                return self._name_of(one, node)
            for function in node.functions.values():
                if function.data.get(one.name) is one:
                    return f"{self.writer.name}.{function.signature.name}.{one.name}"
        raise AssertionError(one.name)

    # --- what is active ------------------------------------------------------------------------------------

    def active(self, node: StateNode) -> Expr:
        """Whether a state is active at this point."""
        parent = node.parent
        if parent is None:
            return TRUE
        if parent.parallel:
            region = self._regions.get(node.ssid)
            return self.writer.read(region) if region is not None else self._around(parent)
        place = self.view.location(parent)
        return folded(self.writer.read(place) == Const(place.domain.raw(self.view.name(node)), place.sort))

    def _around(self, node: StateNode) -> Expr:
        """The same of a state with regions, of which each is active as it is."""
        return self.active(node) if node.parent is not None else self._has_begun

    @property
    def _has_begun(self) -> Expr:
        return folded(self.writer.read(self.view.begun) == Const(1, self.view.begun.sort))

    def _place(self, node: StateNode, child: StateNode | None) -> None:
        """Make a child of an exclusive state active, or none."""
        place = self.view.location(node)
        raw = 0 if child is None else place.domain.raw(self.view.name(child))
        self.writer.assign(place, Const(raw, place.sort))

    def _scope(self, node: StateNode, holds: StateNode | None = None) -> Scope:
        """Where a text of a state stands, and what must be active for it to go on."""
        alive = None if holds is None else (lambda: self.active(holds))
        event = self._stack[-1][1] if self._stack else ""
        return Scope(node, self.rules, event, keeper=self.writer.name, left=self._dropped, alive=alive)

    # --- a step --------------------------------------------------------------------------------------------

    def step(self, occurs: Sequence[tuple[str, Expr]] | None) -> None:
        """One step; with input events one execution for each that occurs."""
        self._begin_step()
        for event, condition in [("", TRUE)] if occurs is None else occurs:
            self.writer.choose(condition, lambda event=event: self._once(event))
        self._end_step()

    def initialize(self) -> None:
        """What happens before the first step, if it is so drawn; nothing sees it before the chart is executed."""

        def first() -> None:
            self._stack.append((0, ""))
            self._first()
            if self._flows_only:
                self._flow()
            self._stack.pop()

        self.writer.choose(folded(~self._has_begun), first)
        self.writer.known[self.view.begun.name] = Const(1, self.view.begun.sort)

    def _begin_step(self) -> None:
        for node in self.chart.root.every():
            self.times.begin(node, self._is_timed(node))
        if self.chart.drawn.initializes_outputs:
            for one in self.chart.root.data.values():
                if one.scope == "output":
                    self._reset(one, self._name_of(one, self.chart.root))
        for name, (start, now) in self._memories().items():
            self._starts[name] = self.writer.kept("start", now)
            del start

    def _note(self, event: str) -> None:
        """All active states have seen an event once more."""
        for node in self.chart.root.every():
            self.times.saw(event, node, self._is_timed(node))

    def _is_timed(self, node: StateNode) -> Expr:
        """Whether the times of a state go on: those of the chart itself do not, as it is no state."""
        return FALSE if node.parent is None else self.active(node)

    def _memories(self) -> dict[str, tuple[SymbolicScalar, SymbolicScalar]]:
        """The data whose changes are seen: what they were a step before, and what they are."""
        found = {}
        for name, ssid in self.table.watched.get(self.writer.name, {}).items():
            now = self._value_of(ssid)
            first = single_of(self.table.kinds.first_value(now.kind))
            before = single_of(self.table.declared(f"{self.writer.name}.{name}.before", first, hidden=True))
            found[name] = before, now
        return found

    def _value_of(self, ssid: int) -> SymbolicScalar:
        one = single_of(self.cells[ssid])
        return SymbolicScalar(one.kind, self.writer.read(one.expr)) if isinstance(one.expr, Var) else one

    def _end_step(self) -> None:
        for one in self.chart.root.data.values():
            if one.activity_of is not None and one.activity_of in self.chart.states:
                active = self.active(self.chart.states[one.activity_of])
                self.table.write(self.writer, single_of(self.cells[one.ssid]), active)
        by_node: dict[str, dict[str, Callable[[], Expr]]] = {}
        for what, (node, condition) in self._conditions.items():
            by_node.setdefault(node.path, {})[what] = condition
        for node in self.chart.root.every():
            self.times.end(node, self._is_timed(node), by_node.get(node.path, {}))
        for name, (before, _) in self._memories().items():
            if name in self._starts:
                self.table.write(self.writer, before, self._starts[name].expr)
        if self._starts:
            self.writer.assign(self._stepped, TRUE)

    @property
    def _stepped(self) -> Var:
        return Var(f"{self.writer.name}.stepped", boolean, 0, "whether there was a step before", True)

    def _once(self, event: str) -> None:
        self._stack.append((0, event))
        if event:
            self._note(event)
        if self._flows_only:
            self._flow()
        elif self.chart.drawn.at_initialization:
            self._execute_root()
        else:
            self.writer.choose(self._has_begun, self._execute_root, self._first)
        self._stack.pop()

    def _first(self) -> None:
        self.writer.assign(self.view.begun, Const(1, self.view.begun.sort))
        if self._flows_only:
            return
        with self._dropping():
            self._enter_children(self.chart.root, [])

    def _flow(self) -> None:
        """A chart without states runs its flow chart in every step."""
        root = self.chart.root

        def complete(path: Path) -> None:
            self._fired(path, None)
            for one in path:
                self.run(one.label.transition_actions, self._scope(one.holder))

        with self._dropping():
            self._search(root.defaults, self._scope(root), complete)

    @contextmanager
    def _dropping(self) -> Iterator[None]:
        """A part of which the rest is dropped where a state was left meanwhile."""
        before = self._dropped
        with self.writer.until("dropped") as self._dropped:
            yield
        self._dropped = before

    # --- executing -----------------------------------------------------------------------------------------

    def _execute_root(self) -> None:
        if self._flows_only:
            self._flow()
        else:
            self._execute_children(self.chart.root)

    def _execute(self, node: StateNode) -> None:
        """An active state: outer transitions, during and on-event actions, inner transitions, children."""
        event = self._stack[-1][1] if self._stack else ""
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
            self._parts[key] = self.writer.alone(lambda: self._execution(node, event))
            self._stack.pop()
            self._dropped = dropped
        self.writer.include(*self._parts[key])

    def _execution(self, node: StateNode, event: str) -> None:
        for one in node.lineage():
            if one.parent is not None and not one.parent.parallel:
                place = self.view.location(one.parent)
                self.writer.known[place.name] = Const(place.domain.raw(self.view.name(one)), place.sort)
            elif one.ssid in self._regions:
                self.writer.known[self._regions[one.ssid].name] = TRUE
        self.writer.known[self.view.begun.name] = Const(1, self.view.begun.sort)
        with self._dropping(), self.writer.until("taken") as taken:

            def take(path: Path) -> None:
                self._take(path, node)
                self.writer.end(taken)

            self._search(node.outer, self._scope(node, node), take)
            self.run(node.sections.get(SectionKind.DURING, ()), self._scope(node, node))
            for condition, actions in node.on_events:
                self.writer.choose(
                    self._occurs(condition, self._scope(node, node)),
                    lambda actions=actions: self.run(actions, self._scope(node, node)),
                )
            self._search(node.inner, self._scope(node, node), take)
            self._execute_children(node)

    def _execute_children(self, node: StateNode) -> None:
        if node.parallel:
            for region in node.children:
                self.writer.choose(self.active(region), lambda region=region: self._execute(region))
        else:
            self._for_active_child(node, node.children, self._execute)

    def _for_active_child(
        self, node: StateNode, children: Sequence[StateNode], act: Callable[[StateNode], None]
    ) -> None:
        """Do something with the child that is active now, if one is."""
        if not children:
            return
        if len(children) > 8:
            half, place = len(children) // 2, self.view.location(node)
            last = place.domain.raw(self.view.name(children[half - 1]))
            now = self.writer.read(place)
            if not isinstance(now, Const):
                order = sorted(children, key=lambda one: place.domain.raw(self.view.name(one)))
                some, others = order[:half], order[half:]
                last = place.domain.raw(self.view.name(some[-1]))
                self.writer.choose(
                    any_of(*(self.active(one) for one in some)),
                    lambda: self._for_active_child(node, some, act),
                    lambda: self._for_active_child(node, others, act),
                )
                return
        first, *others_ = children
        self.writer.choose(
            self.active(first), lambda: act(first), lambda: self._for_active_child(node, others_, act)
        )

    # --- paths ---------------------------------------------------------------------------------------------

    def _search(
        self, transitions: Sequence[TransitionNode], scope: Scope, complete: Callable[[Path], None],
        in_function: bool = False,
    ) -> None:  # fmt: skip
        """Try paths in order; ``complete`` is what the first one does that leads to a state."""
        if not transitions:
            return
        with self.writer.until("searched") as done:
            self._try(transitions, [], scope, complete, done, in_function)

    def _try(
        self, transitions: Sequence[TransitionNode], path: Path, scope: Scope,
        complete: Callable[[Path], None], done: Var, in_function: bool,
    ) -> None:  # fmt: skip
        for one in transitions:
            if self.writer.dead:
                return
            self.writer.choose(
                self._valid(one, scope),
                lambda one=one: self._follow(one, path, scope, complete, done, in_function),
            )

    def _follow(
        self, one: TransitionNode, path: Path, scope: Scope, complete: Callable[[Path], None], done: Var,
        in_function: bool,
    ) -> None:  # fmt: skip
        with self._told(one):
            self.run(one.label.condition_actions, scope)
            if in_function:
                self.run(one.label.transition_actions, scope)
        if self.writer.dead or one.target is None:
            return
        longer = [*path, one]
        if isinstance(one.target, StateNode) or one.target.history:
            complete(longer)
            self.writer.end(done)
            return
        if not one.target.outgoing:
            if in_function:
                complete(longer)
            self.writer.end(done)
            return
        visits = sum(1 for other in path if other.target is one.target)
        sure = one.label.guard is None or self._sure
        most = MOST_VISITS if sure else self.table.visits
        if visits >= most:
            self.table.met |= set() if sure else {"visits"}
            where = f"junction {one.target.ssid} of {one.holder.path}"
            self.writer.fault(f"a path may go through {where} more than {most:,} times")
            return
        self._try(one.target.outgoing, longer, scope, complete, done, in_function)

    def _valid(self, one: TransitionNode, scope: Scope) -> Expr:
        with self._told(one):
            label = one.label
            events = (
                folded(any_of(*(self._occurs(event, scope) for event in label.events)))
                if label.events
                else TRUE
            )
            if label.guard is None or (isinstance(events, Const) and not events.value):
                self._sure = isinstance(events, Const)
                return events
            if isinstance(events, Const):
                made = self.condition(label.guard, scope)
            else:
                made = self.decided_by("&&", events, label.guard, scope)
            self._sure = isinstance(made, Const)
            return made

    _sure = False

    @contextmanager
    def _told(self, one: TransitionNode) -> Iterator[None]:
        """What has no formula is told with its transition."""
        try:
            yield
        except NotLowered as error:
            text = str(error)
            raise NotLowered(text if "(SSID" in text else f"{one}: {text}") from error

    def _occurs(self, event: Expression, scope: Scope) -> Expr:
        """Whether an event is the current one, or a temporal condition holds."""
        match event:
            case Name(name) | Member(_, name):
                return const(bool(name) and scope.event == name)
        found = self.word(event, scope)
        if found is None:
            raise NotLowered("it is neither an event nor a time")
        return single_of(found).expr

    # --- leaving and entering ------------------------------------------------------------------------------

    def _take(self, path: Path, source: StateNode) -> None:
        """Leave, act and enter along a path; what an early return drops is dropped."""
        self._fired(path, source)
        around = _around_all(self.chart.root, path)
        with self._dropping():
            self._exit_children(around)
            for one in path:
                with self._told(one):
                    scope = replace(self._scope(source), alive=lambda: self._may_go_on(around))
                    self.run(one.label.transition_actions, scope)
            target = path[-1].target
            assert target is not None
            self._enter_children(around, _chain(around, target))

    def _fired(self, path: Path, source: StateNode | None) -> None:
        marker = self.view.marker(path, source, self._stack[-1][1] if self._stack else "")
        self.writer.assign(marker, TRUE)
        self.writer.known.pop(marker.name, None)

    def _may_go_on(self, around: StateNode) -> Expr:
        """Whether a transition may still be ended: what is around it is active, and no state in it."""
        inside = [folded(~self.active(child)) for child in around.children]
        return folded(all_of(self.active(around), *inside))

    def _exit_children(self, node: StateNode) -> None:
        if node.parallel:
            for region in reversed(node.children):
                self.writer.choose(self.active(region), lambda region=region: self._exit(region))
        else:
            self._for_active_child(node, node.children, self._exit)

    def _exit(self, node: StateNode) -> None:
        """Inner states first; it is active while its exit action runs."""
        self._exit_children(node)
        self.writer.choose(self.active(node) if self.sends else TRUE, lambda: self._exit_itself(node))

    def _exit_itself(self, node: StateNode) -> None:
        assert node.parent is not None
        self.run(node.sections.get(SectionKind.EXIT, ()), self._scope(node, node))
        if node.parent.ssid in self._last:
            last = self._last[node.parent.ssid]
            self.writer.assign(last, Const(last.domain.raw(self.view.name(node)), last.sort))
        if node.ssid in self._regions:
            self.writer.assign(self._regions[node.ssid], FALSE)
        elif not node.parent.parallel:
            self._place(node.parent, None)

    def _enter(self, node: StateNode, chain: Sequence[StateNode]) -> None:
        """A state becomes active, then its entry action runs, then what is in it is entered."""
        assert node.parent is not None
        if node.ssid in self._regions:
            self.writer.assign(self._regions[node.ssid], TRUE)
        elif not node.parent.parallel:
            self._place(node.parent, node)
        self.times.entered(node)
        self.run(node.sections.get(SectionKind.ENTRY, ()), self._scope(node, node))
        self._enter_children(node, chain)

    def _enter_children(self, node: StateNode, chain: Sequence[StateNode]) -> None:
        if self.writer.dead:
            return
        if node.parallel:
            for region in node.children:
                if self.sends:
                    assert self._dropped is not None
                    self.writer.end(self._dropped, folded(~self.active(node)))
                further = chain[1:] if chain and chain[0] is region else []
                already = self.active(region) if self.sends else FALSE
                self.writer.choose(already, lambda: None, lambda r=region, f=further: self._enter(r, f))
        elif chain:
            self._enter(chain[0], chain[1:])
        elif node.ssid in self._last:
            last = self.writer.read(self._last[node.ssid])
            self._enter_last(node, last, node.children)
        elif node.children:
            self._enter_default(node)

    def _enter_last(self, node: StateNode, last: Expr, children: Sequence[StateNode]) -> None:
        if not children:
            self._enter_default(node)
            return
        first, *others = children
        raw = self._last[node.ssid].domain.raw(self.view.name(first))
        self.writer.choose(
            folded(last == Const(raw, last.sort)),
            lambda: self._enter(first, []),
            lambda: self._enter_last(node, last, others),
        )

    def _enter_default(self, node: StateNode) -> None:
        with self.writer.until("default_taken") as taken:

            def complete(path: Path) -> None:
                self._fired(path, None)
                for one in path:
                    with self._told(one):
                        scope = replace(self._scope(node), alive=lambda: self._may_go_on(node))
                        self.run(one.label.transition_actions, scope)
                target = path[-1].target
                assert target is not None
                self._enter_children(node, _chain(node, target))
                self.writer.end(taken)

            self._search(node.defaults, self._scope(node, node), complete)
            if not self.writer.dead:
                self.writer.fault(f"no default transition of {node.path} may lead to a state")

    # --- words ---------------------------------------------------------------------------------------------

    def value(self, expression: Expression, scope: Scope) -> Symbolic:
        """The value of an expression; of a count that is compared, only as far as it matters."""
        if isinstance(expression, BinaryOperation) and self._most is None:
            limit = self._limit_of(expression, scope)
            if limit is not None:
                self._most = limit
                try:
                    return super().value(expression, scope)
                finally:
                    self._most = None
        return super().value(expression, scope)

    def _limit_of(self, expression: BinaryOperation, scope: Scope) -> int | None:
        def constant(other: Expression) -> Expr:
            try:
                return as_number(single_of(super(ChartWriter, self).value(other, scope)))
            except NotLowered:
                return self.view.begun

        if not any(
            isinstance(side, Applied) and isinstance(side.function, Name) and side.function.name in COUNTED
            for side in (expression.left, expression.right)
        ):
            return None
        found = compared_limit(expression, constant, self.times.seconds)
        return None if found is None else found[1]

    def word(self, expression: Expression, scope: Scope) -> Symbolic | None:
        """Times, changes, and whether a state is active."""
        match expression:
            case Applied(Name("in"), (state,)):
                return truth(self.active(state_in(scope.node, words(state))))
            case Applied(Name(name), (limit, Name(unit))) if name in (*LIMITS, "every"):
                steps = as_number(single_of(self.value(limit, scope)))
                return truth(self.times.limit(name, steps, unit, scope.node, scope.event))
            case Applied(Name("temporalCount" | "elapsed"), arguments):
                unit = words(arguments[0])[0] if arguments else "sec"
                count = self.times.count(unit, scope.node, self._most)
                return self._in_unit(count, unit)
            case Applied(Name("count" | "duration" as name), (condition, *rest)):
                unit = "tick" if name == "count" else words(rest[0])[0] if rest else "sec"
                return self._in_unit(self._held(expression, condition, scope), unit)
            case Applied(Name("hasChanged" | "hasChangedTo" | "hasChangedFrom" as name), (of, *values)):
                return truth(self._changed(name, of, values, scope))
            case Applied(Name("rising" | "falling" | "crossing" as name), (of,)):
                return truth(self._edge(name, of, scope))
        return None

    def _in_unit(self, count: Expr, unit: str) -> SymbolicScalar:
        in_time = unit in ("sec", "msec", "usec")
        return SymbolicScalar("double", folded(count * self.times.seconds(unit)) if in_time else count)

    def _held(self, operator: Expression, condition: Expression, scope: Scope) -> Expr:
        what, plain = self.times.name_of(operator), self._scope(scope.node)
        self._conditions[what] = scope.node, lambda: self.condition(condition, plain)
        most, self._most = self._most, None
        holds = self.condition(condition, scope)
        self._most = most
        return self.times.held(operator, holds, scope.node, most)

    def _watch(self, of: Expression, scope: Scope) -> tuple[SymbolicScalar, SymbolicScalar] | None:
        """A datum at the start of this step and of the one before; ``None`` until it is known to be watched."""
        one = datum_in(scope.node, of.name) if isinstance(of, Name) else None
        if one is None:
            raise NotLowered("changes are seen of a datum: name one")
        watched = self.table.watched.setdefault(self.writer.name, {})
        name = (
            one.name if one.name not in watched or watched[one.name] == one.ssid else f"{one.name}_{one.ssid}"
        )
        if name not in watched:
            watched[name] = one.ssid
            self.table.changed.add(f"{self.writer.name}.{name}")
        if name not in self._starts:
            return None
        before, _ = self._memories()[name]
        return self._starts[name], before

    def _changed(self, name: str, of: Expression, values: Sequence[Expression], scope: Scope) -> Expr:
        found = self._watch(of, scope)
        if found is None:
            return FALSE
        now, before = found
        made = [self.writer.read(self._stepped), self._differ(now, before)]
        if values:
            wanted = single_of(self.value(values[0], scope))
            made.append(folded(~self._differ(now if name == "hasChangedTo" else before, wanted)))
        return folded(all_of(*made))

    @staticmethod
    def _differ(one: SymbolicScalar, other: SymbolicScalar) -> Expr:
        if one.expr.sort == other.expr.sort:
            return folded(one.expr != other.expr)
        return folded(as_number(one) != as_number(other))

    def _edge(self, name: str, of: Expression, scope: Scope) -> Expr:
        found = self._watch(of, scope)
        if found is None:
            return FALSE
        now, before = (as_number(one) for one in found)
        rises = folded(folded(before <= 0) & folded(now > 0))
        falls = folded(folded(before >= 0) & folded(now < 0))
        edge = {"rising": rises, "falling": falls, "crossing": folded(rises | falls)}[name]
        return folded(self.writer.read(self._stepped) & edge)

    # --- events --------------------------------------------------------------------------------------------

    def sent(self, expression: Expression, scope: Scope) -> bool:
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
        receiver = None if owner is None else state_in(scope.node, words(owner))
        self._broadcast(name, receiver)
        if scope.left is not None and scope.alive is not None:
            self.writer.end(scope.left, folded(~scope.alive()))  # type: ignore[operator]
        return True

    def _is_event(self, name: str, scope: Scope) -> bool:
        if scope.function and f"{scope.function}:{name}" in self.writer.locals:
            return False
        found = [node.events[name] for node in self.chart.root.every() if name in node.events]
        if any(one.scope == "output" for one in found):
            raise NotLowered(f"{name} is an event to other blocks: give them a datum")
        return bool(found)

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

    # --- functions -----------------------------------------------------------------------------------------

    def call(self, function: FunctionNode, arguments: Sequence[Symbolic], scope: Scope) -> list[Symbolic]:
        """A function of the chart: a MATLAB function, or a flow chart with its own data."""
        name = function.signature.name
        if name in scope.calls:
            raise NotLowered(f"{name} calls itself: write a loop")
        keeper = f"{self.writer.name}.{name}"
        if function.script:
            script = {one.signature.name: one for one in function.script}
            own = replace(scope, node=function.holder, script=script, keeper=keeper, kept=set())
            return self.script(function.script[0], arguments, own)
        if function.flow is None or function.drawn.function == "Simulink":
            raise NotLowered(f"{name} is a Simulink function, or a truth table without its script")
        flow, signature = function.flow, function.signature
        for datum_name, one in flow.data.items():
            self._reset(one, f"{keeper}.{datum_name}")
            if datum_name in signature.inputs:
                at = signature.inputs.index(datum_name)
                if at < len(arguments):
                    self._all(self.datum(one, arguments[at]), arguments[at], replace(scope, node=flow))
        inner = Scope(flow, self.rules, scope.event, calls=(*scope.calls, name), keeper=keeper)
        self._search(flow.defaults, inner, lambda path: None, in_function=True)
        return [self.kept(self._now(self.cells[flow.data[name].ssid])) for name in signature.outputs]

    def _reset(self, one: DrawnData, name: str) -> None:
        if one.scope not in ("constant", "parameter"):
            pairs = zip(
                leaves(self.cells[one.ssid], name), leaves(self._initial(one, name), name), strict=True
            )
            for (_, cell), (_, value) in pairs:
                self.table.write(self.writer, cell, value.expr)

    # --- a MATLAB function as a block ----------------------------------------------------------------------

    def run_block(self) -> None:
        """Execute the function of a block: its values are matched with the data by name."""
        [function] = self.chart.root.functions.values()
        data = self.chart.root.data
        scope = self._scope(self.chart.root)
        names = (name for name in function.script[0].signature.inputs if name is not None)
        given = [self._now(self.cells[data[name].ssid]) for name in names if name in data]
        found = self.call(function, given, scope)
        for name, value in zip(function.script[0].signature.outputs, found, strict=False):
            if name in data:
                self._all(self.datum(data[name], value), value, scope)


def _sends(chart: ParsedChart) -> bool:
    """Whether a chart may send an event to itself."""
    return any(one.scope == "local" for node in chart.root.every() for one in node.events.values())


def _around_all(root: StateNode, path: Sequence[TransitionNode]) -> StateNode:
    """The innermost state that holds all of a path: an outer transition is drawn outside its source."""
    chains = [list(one.holder.lineage())[::-1] for one in path]
    found = root
    for level in zip(*chains, strict=False):
        if len({node.ssid for node in level}) > 1:
            break
        found = level[0]
    return found


def _chain(around: StateNode, target: StateNode | JunctionNode) -> list[StateNode]:
    """The states from below one down to a target; a history junction stands for its state."""
    node = target.holder if isinstance(target, JunctionNode) else target
    chain = [one for one in node.lineage()]
    at = next(index for index, one in enumerate(chain) if one is around)
    return chain[:at][::-1]


__all__ = ["LOGICAL", "ChartWriter", "chosen", "filled", "flat"]
