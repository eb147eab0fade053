"""A whole model at work: its diagram, its charts, its MATLAB functions, tick by tick."""

from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field
from fractions import Fraction

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.grammar.syntax import Expression
from rovercheck.checker.drawn.interpret.blocks import BLOCKS, parsed_value
from rovercheck.checker.drawn.interpret.evaluate import CallFrame
from rovercheck.checker.drawn.interpret.machine import ChartMachine
from rovercheck.checker.drawn.interpret.memory import ChartMemory, TypeTable, dimensions
from rovercheck.checker.drawn.interpret.statements import StatementRunner
from rovercheck.checker.drawn.interpret.values import (
    TYPES,
    MatlabValue,
    NumberRules,
    Structure,
    array,
    double,
    each_converted,
    scalars,
    shape,
)
from rovercheck.checker.drawn.parameters import expanded, rate_of, values_of
from rovercheck.checker.drawn.parsed import FunctionNode, StateNode, parsed_chart
from rovercheck.checker.drawn.records import DrawnBlock, DrawnChart, DrawnModel, DrawnSystem
from rovercheck.checker.drawn.refused import notes_of
from rovercheck.checker.drawn.wiring import DELAYS, SystemWiring, number_of, wired

Number = int | float
FUNCTIONS = ("MATLAB function", "truth table")
"""Charts that are one function each, without states."""


class ModelRunner:
    """Runs a model from its power-up.  Inputs and outputs have flat names: ``probe.level``, ``force(2)``.

    Raises ``DrawnFault``, here and in each step, for what has no meaning.
    """

    def __init__(self, model: DrawnModel, step: str = "") -> None:
        self.model, self.types = model, TypeTable.of(model)
        self.step_length = step or model.step
        self.named = values_of(model)
        for note in notes_of(model):
            if note.kind == "refused":
                raise DrawnFault(str(note).rstrip("."))
        self._top = _System(model.system, self)
        root = {number_of(one): one for one in model.system.blocks if one.kind == "Inport"}
        self._inports = [root[number] for number in sorted(root)]
        every = [one for one in model.system.blocks if one.kind == "Outport"]
        ends = {number_of(one): one for one in every}
        if len(ends) < len(every):
            raise DrawnFault("two Outports have one number: give each its own")
        self._outports = [ends[number] for number in sorted(ends)]
        self._top.initialize([self._at_rest(port) for port in self._inports])

    def inputs(self) -> Iterator[str]:
        """The flat names of all inputs, in the order of their ports."""
        for port in self._inports:
            yield from (name for name, _ in _flat(port.shown, self._at_rest(port)))

    def step(self, given: Mapping[str, Number]) -> dict[str, Number]:
        """One step: the outputs by their flat names.  An input that is not given is as at rest."""
        values = [self._filled(port.shown, self._at_rest(port), given) for port in self._inports]
        found = self._top.step(values)
        pairs = zip(self._outports, found, strict=True)
        return {name: one for port, value in pairs for name, one in _flat(port.shown, value)}

    def _at_rest(self, port: DrawnBlock) -> MatlabValue:
        kind = self.types.kind(port.parameters.get("OutDataTypeStr", "Inherit")) or "double"
        size = port.parameters.get("PortDimensions", "-1")
        return self.types.initial(kind, *dimensions(size))

    def _filled(self, name: str, at_rest: MatlabValue, given: Mapping[str, Number]) -> MatlabValue:
        if isinstance(at_rest, Structure):
            elements = {
                key: self._filled(f"{name}.{key}", one, given) for key, one in at_rest.elements.items()
            }
            return Structure(at_rest.kind, elements)
        found = [
            each_converted(double(given[key]), one.kind, NumberRules()) if key in given else one
            for (key, _), one in zip(_flat(name, at_rest), scalars(at_rest), strict=True)
        ]
        return array([one for value in found for one in scalars(value)], *shape(at_rest))

    def outputs(self) -> tuple[str, ...]:
        """The names of the outputs, as blocks."""
        return tuple(port.shown for port in self._outports)

    @property
    def fired(self) -> list[str]:
        """The transitions that charts took in the last step, flow charts too."""
        return [str(one) for machine in self.machines for one in machine.fired]

    @property
    def machines(self) -> list[ChartMachine]:
        """The charts at work, in their order of execution."""
        return list(self._top.machines())

    # --- what blocks need ----------------------------------------------------------------------------------

    def chart(self, path: str) -> DrawnChart:
        """The chart of a block.  Raises ``DrawnFault``."""
        found = [one for one in self.model.charts if one.path == path]
        if len(found) != 1:
            raise DrawnFault(f"the block {path} has no chart in the file")
        return found[0]

    def value_of(self, text: str) -> MatlabValue:
        """The value of a parameter.  Raises ``DrawnFault``."""
        tree = parsed_value(expanded(text, self.named))
        runner = StatementRunner(_NoChart.memory(self.types), _NoChart())
        return runner.value(tree, CallFrame(StateNode(0, "", "", None), NumberRules()))


