"""The data of a chart: the variables that hold them, and what they are at first."""

from collections.abc import Callable, Mapping

from rovercheck.checker.drawn.calls import FUNCTION_CALL
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage
from rovercheck.checker.drawn.lower.conversions import IntegerRules, each_converted
from rovercheck.checker.drawn.lower.data import DataTable, SizeLearned
from rovercheck.checker.drawn.lower.kinds import sizes
from rovercheck.checker.drawn.lower.names import TextScope
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.statements import StatementWriter
from rovercheck.checker.drawn.lower.symbols import (
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    leaves,
    matrix,
    number,
    single_of,
    size_of,
    truth,
)
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.parameters import expanded, seen_in
from rovercheck.checker.drawn.parsed import FunctionNode, ParsedChart, StateNode, output_events
from rovercheck.checker.drawn.records import DrawnData
from rovercheck.checker.drawn.stores import DATA_STORE
from rovercheck.spec_model.lang.expr import FALSE, Var


class ChartDataWriter(StatementWriter):
    """The data of one chart.

    ``named`` are the values of parameters as texts, by their names; ``data_names`` gives a datum of a state
    the name that its variable has.
    """

    def __init__(
        self, chart: ParsedChart, view: ChartView, table: DataTable, writer: ProgramWriter,
        named: Mapping[str, str], data_names: Callable[[DrawnData, StateNode], str],
    ) -> None:  # fmt: skip
        super().__init__(table, writer)
        self.chart, self.view, self.language = chart, view, chart.language
        self.rules = IntegerRules(chart.language.name != "MATLAB", chart.drawn.saturates)
        self._values_named, self._name_of = named, data_names
        self.given: dict[str, tuple[SymbolicScalar, SymbolicScalar]] = {}
        """Of each event to other blocks that is no function call its signal, and how many of it wait."""

    def _declare_all(self) -> None:
        for node in self.chart.root.every():
            for one in node.data.values():
                if one.scope not in ("input", DATA_STORE):  # these stand elsewhere
                    self.cells[one.ssid] = self._declared(one, node)
            for function in node.functions.values():
                for one in function.data.values():
                    self.cells[one.ssid] = self._declared(one, node, function)

        for event in output_events(self.chart.root):
            if event.trigger == FUNCTION_CALL:
                continue
            name = f"{self.writer.name}.{event.name}"
            signal = self.table.declared(name, truth(FALSE), doc=f"the event {event.name}")
            waiting = self.table.declared(f"{name}.waiting", number("uint8", 0), hidden=True)
            self.given[event.name] = single_of(signal), single_of(waiting)

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
                self.writer.assigned_anew.add(cell.expr.name)
        return cells

    def _described(self, one: DrawnData) -> str:
        return f"{one.scope} of {self.chart.drawn.path}, {one.type}"

    def _initial(self, one: DrawnData, name: str) -> Symbolic:
        kind, (rows, columns) = self.table.kinds.kind(one.type), sizes(one.size)
        text = expanded(one.initial, seen_in(self.chart.drawn, self._values_named))
        if one.scope == "parameter" or one.from_workspace:
            if one.name not in self._values_named:
                raise NotLowered(
                    f"the value of {one.name} stands in no file: name a script that says `{one.name} = ...`"
                )
            text = self._values_named[one.name]
        given = None
        if text.strip():
            scope = TextScope(self.chart.root, self.rules)
            given = self.value(parse_expression(text, ActionLanguage.MATLAB), scope)
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
        if not self.table.kinds.kind(one.type) and one.scope not in ("input", DATA_STORE):
            kind = "double" if value.kind == UNTYPED else value.kind
            cells = self.cells[one.ssid]
            name = next(leaf for leaf, _ in leaves(cells, self._datum_name(one)))
            if not one.initial.strip():
                seen, called = (kind, *size_of(value)), self._datum_name(one)
                self.table.saw(called, *seen)
                if size_of(cells) == (1, 1) != size_of(value) and self.table.kind_of(called) == seen:
                    raise SizeLearned
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

    def _reset(self, one: DrawnData, name: str) -> None:
        if one.scope not in ("constant", "parameter"):
            pairs = zip(
                leaves(self.cells[one.ssid], name), leaves(self._initial(one, name), name), strict=True
            )
            for (_, cell), (_, value) in pairs:
                self.table.write(self.writer, cell, value.expr)


__all__ = ["ChartDataWriter"]
