"""Blocks that function calls of a chart execute: their statements, within those of the chart."""

from abc import abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Protocol

from rovercheck.checker.drawn.calls import FunctionCall, call_event, calls_of, iterations
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.lower.chart_blocks import ChartBlockWriter
from rovercheck.checker.drawn.lower.chart_functions import ExecutedFunction
from rovercheck.checker.drawn.lower.machine import ChartWriter
from rovercheck.checker.drawn.lower.program import ProgramPart, ProgramWriter, joined
from rovercheck.checker.drawn.lower.symbols import NotLowered, Symbolic, flat
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.lower.wired_blocks import BlockNode
from rovercheck.checker.drawn.parsed import ParsedChart, output_events
from rovercheck.checker.drawn.records import DrawnSystem
from rovercheck.checker.drawn.simulink_functions import simulink_functions
from rovercheck.spec_model.lang.action import Assign, If, each_action
from rovercheck.spec_model.lang.chart import Block, Component, Enabled
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.fired_transition import FiredTransition
from rovercheck.spec_model.lang.programmed import ProgrammedBlock, ProgrammedChart, StepProgram
from rovercheck.spec_model.lang.system import Statement


@dataclass
class ExecutedParts:
    """What some components do, as statements, and what these need: the charts keep only their states."""

    charts: list[ProgrammedChart] = field(default_factory=list)
    temporaries: dict[str, Var] = field(default_factory=dict)
    fired: dict[str, FiredTransition] = field(default_factory=dict)
    tested: dict[str, tuple[str, bool]] = field(default_factory=dict)
    rivals: dict[str, str] = field(default_factory=dict)
    overflows: dict[str, str] = field(default_factory=dict)

    def statements(self, components: Iterable[Component]) -> list[Statement]:
        """The statements of components in order."""
        found: list[Statement] = []
        for one in components:
            match one:
                case Enabled(by=by, components=inside):
                    found.append(If(by, tuple(self.statements(inside))))
                case ProgrammedBlock(marked=marked, temporaries=temporaries):
                    found += marked
                    self.temporaries |= {var.name: var for var in temporaries}
                    self.overflows |= one.overflows
                case Block(do=do, temporaries=temporaries):
                    found += (action for action in do if isinstance(action, Assign | If))
                    self.temporaries |= {var.name: var for var in temporaries}
                case ProgrammedChart(program=program):
                    found += program.statements
                    self.add(one)
        return found

    def add(self, chart: ProgrammedChart) -> None:
        """A chart of which the statements are executed elsewhere."""
        program = chart.program
        self.temporaries |= {var.name: var for var in program.temporaries}
        self.fired |= program.fired
        self.tested |= program.tested
        self.rivals |= program.rivals
        self.overflows |= program.overflows
        self.charts.append(chart.with_program(StepProgram((), starting=program.starting)))


class InnerSystem(Protocol):
    """What writes a system of blocks."""

    def lowered(self, given: Sequence[Symbolic]) -> tuple[tuple[Component, ...], list[Symbolic]]:
        """The components in order, and the outputs."""

    def delays(self) -> list[Component]:
        """What its delays remember, once all else is done."""


def _part(statements: list[Statement]) -> ProgramPart:
    return statements, sum(1 for _ in each_action(statements))