def _flat(name: str, value: MatlabValue) -> Iterator[tuple[str, Number]]:
    if isinstance(value, Structure):
        for key, one in value.elements.items():
            yield from _flat(f"{name}.{key}", one)
        return
    found = scalars(value)
    for number, one in enumerate(found, 1):
        yield (name if len(found) == 1 else f"{name}({number})"), one.value


@dataclass
class _Node:
    """A block at work: ``inputs`` are what feeds its input ports, ``typed`` that its outputs have types."""

    block: DrawnBlock
    inputs: list[tuple[str, int] | None]
    system: "_System | None" = None
    chart: ChartMachine | None = None
    control: str = ""
    fed: tuple[str, int] | None = None
    """What feeds its control port."""
    trigger: str = "rising"
    memory: MatlabValue | None = None
    outputs: list[MatlabValue] = field(default_factory=list)
    typed: bool = False
    was: list[float] = field(default_factory=list)
    """The values of its trigger in the step before."""


class _System:
    """The blocks of a system with their values."""

    def __init__(self, system: DrawnSystem, runner: ModelRunner) -> None:
        self._runner = runner
        wiring = wired(system)
        self._nodes = [self._node(block, wiring) for block in wiring.order]
        self._by_id = {node.block.id: node for node in self._nodes}
        ends = [node for node in self._nodes if node.block.kind == "Outport"]
        self._ends = sorted(ends, key=lambda node: number_of(node.block))
        for node in self._nodes:
            if node.chart is not None:
                node.outputs = _outputs_of(node.chart)
            elif node.system is not None:
                node.outputs = node.system.at_rest()

    def _node(self, block: DrawnBlock, wiring: SystemWiring) -> _Node:
        self._check(block)
        node = _Node(block, wiring.inputs_of(block))
        control = [port for target, port in wiring.feeds if target == block.id and not port.isdigit()]
        if control:
            node.control, node.fed = control[0], wiring.feeds[block.id, control[0]]
        if block.chart:
            chart = parsed_chart(self._runner.chart(block.chart))
            if chart.notes:
                raise DrawnFault(str(chart.notes[0]))
            runner = self._runner
            node.chart = ChartMachine(chart, runner.types, runner.step_length, runner.named)
        elif block.kind == "SubSystem" and block.system is not None:
            node.system = _System(block.system, self._runner)
            ports_ = [one for one in block.system.blocks if one.kind == "TriggerPort"]
            node.trigger = ports_[0].parameters.get("TriggerType", "rising") if ports_ else ""
        elif block.kind in DELAYS:
            node.memory = self._runner.value_of(block.parameters.get("InitialCondition", "0"))
        elif block.kind not in BLOCKS and block.kind not in ("Inport", "Outport", *_CONTROLS):
            raise DrawnFault(f"the block {block.path}: {block.kind} is not known here")
        return node

    def _check(self, block: DrawnBlock) -> None:
        """Refuse what would make a block run at another rate, or begin anew.  Raises ``DrawnFault``."""
        path, parameters = " ".join(block.path.split()), block.parameters
        written = parameters.get("SampleTime", "-1")
        if block.chart and (chart := self._runner.chart(block.chart)).update == "discrete":
            written = chart.sample_time.strip() or "-1"
        rate = rate_of(written, self._runner.named)
        if rate not in ("-1", "0", "inf") and not _same_number(rate, self._runner.step_length):
            step = self._runner.step_length
            raise DrawnFault(
                f"the block {path} runs every {rate} s, and the model every {step} s: give them one rate"
            )
        for name, kind in (("StatesWhenEnabling", "EnablePort"), ("OutputWhenDisabled", "Outport")):
            if block.kind == kind and parameters.get(name, "held") == "reset":
                raise DrawnFault(f"the block {path}: {name} = reset is not known here; held is")

    def at_rest(self) -> list[MatlabValue]:
        """The outputs of a system that was not executed yet."""
        found: list[MatlabValue] = []
        for node in self._ends:
            written = node.block.parameters.get("InitialOutput", "[]").strip()
            source = None if node.inputs[:1] in ([], [None]) else self._by_id[_port(node)[0]]
            if written != "[]":
                found.append(self._runner.value_of(written))
            elif source is None or not (source.outputs or source.memory is not None):
                found.append(double(0))
            else:
                found.append(self._value(_port(node)))
        return found

    def initialize(self, inputs: Sequence[MatlabValue] = ()) -> None:
        """Charts that are so drawn are entered before the first step, with inputs at rest."""
        for node in self._nodes:
            if node.chart is not None and node.chart.chart.drawn.kind not in FUNCTIONS:
                if node.chart.chart.drawn.at_initialization:
                    self._feed_at_rest(node, node.chart, inputs)
                node.chart.initialize()
                node.outputs = _outputs_of(node.chart)
            if node.system is not None:
                node.system.initialize()
                node.outputs = node.system.at_rest()

    def _feed_at_rest(self, node: _Node, machine: ChartMachine, inputs: Sequence[MatlabValue]) -> None:
        """What comes straight from an input of the model has its type already."""
        data = [one for one in machine.chart.root.data.values() if one.scope == "input"]
        for one, port in zip(data, node.inputs, strict=False):
            block = None if port is None else self._by_id[port[0]].block
            if block is not None and block.kind == "Inport" and number_of(block) <= len(inputs):
                machine.memory.write(one.ssid, inputs[number_of(block) - 1])

    def machines(self) -> Iterator[ChartMachine]:
        """The charts here and in subsystems, in their order of execution."""
        for node in self._nodes:
            if node.chart is not None:
                yield node.chart
            if node.system is not None:
                yield from node.system.machines()

    def step(self, inputs: Sequence[MatlabValue]) -> list[MatlabValue]:
        """The outputs of the system in one step."""
        for node in self._nodes:
            try:
                node.outputs = self._executed(node, inputs)
            except DrawnFault as fault:
                raise DrawnFault(f"{' '.join(node.block.path.split())}: {fault}") from fault
        found = [self._values(node)[0] for node in self._ends]
        delays = [node for node in self._nodes if node.block.kind in DELAYS]
        for node, values in [(node, self._values(node)) for node in delays]:
            [node.memory] = values or [double(0)]
        return found

    def _executed(self, node: _Node, inputs: Sequence[MatlabValue]) -> list[MatlabValue]:
        block = node.block
        if block.kind == "Inport":
            return [inputs[number_of(block) - 1]]
        if node.memory is not None:
            return [self._remembered(node)]
        if block.kind == "Outport" or block.kind in _CONTROLS:
            return []
        values = self._values(node)
        if node.chart is not None:
            return self._charted(node, node.chart, values)
        if node.system is not None:
            if self._runs(node):
                node.typed = True
                return node.system.step(values)
            if not node.typed:
                node.typed, node.outputs = True, self._typed(node, node.system, values)
            return node.outputs
        try:
            return BLOCKS[block.kind](block, values, self._runner.types, self._runner.value_of)
        except (IndexError, KeyError, ValueError) as error:  # as a Gain without an input
            raise DrawnFault("its inputs and parameters do not fit each other") from error

    def _typed(self, node: _Node, system: "_System", values: Sequence[MatlabValue]) -> list[MatlabValue]:
        """The outputs of a system before its first step: 0 in the types that a step would give them."""
        try:
            given = deepcopy(system, {id(self._runner): self._runner}).step(values)
        except DrawnFault:
            return node.outputs
        first, both = self._runner.types.initial, zip(node.outputs, given, strict=True)
        return [first(b.kind, *shape(b)) if a.kind == "double" != b.kind else a for a, b in both]

    @staticmethod
    def _remembered(node: _Node) -> MatlabValue:
        assert node.memory is not None
        return node.memory

    def _values(self, node: _Node) -> list[MatlabValue]:
        """Of its inputs; one that is not connected is 0, in the type of the first that is."""
        found = [None if port is None else self._value(port) for port in node.inputs]
        kind = next((one.kind for one in found if one is not None), "double")
        zero = each_converted(double(0), kind, NumberRules()) if kind in TYPES else double(0)
        return [zero if one is None else one for one in found]

    def _value(self, port: tuple[str, int]) -> MatlabValue:
        node = self._by_id[port[0]]
        if node.memory is not None:
            return node.memory
        return node.outputs[port[1] - 1]

    def _runs(self, node: _Node) -> bool:
        """Whether a subsystem is executed in this step."""
        if not node.control or node.fed is None:
            return True
        now = [float(one.value) for one in scalars(self._value(node.fed))]
        if node.control == "enable":
            return any(one > 0 for one in now)
        if node.control == "trigger":
            before, node.was = node.was, now
            return any(_edge(node.trigger, a, b) for a, b in zip(before, now, strict=False))
        raise DrawnFault(f"a subsystem that is controlled by {node.control} is not known here")

    def _charted(
        self, node: _Node, machine: ChartMachine, values: Sequence[MatlabValue]
    ) -> list[MatlabValue]:
        data = machine.chart.root.data
        for one, value in zip((d for d in data.values() if d.scope == "input"), values, strict=False):
            machine.memory.write(one.ssid, value)
        if machine.chart.drawn.kind in FUNCTIONS:
            machine.run_block()
        else:
            events = self._events(node, machine)
            if events is None:
                machine.step()
            elif events:
                machine.step(events)
        return _outputs_of(machine)

    def _events(self, node: _Node, machine: ChartMachine) -> list[str] | None:
        """The input events of this step; ``None`` for a chart without any, which runs in every step."""
        every = [one for one in machine.chart.root.events.values() if one.scope == "input"]
        if not every:
            return None
        now = [] if node.fed is None else [float(one.value) for one in scalars(self._value(node.fed))]
        before, node.was = node.was, now
        found = zip(every, before, now, strict=False)
        return [one.name for one, old, new in found if _edge(one.trigger, old, new)]


