"""Words of charts about times, changes and active states, as ``after(3, sec)``."""

from collections.abc import Callable, Mapping, Sequence

from rovercheck.checker.drawn.grammar.syntax import Applied, BinaryOperation, Expression, Name
from rovercheck.checker.drawn.lower.active_states import ActiveStateWriter
from rovercheck.checker.drawn.lower.conversions import as_number
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.names import TextScope, datum_in, state_in, words
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import (
    NotLowered,
    Symbolic,
    SymbolicScalar,
    folded,
    single_of,
    truth,
)
from rovercheck.checker.drawn.lower.times import COUNTED, LIMITS, UNITS, ChartTimes, compared_limit
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.parsed import ParsedChart, StateNode
from rovercheck.checker.drawn.records import DrawnData
from rovercheck.checker.drawn.stores import CHANGES_OF_STORES, DATA_STORE
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import FALSE, Expr, Var, all_of


class WordWriter(ActiveStateWriter):
    """The words of one chart.  ``step`` is the length of a step in seconds, as written."""

    def __init__(
        self, chart: ParsedChart, view: ChartView, table: DataTable, writer: ProgramWriter, step: str,
        named: Mapping[str, str], data_names: Callable[[DrawnData, StateNode], str],
    ) -> None:  # fmt: skip
        super().__init__(chart, view, table, writer, named, data_names)
        self.times = ChartTimes(chart.drawn.path, step, table, writer, chart.root.events.values())
        self._most: int | None = None
        self._conditions: dict[tuple[str, int], tuple[StateNode, Callable[[], Expr]]] = {}
        self._starts: dict[str, SymbolicScalar] = {}

    def value(self, expression: Expression, scope: TextScope) -> Symbolic:
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

    def _limit_of(self, expression: BinaryOperation, scope: TextScope) -> int | None:
        def constant(other: Expression) -> Expr:
            try:
                return as_number(single_of(super(WordWriter, self).value(other, scope)))
            except NotLowered:
                return self.view.begun

        if not any(
            isinstance(side, Applied) and isinstance(side.function, Name) and side.function.name in COUNTED
            for side in (expression.left, expression.right)
        ):
            return None
        found = compared_limit(expression, constant, self.times.seconds)
        return None if found is None else found[1]

    def note_overflow(self, what: str, condition: Expr) -> None:
        """Note it in the view."""
        self.writer.mark(self.view.overflow_marker(what), condition)

    def word(self, expression: Expression, scope: TextScope) -> Symbolic | None:
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
        return SymbolicScalar("double", folded(count * self.times.seconds(unit)) if unit in UNITS else count)

    def _held(self, operator: Expression, condition: Expression, scope: TextScope) -> Expr:
        what, plain = self.times.name_of(operator), self._scope(scope.node)
        self._conditions[what, id(scope.node)] = scope.node, lambda: self.condition(condition, plain)
        most, self._most = self._most, None
        holds = self.condition(condition, scope)
        self._most = most
        return self.times.held(operator, holds, scope.node, most)

    # --- changes of data -----------------------------------------------------------------------------------

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

    @property
    def _stepped(self) -> Var:
        return Var(f"{self.writer.name}.stepped", boolean, 0, "whether there was a step before", True)

    def _watch(self, of: Expression, scope: TextScope) -> tuple[SymbolicScalar, SymbolicScalar] | None:
        """A datum at the start of this step and of the one before; ``None`` until it is watched."""
        one = datum_in(scope.node, of.name) if isinstance(of, Name) else None
        if one is None:
            raise NotLowered("changes are seen of a datum: name one")
        if one.scope == DATA_STORE:
            raise NotLowered(CHANGES_OF_STORES)
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

    def _changed(self, name: str, of: Expression, values: Sequence[Expression], scope: TextScope) -> Expr:
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

    def _edge(self, name: str, of: Expression, scope: TextScope) -> Expr:
        found = self._watch(of, scope)
        if found is None:
            return FALSE
        now, before = (as_number(one) for one in found)
        rises = folded(folded(before <= 0) & folded(now > 0))
        falls = folded(folded(before >= 0) & folded(now < 0))
        edge = {"rising": rises, "falling": falls, "crossing": folded(rises | falls)}[name]
        return folded(self.writer.read(self._stepped) & edge)


__all__ = ["WordWriter"]