class CalledBlockWriter(ChartBlockWriter):
    """The blocks of one system that charts in it call."""

    @abstractmethod
    def _inner(self, name: str, system: DrawnSystem) -> "InnerSystem":
        """The writer of a system in this one, which is in a block of that name."""

    @abstractmethod
    def _inside(self, node: BlockNode, system: DrawnSystem) -> list[Component]:
        """All that a subsystem does in a step in which it is executed; its outputs keep their values."""

    def _calls_of(self, node: BlockNode, chart: ParsedChart) -> dict[str, Sequence[FunctionCall]]:
        wiring, outputs = self._wiring, sum(one.scope == "output" for one in chart.root.data.values())
        blocks = {name: one.block for name, one in self._by_id.items()}
        try:
            return calls_of(
                node.block, outputs, output_events(chart.root), wiring.feeds, wiring.calls, blocks
            )
        except DrawnFault as fault:
            raise NotLowered(str(fault)) from fault

    def _call_all(self, node: BlockNode, chart: ParsedChart, made: ChartWriter) -> list[ProgrammedChart]:
        calls, parts = self._calls_of(node, chart), ExecutedParts()
        made.executed = self._functions(node, chart, made, parts)
        written = self._written([call for some in calls.values() for call in some], parts)
        made.called = {name: joined(*(written[call] for call in some)) for name, some in calls.items()}
        made.borrowed = parts.temporaries
        made.writer.temporaries |= parts.temporaries
        made.view.fired |= parts.fired
        made.view.tested |= parts.tested
        made.view.rivals |= parts.rivals
        made.view.overflows |= parts.overflows
        return parts.charts

    def _written(
        self, calls: Sequence[FunctionCall], parts: ExecutedParts
    ) -> dict[FunctionCall, ProgramPart]:  # fmt: skip
        """What each of some calls has executed."""
        written: dict[FunctionCall, ProgramPart] = {}
        for target in self._in_order({call.target for call in calls}):
            own = [call for call in calls if call.target == target]
            written |= zip(own, self._called(self._by_id[target], own, parts), strict=True)
        return written

    def _generated(self, node: BlockNode) -> list[Component]:
        """What a generator of function calls calls in each step."""
        parts, calls = ExecutedParts(), self._wiring.calls.get((node.block.id, 1), ())
        number = flat(self.context.value_of(node.block.parameters.get("numberOfIterations", "1")))
        try:
            times = iterations(number[0].constant if len(number) == 1 else None)
        except DrawnFault as fault:
            raise NotLowered(str(fault)) from fault
        written = self._written(calls, parts)
        statements, _ = joined(*[written[call] for call in calls] * times)
        temporaries = tuple(parts.temporaries.values())
        if not parts.charts:
            name = self._named(node.block)
            return [ProgrammedBlock(name, tuple(statements), parts.overflows, temporaries=temporaries)]
        *others, last = parts.charts  # the last stands for all: only charts may enter states
        places = tuple(place for one in others for place in (one.entered, *one.locations))
        program = StepProgram(
            tuple(statements), temporaries, last.program.starting, parts.fired, parts.tested, parts.rivals,
            parts.overflows, places,
        )  # fmt: skip
        return [*others, last.with_program(program)]

    def _functions(
        self, node: BlockNode, chart: ParsedChart, made: ChartWriter, parts: ExecutedParts
    ) -> dict[int, ExecutedFunction]:
        """The Simulink functions of a chart."""
        found = {}
        try:
            every = list(simulink_functions(node.block, chart))
        except DrawnFault as fault:
            raise NotLowered(str(fault)) from fault
        for one in every:
            given = [made.cells[one.node.data[name].ssid] for name in one.inputs]
            inner = self._inner(f"{node.block.name}_{one.node.signature.name}", one.system)
            components, ends = inner.lowered(given)
            step, after = (_part(parts.statements(some)) for some in (components, inner.delays()))
            outputs = dict(zip(one.outputs, ends, strict=True))
            found[one.node.drawn.ssid] = ExecutedFunction(step, outputs, after)
        return found

    def _in_order(self, targets: Iterable[str]) -> list[str]:
        """Each block after those that feed it, of those that one chart calls."""
        waiting, found = sorted(targets), list[str]()
        while waiting:
            feeding = {
                target: {port[0] for port in self._by_id[target].inputs if port is not None}
                for target in waiting
            }
            ready = [target for target in waiting if not feeding[target] & {*waiting} - {target}]
            if not ready:
                told = " and ".join(self._by_id[one].block.shown for one in waiting)
                raise NotLowered(f"{told} feed each other, and are called by one chart: put a delay between")
            found += ready
            waiting = [one for one in waiting if one not in ready]
        return found

    def _called(
        self, node: BlockNode, calls: Sequence[FunctionCall], parts: ExecutedParts
    ) -> list[ProgramPart]:
        """What a block does for each of some calls."""
        with self._told(node):
            if node.block.chart:
                return self._called_chart(node, calls, parts)
            assert node.block.system is not None
            return [_part(parts.statements(self._inside(node, node.block.system)))] * len(calls)

    def _called_chart(
        self, node: BlockNode, calls: Sequence[FunctionCall], parts: ExecutedParts
    ) -> list[ProgramPart]:
        context, chart = self.context, self.context.chart(node.block.chart)
        events = [one for one in chart.root.events.values() if one.scope == "input"]
        try:
            names = [call_event(node.block.shown, events, call.event) for call in calls]
        except DrawnFault as fault:
            raise NotLowered(str(fault)) from fault
        name = context.names.of_chart(chart.drawn)
        view = ChartView(chart, name, context.file, context.table.starting)
        writer = ProgramWriter(name, context.most)
        made = self._writer(chart, view, writer)
        node.outputs = self._outputs_of(made)
        feed = partial(self._feed, made, chart, node)
        if chart.drawn.is_function:

            def run() -> None:
                feed()
                made.run_block()

            found = [writer.alone(run)] * len(calls)
            parts.temporaries |= writer.temporaries
            parts.overflows |= view.overflows
        else:
            others = self._call_all(node, chart, made)
            found = made.woken(names, feed)
            parts.add(self._programmed(made, (), others))
            parts.charts += others
            context.views[name] = view
            if chart.drawn.at_initialization:
                self._start(node, made)
        self._tell(made)
        return found


__all__ = ["CalledBlockWriter", "ExecutedParts"]