def _outputs_of(machine: ChartMachine) -> list[MatlabValue]:
    """The values of a chart's outputs, in the order of their ports; those of events are the last."""
    data = machine.chart.root.data.values()
    found = [machine.memory.values[one.ssid] for one in data if one.scope == "output"]
    return [*found, *machine.output_events.signals()]


def _same_number(one: str, other: str) -> bool:
    try:
        return Fraction(one) == Fraction(other)
    except (ValueError, ZeroDivisionError):
        return False


def _port(node: _Node) -> tuple[str, int]:
    port = node.inputs[0]
    assert port is not None
    return port


_CONTROLS = ("EnablePort", "TriggerPort", "ActionPort")


def _edge(kind: str, before: float, now: float) -> bool:
    """Whether a signal rises or falls through 0 as a trigger of a kind asks for."""
    if kind in ("function call", "function-call"):
        raise DrawnFault("an event that is a function call is not known here")
    rises, falls = before <= 0 < now, before > 0 >= now
    return {"rising": rises, "falling": falls}.get(kind, rises or falls)


class _NoChart:
    """Where a parameter stands: in no chart."""

    @staticmethod
    def memory(types: TypeTable) -> ChartMemory:
        """No data at all."""
        return ChartMemory(types, NumberRules())

    def word(self, expression: Expression, frame: CallFrame) -> MatlabValue | None:
        """There are no words of a chart."""
        return None

    def sent(self, expression: Expression, frame: CallFrame) -> bool:
        """There are no events."""
        return False

    def call(self, function: FunctionNode, arguments: Sequence[MatlabValue], calls: int) -> list[MatlabValue]:
        """Raises ``DrawnFault``: there are no functions."""
        raise DrawnFault(f"{function.signature.name} is not known here")


__all__ = ["ModelRunner"]
