"""Charts and MATLAB functions as blocks of a system."""

from collections.abc import Sequence

from rovercheck.checker.drawn.lower.conversions import each_converted
from rovercheck.checker.drawn.lower.kinds import sizes
from rovercheck.checker.drawn.lower.machine import ChartWriter
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import Symbolic, filled, folded, leaves, size_of
from rovercheck.checker.drawn.lower.triggers import TriggerWriter
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.lower.wired_blocks import BlockNode
from rovercheck.checker.drawn.parsed import ParsedChart
from rovercheck.spec_model.lang.chart import Block, Component, Enabled
from rovercheck.spec_model.lang.expr import Expr, Var, any_of
from rovercheck.spec_model.lang.programmed import StepProgram


class ChartBlockWriter(TriggerWriter):
    """The charts of one system."""

    def _chart(self, node: BlockNode) -> list[Component]:
        context, chart = self.context, self.context.chart(node.block.chart)
        name = context.names.of_chart(chart.drawn)
        view = ChartView(chart, name, context.file, context.table.starting)
        writer = ProgramWriter(name, context.most)
        made = self._writer(chart, view, writer)
        self._feed(made, chart, self._values(node))
        if chart.drawn.kind in ("MATLAB function", "truth table"):
            made.run_block()
            component: Component = Block(
                name, writer.written(), text=f"The {chart.drawn.kind} {chart.drawn.path}.",
                temporaries=tuple(writer.temporaries.values()),
            )  # fmt: skip
        else:
            made.step(self._events(node, chart))
            statements = writer.written()
            program = StepProgram(
                statements, tuple(writer.temporaries.values()), context.table.starting, dict(view.fired),
                dict(view.tested),
            )  # fmt: skip
            component = view.made(program)
            context.views[name] = view
            if chart.drawn.at_initialization:
                start = ProgramWriter(name, context.most)
                first = self._writer(chart, view, start)
                at_rest = [context.table.kinds.first_value(v.kind, *size_of(v)) for v in self._values(node)]
                self._feed(first, chart, at_rest)
                first.initialize()
                context.starts.append(start)
        context.temporaries |= writer.temporaries.keys()
        for one in chart.root.data.values():
            cells = made.cells[one.ssid]
            for leaf, cell in leaves(cells, f"{name}.{one.name}"):
                at = cell.expr.name if isinstance(cell.expr, Var) else ""
                if one.scope != "input":
                    self.own.add(at)
                if at not in writer.temporaries and at not in context.memories:  # else it changes later
                    context.data[leaf] = cell.expr
        node.outputs = [made.cells[one.ssid] for one in chart.root.data.values() if one.scope == "output"]
        node.outputs += [signal for signal, _ in made.given.values()]
        if isinstance(component, Block) or not self._input_events(chart):
            return [component]
        return [Enabled(self._any_event(node, chart), component), *self._edges(node)]

    def _writer(self, chart: ParsedChart, view: ChartView, writer: ProgramWriter) -> ChartWriter:
        context = self.context
        return ChartWriter(
            chart, view, context.table, writer, context.step, context.named,
            lambda one, node: context.names.of_datum(chart.drawn, one, node),
        )  # fmt: skip

    def _feed(self, made: ChartWriter, chart: ParsedChart, values: Sequence[Symbolic]) -> None:
        """The inputs of a chart, in the types of its data."""
        kinds, data = self.context.table.kinds, chart.root.data.values()
        for one, value in zip((d for d in data if d.scope == "input"), values, strict=False):
            kind = kinds.kind(one.type)
            plain = kind and not kind.startswith("Bus: ")
            fitted = each_converted(value, kind, made.rules, kinds) if plain else value
            scalars = [
                made.writer.kept(one.name, s) if not isinstance(s.expr, Var) else s
                for _, s in leaves(fitted, "")
            ]
            made.cells[one.ssid] = filled(fitted, iter(scalars))
        for one in data:
            if one.scope == "input" and one.ssid not in made.cells:
                made.cells[one.ssid] = kinds.first_value(kinds.kind(one.type) or "double", *sizes(one.size))

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


__all__ = ["ChartBlockWriter"]
