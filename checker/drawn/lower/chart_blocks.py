"""Charts and MATLAB functions as blocks of a system."""

from abc import abstractmethod
from collections.abc import Sequence

from rovercheck.checker.drawn.lower.conversions import IntegerRules, each_converted
from rovercheck.checker.drawn.lower.kinds import sizes
from rovercheck.checker.drawn.lower.machine import ChartWriter
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import (
    NotLowered,
    Symbolic,
    SymbolicStructure,
    filled,
    flat,
    folded,
    leaves,
    matrix,
    single_of,
    size_of,
    truth,
)
from rovercheck.checker.drawn.lower.triggers import TriggerWriter
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.lower.wired_blocks import BlockNode
from rovercheck.checker.drawn.parsed import ParsedChart, output_events
from rovercheck.checker.drawn.records import DrawnData
from rovercheck.spec_model.lang.chart import Component, Enabled
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Var, any_of
from rovercheck.spec_model.lang.programmed import ProgrammedBlock, ProgrammedChart, StepProgram
from rovercheck.spec_model.lang.system import Program


class ChartBlockWriter(TriggerWriter):
    """The charts of one system; ``writer_of`` writes what a chart does."""

    writer_of: type[ChartWriter] = ChartWriter

    @abstractmethod
    def _call_all(self, node: BlockNode, chart: ParsedChart, made: ChartWriter) -> list[ProgrammedChart]:
        """Write what the function calls of a chart call, into its writer.

        The answer are the charts among that, which have no turn of their own.
        """

    def _chart(self, node: BlockNode) -> list[Component]:
        context, chart = self.context, self.context.chart(node.block.chart)
        name = context.names.of_chart(chart.drawn)
        view = ChartView(chart, name, context.file, context.table.starting)
        writer = ProgramWriter(name, context.most)
        made = self._writer(chart, view, writer)
        node.outputs = self._outputs_of(made)
        if chart.drawn.is_function:
            return self._function(node, made)
        others = self._call_all(node, chart, made)
        self._feed(made, chart, node)
        made.step(self._events(node, chart))
        component = self._programmed(made, writer.written(), others)
        context.views[name] = view
        if chart.drawn.at_initialization:
            self._start(node, made)
        self._tell(made)
        if not self._input_events(chart):
            return [*others, component]
        return [*others, Enabled(self._any_event(node, chart), component), *self._edges(node)]

    def _function(self, node: BlockNode, made: ChartWriter) -> list[Component]:
        """A MATLAB function, or a truth table, which is executed in every step or for each event."""
        drawn, writer = made.chart.drawn, made.writer
        self._feed(made, made.chart, node)
        events = self._events(node, made.chart)
        for _, condition in [("", TRUE)] if events is None else events:
            writer.choose(condition, made.run_block)
        component = ProgrammedBlock(
            writer.name, writer.written(), dict(made.view.overflows), text=f"The {drawn.kind} {drawn.path}.",
            temporaries=tuple(writer.temporaries.values()),
        )  # fmt: skip
        self._tell(made)
        return [component, *(self._edges(node) if events is not None else [])]

    def _programmed(
        self, made: ChartWriter, statements: Program, others: Sequence[ProgrammedChart]
    ) -> ProgrammedChart:
        """A chart with the program of its step, in which it calls ``others``."""
        view, places = made.view, (place for one in others for place in (one.entered, *one.locations))
        return view.made(StepProgram(
            statements, tuple(made.writer.temporaries.values()), self.context.table.starting,
            dict(view.fired), dict(view.tested), dict(view.rivals), dict(view.overflows), tuple(places),
        ))  # fmt: skip

    def _start(self, node: BlockNode, made: ChartWriter) -> None:
        """What a chart does that is entered before the first step."""
        context, chart = self.context, made.chart
        start = ProgramWriter(made.writer.name, context.most)
        first = self._writer(chart, made.view, start)
        first.executed = made.executed
        start.temporaries |= made.borrowed
        at_rest = [context.table.kinds.first_value(v.kind, *size_of(v)) for v in self._values(node)]
        self._feed_values(first, chart, at_rest, [False] * len(at_rest))
        first.initialize()
        context.starts.append(start)

    def _tell(self, made: ChartWriter) -> None:
        """The data of a chart are data of the model, but for those that last no longer than its step."""
        context, writer = self.context, made.writer
        context.temporaries |= writer.temporaries.keys()
        for one in made.chart.root.data.values():
            for leaf, cell in leaves(made.cells[one.ssid], f"{writer.name}.{one.name}"):
                at = cell.expr.name if isinstance(cell.expr, Var) else ""
                if one.scope != "input":
                    self.own.add(at)
                if at not in writer.temporaries and at not in context.memories:  # else it changes later
                    context.data[leaf] = cell.expr

    @staticmethod
    def _outputs_of(made: ChartWriter) -> list[Symbolic]:
        """The outputs of a chart by their ports; a function call is no value, and stands as one."""
        root = made.chart.root
        found = [made.cells[one.ssid] for one in root.data.values() if one.scope == "output"]
        signals = (made.given.get(one.name) for one in output_events(root))
        return [*found, *(truth(FALSE) if one is None else one[0] for one in signals)]

    def _writer(self, chart: ParsedChart, view: ChartView, writer: ProgramWriter) -> ChartWriter:
        context = self.context
        made = self.writer_of(
            chart, view, context.table, writer, context.step, context.named,
            lambda one, node: context.names.of_datum(chart.drawn, one, node),
        )  # fmt: skip
        made.cells |= context.stores.of(chart)
        return made

    def _feed(self, made: ChartWriter, chart: ParsedChart, node: BlockNode) -> None:
        """The inputs of a chart; what is called while it is executed is read as it is then."""
        called = self._wiring.called
        changes = [port is not None and port[0] in called for port in node.inputs]
        self._feed_values(made, chart, self._values(node), changes)

    def _feed_values(
        self, made: ChartWriter, chart: ParsedChart, values: Sequence[Symbolic], changes: Sequence[bool]
    ) -> None:
        """Values as inputs in the types of its data; those that change in its step are not kept for it."""
        kinds, data = self.context.table.kinds, chart.root.data.values()
        inputs = (one for one in data if one.scope == "input")
        for one, value, is_read_anew in zip(inputs, values, changes, strict=False):
            fitted = self._fitted(value, one, made.rules)
            scalars = [
                s if is_read_anew or isinstance(s.expr, Var) else made.writer.kept(one.name, s)
                for _, s in leaves(fitted, "")
            ]
            made.cells[one.ssid] = filled(fitted, iter(scalars))
        for one in data:
            if one.scope == "input" and one.ssid not in made.cells:
                made.cells[one.ssid] = kinds.first_value(kinds.kind(one.type) or "double", *sizes(one.size))

    def _fitted(self, value: Symbolic, one: DrawnData, rules: IntegerRules) -> Symbolic:
        """A signal in the type of an input, and in its size."""
        kinds = self.context.table.kinds
        kind = kinds.kind(one.type)
        plain = kind and not kind.startswith("Bus: ")
        return _in_size(each_converted(value, kind, rules, kinds) if plain else value, one)

    @staticmethod
    def _input_events(chart: ParsedChart) -> list[tuple[str, str]]:
        return [(one.name, one.trigger) for one in chart.root.events.values() if one.scope == "input"]

    def _events(self, node: BlockNode, chart: ParsedChart) -> list[tuple[str, Expr]] | None:
        """The input events of a chart with the conditions that they occur; ``None`` if it has none."""
        every = self._input_events(chart)
        if not every:
            return None
        occur = self._edge_conditions(node, [trigger for _, trigger in every])
        return list(zip((name for name, _ in every), occur, strict=False))

    def _any_event(self, node: BlockNode, chart: ParsedChart) -> Expr:
        every = self._input_events(chart)
        return folded(any_of(*self._edge_conditions(node, [trigger for _, trigger in every])))


def _in_size(value: Symbolic, one: DrawnData) -> Symbolic:
    """A signal in the size of an input: a vector fits in either direction, a scalar is each element."""
    came, wanted = size_of(value), sizes(one.size)
    if one.size.strip() in ("", "-1") or came == wanted or isinstance(value, SymbolicStructure):
        return value
    if came == (1, 1):
        return matrix([single_of(value)] * (wanted[0] * wanted[1]), *wanted)
    if came == wanted[::-1] and 1 in came:
        return matrix(flat(value), *wanted)
    told, has = (f"{rows}x{columns}" for rows, columns in (came, wanted))
    raise NotLowered(f"{one.name} is of {has}, and its value of {told}")


__all__ = ["ChartBlockWriter"]
