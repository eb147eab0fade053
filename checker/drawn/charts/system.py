"""A drawn model as a system of charts and blocks that a person can read and edit."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

from rovercheck.checker.drawn.charts.chart import ChartBuilder, ChartLabels
from rovercheck.checker.drawn.charts.substitution import actions_after
from rovercheck.checker.drawn.charts.texts import ChartTexts, UnnamedTexts
from rovercheck.checker.drawn.charts.tidy import tidied, tidied_actions
from rovercheck.checker.drawn.free import free_outputs
from rovercheck.checker.drawn.lower.conversions import IntegerRules
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.kinds import sizes
from rovercheck.checker.drawn.lower.lowered import LoweredModel
from rovercheck.checker.drawn.lower.machine import ChartWriter
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import (
    NotLowered,
    Symbolic,
    SymbolicScalar,
    filled,
    leaves,
    single_of,
)
from rovercheck.checker.drawn.lower.system import SystemWriter
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.lower.wired_blocks import BlockNode
from rovercheck.checker.drawn.parsed import ParsedChart, output_events
from rovercheck.checker.drawn.records import DrawnBlock
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Component, Enabled
from rovercheck.spec_model.lang.domain import Domain
from rovercheck.spec_model.lang.expr import Const, Expr, Named, Var


@dataclass
class DrawnCharts:
    """A model as a system of charts of the language, and what the engineer has written in them, by chart."""

    model: LoweredModel
    labels: Mapping[str, ChartLabels] = field(default_factory=dict)


def charts_of_model(lowered: LoweredModel, file: str, step: str = "") -> DrawnCharts:
    """The charts of a model that is lowered already, whose data have the same values.

    Raises ``NotLowered`` for what has no words in the language, with its place and a way around it.
    """
    if lowered.model.free or any(free_outputs(lowered.model)):
        raise NotLowered("it has free inputs in place of what is drawn: draw what is under `free` as Inports")
    written = {name: one for name, one in lowered.system.written.items() if name in lowered.taken}
    given = {name: one for name, one in lowered.inputs.items() if isinstance(one, Var)}
    domains = {name: one.domain for name, one in (written | given).items()}
    try:
        return _charts(lowered, file, step, domains, ChartTexts)
    except NotLowered:  # as where a size, or a number of turns, is one of the constants
        return _charts(lowered, file, step, domains, UnnamedTexts)


def _charts(
    lowered: LoweredModel, file: str, step: str, domains: Mapping[str, Domain], texts: type[ChartTexts]
) -> DrawnCharts:
    labels: dict[str, ChartLabels] = {}

    class _Writer(LanguageSystemWriter):
        found, texts_of = labels, texts

    made = lowered_model(lowered.model, file, domains, step, _Writer)
    told = [note for note in made.notes if note not in lowered.notes]
    if told:
        raise NotLowered(told[0].rstrip("."))
    return DrawnCharts(made, labels)


class LanguageSystemWriter(SystemWriter):
    """The components of one system, its charts as charts of the language; ``found`` are their labels."""

    found: dict[str, ChartLabels]
    texts_of: type[ChartTexts]

    def _writer(self, chart: ParsedChart, view: ChartView, writer: ProgramWriter) -> ChartWriter:
        self.writer_of = ChartWriter if chart.drawn.is_function else self.texts_of
        return super()._writer(chart, view, writer)

    def _chart(self, node: BlockNode) -> list[Component]:
        context, chart = self.context, self.context.chart(node.block.chart)
        if chart.drawn.is_function:
            return [self._plain(one) for one in super()._chart(node)]
        if output_events(chart.root):
            raise NotLowered(f"{chart.drawn.path} has an event to other blocks: write to a datum")
        name = context.names.of_chart(chart.drawn)
        view = ChartView(chart, name, context.file, context.table.starting)
        texts = self._writer(chart, view, ProgramWriter(name, context.most))
        assert isinstance(texts, ChartTexts)
        self._name_inputs(texts, chart, self._values(node))
        events = self._input_events(chart)
        if len(events) > 1:
            raise NotLowered(
                f"{chart.drawn.path} has {len(events)} input events, in whose order it executes: give each "
                "a chart, or make them data"
            )
        texts.event = events[0][0] if events else ""
        made = self._components(texts, chart, name)
        for one in chart.root.data.values():
            for leaf, cell in leaves(texts.cells[one.ssid], f"{name}.{one.name}"):
                context.data[leaf] = cell.expr
        node.outputs = [texts.cells[one.ssid] for one in chart.root.data.values() if one.scope == "output"]
        if not events:
            return made
        return [Enabled(self._any_event(node, chart), *made, name=name), *self._edges(node)]

    def _first_of_all(self, name: str, on: Var, components: Sequence[Component]) -> Block:
        raise NotLowered(f"the states of {name} begin anew when it is enabled: set that to held")

    def _generated(self, node: BlockNode) -> list[Component]:
        raise NotLowered("it generates function calls: have what it calls executed in each step")

    def _outside(
        self, block: DrawnBlock, rules: IntegerRules, conditions: Mapping[str, Expr]
    ) -> list[Component]:
        return []

    @staticmethod
    def _plain(one: Component) -> Component:
        """A block without the temporaries that formulas can do without."""
        if not isinstance(one, Block):
            return one
        temporaries = {var.name: var for var in one.temporaries}
        rows = [row for row in one.do if isinstance(row, Assign | If)]
        do = tidied_actions(actions_after(rows, temporaries, ()))
        left = {name for row in do if isinstance(row, Assign | If) for name in row.written | row.read_inside}
        kept = [var for name, var in temporaries.items() if name in left]
        return Block(one.name, do, text=one.text, temporaries=kept, place=one.place)

    def lowered(self, given: Sequence[Symbolic]) -> tuple[tuple[Component, ...], list[Symbolic]]:
        """The components in order, and the outputs, in as few words as will do."""
        components, ends = super().lowered(given)
        return tuple(map(self._tidy, components)), ends

    def delays(self) -> list[Component]:
        """What delays remember."""
        return list(map(self._plain, super().delays()))

    def _tidy(self, one: Component) -> Component:
        match one:
            case Enabled():
                inside = map(self._tidy, one.components)
                return Enabled(tidied(one.by), *inside, name=one.name, place=one.place)
            case Block():
                return self._plain(one)
        return one

    def _components(self, texts: ChartTexts, chart: ParsedChart, name: str) -> list[Component]:
        first = [*self._initial(texts, chart)]
        before: list[Component] = []
        if first:
            text = f"The outputs of {chart.drawn.path} begin anew in each step."
            before = [Block(f"{name}_outputs", first, text=text)]
        if not chart.root.children:
            block = Block(name, texts.flow_chart(), text=f"The flow chart {chart.drawn.path}.")
            return [*before, block]
        builder = ChartBuilder(texts)
        made = builder.chart()
        self.found[name] = builder.labels
        told = [one for one in chart.root.data.values() if one.activity_of is not None]
        active: list[Action] = []
        for one in told:
            target = single_of(texts.cells[one.ssid])
            writer = ProgramWriter(name)
            self.context.table.write(writer, target, texts.activity(one))
            active += writer.written()
        after = [Block(f"{name}_active", active, text="Which states are active.")] if active else []
        return [*before, made, *after]

    def _initial(self, texts: ChartTexts, chart: ParsedChart) -> Iterator[Action]:
        """Outputs that are set to their first values whenever the chart wakes up."""
        if chart.drawn.initializes_outputs:
            for one in chart.root.data.values():
                if one.scope == "output":
                    yield from texts.written(partial(texts.reset, one, chart.root))

    def _name_inputs(self, made: ChartTexts, chart: ParsedChart, values: Sequence[Symbolic]) -> None:
        """The inputs of a chart: variables, or formulas that have their names."""
        kinds, data = self.context.table.kinds, chart.root.data.values()
        for one, value in zip((d for d in data if d.scope == "input"), values, strict=False):
            fitted = self._fitted(value, one, made.rules)
            free = one.name not in self.context.names.data_written
            scalars = [self._named_input(leaf, s) if free else s for leaf, s in leaves(fitted, one.name)]
            made.cells[one.ssid] = filled(fitted, iter(scalars))
        for one in data:
            if one.scope == "input" and one.ssid not in made.cells:
                made.cells[one.ssid] = kinds.first_value(kinds.kind(one.type) or "double", *sizes(one.size))

    @staticmethod
    def _named_input(name: str, value: SymbolicScalar) -> SymbolicScalar:
        if isinstance(value.expr, Const | Named) or (isinstance(value.expr, Var) and value.expr.name == name):
            return value
        return SymbolicScalar(value.kind, Named(name, tidied(value.expr)))


__all__ = ["DrawnCharts", "LanguageSystemWriter", "charts_of_model"]
