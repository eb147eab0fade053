"""The blocks of one system at work: charts, subsystems and what is around them, step by step."""

from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from functools import partial
from typing import Protocol

from rovercheck.checker.drawn.calls import (
    GENERATOR,
    FunctionCall,
    call_event,
    calls_of,
    is_called,
    iterations,
    rate_said,
)
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.free import FREE_BLOCK
from rovercheck.checker.drawn.interpret.block import BlockAtWork, edge, told
from rovercheck.checker.drawn.interpret.blocks import BLOCKS
from rovercheck.checker.drawn.interpret.delays import without_type
from rovercheck.checker.drawn.interpret.machine import ChartMachine
from rovercheck.checker.drawn.interpret.memory import FreeValues, TypeTable
from rovercheck.checker.drawn.interpret.stores import StoresAtWork
from rovercheck.checker.drawn.interpret.values import (
    TYPES,
    MatlabValue,
    NumberRules,
    double,
    each_converted,
    scalars,
    shape,
)
from rovercheck.checker.drawn.interpret.wake import outputs_of, woken
from rovercheck.checker.drawn.merges import UNSAID, merged
from rovercheck.checker.drawn.parameters import rate_of, same_number
from rovercheck.checker.drawn.parsed import output_events, parsed_chart
from rovercheck.checker.drawn.records import DrawnBlock, DrawnChart, DrawnSystem
from rovercheck.checker.drawn.resets import begins_anew, is_reset, resets_refused
from rovercheck.checker.drawn.simulink_functions import SimulinkFunction, simulink_functions
from rovercheck.checker.drawn.store_order import MEMORY, READ, WRITE
from rovercheck.checker.drawn.wiring import CONTROL, DELAYS, SystemWiring, number_of, wired


class SharedParts(Protocol):
    """What all systems of a model share."""

    types: TypeTable
    stores: StoresAtWork
    step_length: str
    named: dict[str, str]
    free: FreeValues

    def chart(self, path: str) -> DrawnChart:
        """The chart of a block.  Raises ``DrawnFault``."""

    def value_of(self, text: str) -> MatlabValue:
        """The value of a parameter.  Raises ``DrawnFault``."""


OTHERS = (GENERATOR, FREE_BLOCK, "Inport", "Outport", "Merge", MEMORY, READ, WRITE, *CONTROL)
"""The kinds of blocks that do more than compute their outputs from their inputs."""


class SystemAtWork:
    """The blocks of a system with their values."""

    def __init__(self, system: DrawnSystem, runner: SharedParts) -> None:
        self._runner, self._turns = runner, 0
        wiring = wired(system, runner.stores.stores.used)
        self._nodes = [self._node(block, wiring) for block in wiring.order]
        self._by_id = {node.block.id: node for node in self._nodes}
        ends = [node for node in self._nodes if node.block.kind == "Outport"]
        self._ends = sorted(ends, key=lambda node: number_of(node.block))
        blocks = {name: node.block for name, node in self._by_id.items()}
        for node in self._nodes:
            if node.block.kind == "Merge":
                with told(node):
                    merged(node.block, node.inputs, blocks)
            if node.chart is not None:
                node.calls = self._calls_of(node.block, node.chart, wiring)
                node.outputs = outputs_of(node.chart)
            elif node.system is not None:
                node.outputs = node.system.at_rest()
            elif node.block.kind == GENERATOR:
                node.calls = {GENERATOR: wiring.calls.get((node.block.id, 1), ())}

    def _node(self, block: DrawnBlock, wiring: SystemWiring) -> BlockAtWork:
        self._check(block)
        node = BlockAtWork(block, wiring.inputs_of(block), called=block.id in wiring.called)
        control = [port for target, port in wiring.feeds if target == block.id and not port.isdigit()]
        if control:
            node.control, node.fed = control[0], wiring.feeds[block.id, control[0]]
        if block.chart:
            chart = parsed_chart(self._runner.chart(block.chart))
            if chart.notes:
                raise DrawnFault(str(chart.notes[0]))
            of = self._runner
            shared = of.stores.of(chart)
            node.chart = ChartMachine(chart, of.types, of.step_length, of.named, of.free, shared)
            for function in simulink_functions(block, chart):
                inside = SystemAtWork(function.system, of)
                node.functions.append(inside)
                node.chart.executed[function.node.drawn.ssid] = partial(_executed, function, inside)
        elif block.kind == "SubSystem" and block.system is not None:
            node.system = SystemAtWork(block.system, self._runner)
            ports_ = [one for one in block.system.blocks if one.kind == "TriggerPort"]
            node.trigger = ports_[0].parameters.get("TriggerType", "rising") if ports_ else ""
        elif block.kind in DELAYS:
            node.memory = without_type(self._runner.value_of(block.parameters.get("InitialCondition", "0")))
        elif block.kind not in (*BLOCKS, *OTHERS):
            raise DrawnFault(f"the block {block.path}: {block.kind} is not known here")
        return node

    def _calls_of(
        self, block: DrawnBlock, machine: ChartMachine, wiring: SystemWiring
    ) -> Mapping[str, Sequence[FunctionCall]]:
        outputs = sum(one.scope == "output" for one in machine.chart.root.data.values())
        blocks = {name: node.block for name, node in self._by_id.items()}
        events = output_events(machine.chart.root)
        return calls_of(block, outputs, events, wiring.feeds, wiring.calls, blocks)

    def _check(self, block: DrawnBlock) -> None:
        """Refuse what would make a block run at another rate, or begin anew.  Raises ``DrawnFault``."""
        path = block.shown_path
        written = rate_said(block)
        if block.chart and (chart := self._runner.chart(block.chart)).update == "discrete":
            written = chart.sample_time.strip() or "-1"
        rate = rate_of(written, self._runner.named)
        if rate not in ("-1", "0", "inf") and not same_number(rate, self._runner.step_length):
            step = self._runner.step_length
            raise DrawnFault(
                f"the block {path} runs every {rate} s, and the model every {step} s: give them one rate"
            )
        if block.system is not None and not block.chart and (said := resets_refused(block.system)):
            raise DrawnFault(f"the block {path}: {said}")

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

    def disabled(self, outputs: Sequence[MatlabValue]) -> list[MatlabValue]:
        """The outputs in a step in which the system is disabled: some begin anew."""
        return [
            each_converted(
                self._runner.value_of(end.block.parameters["InitialOutput"]), now.kind, NumberRules()
            )
            if begins_anew(end.block)
            else now
            for end, now in zip(self._ends, outputs, strict=True)
        ]

    def initialize(self, inputs: Sequence[MatlabValue] = ()) -> None:
        """Charts that are so drawn are entered before the first step, with inputs at rest."""
        for node in self._nodes:
            for one in node.functions:
                one.initialize()
            if node.chart is not None and not node.chart.chart.drawn.is_function:
                if node.chart.chart.drawn.at_initialization:
                    self._feed_at_rest(node, node.chart, inputs)
                node.chart.initialize()
                node.outputs = outputs_of(node.chart)
            if node.system is not None:
                node.system.initialize()
                node.outputs = node.system.at_rest()
        for node in self._nodes:
            if node.chart is not None:
                node.chart.output_events.call = partial(self._call, node)

    def _feed_at_rest(self, node: BlockAtWork, machine: ChartMachine, inputs: Sequence[MatlabValue]) -> None:
        """What comes straight from an input of the model has its type already."""
        data = [one for one in machine.chart.root.data.values() if one.scope == "input"]
        for one, port in zip(data, node.inputs, strict=False):
            block = None if port is None else self._by_id[port[0]].block
            if block is not None and block.kind == "Inport" and number_of(block) <= len(inputs):
                machine.memory.receive(one.ssid, inputs[number_of(block) - 1])

    def nodes(self) -> Iterator[BlockAtWork]:
        """The blocks here and in subsystems, in their order of execution."""
        for node in self._nodes:
            yield node
            for one in (*node.functions, node.system):
                yield from () if one is None else one.nodes()

    def begin_anew(self) -> None:
        """All is as before the first step: what charts and delays remember."""
        for node in self._nodes:
            if node.memory is not None:
                first = self._runner.value_of(node.block.parameters.get("InitialCondition", "0"))
                plain = node.memory.kind in TYPES
                node.memory = each_converted(first, node.memory.kind, NumberRules()) if plain else first
            elif node.chart is not None:
                node.chart.begin_anew()
                node.outputs = outputs_of(node.chart)
            elif node.system is not None:
                node.system.begin_anew()

    def machines(self) -> Iterator[ChartMachine]:
        """The charts here and in subsystems, in their order of execution."""
        return (node.chart for node in self.nodes() if node.chart is not None)

    def step(self, inputs: Sequence[MatlabValue]) -> list[MatlabValue]:
        """The outputs of the system in one step."""
        for node in self._nodes:
            if node.tried or not node.called:
                with told(node):
                    node.outputs = self._executed(node, inputs)
        found = [self._values(node)[0] for node in self._ends]
        delays = [node for node in self._nodes if node.block.kind in DELAYS]
        for node, values in [(node, self._values(node)) for node in delays]:
            [node.memory] = values or [double(0)]
        return found

    def _executed(self, node: BlockAtWork, inputs: Sequence[MatlabValue]) -> list[MatlabValue]:
        block = node.block
        if block.kind == "Inport":
            return [inputs[number_of(block) - 1]]
        if node.memory is not None:
            return [node.memory]
        if block.kind in ("Outport", MEMORY, *CONTROL):
            return []
        values = self._values(node)
        if block.kind == GENERATOR:
            written = block.parameters.get("numberOfIterations", "1")
            number = scalars(self._runner.value_of(written))
            for _ in range(iterations(number[0].value if len(number) == 1 else None)):
                self._call(node, GENERATOR)
            return []
        if block.kind in (READ, WRITE):
            return self._runner.stores.executed(block, values)
        if node.chart is not None:
            return self._charted(node, node.chart, values)
        if node.system is not None:
            if self._runs(node):
                self._begin(node)
                return node.system.step(values)
            if not node.typed:
                node.typed, node.outputs = True, self._typed(node, node.system, values)
            return node.system.disabled(node.outputs) if node.control == "enable" else node.outputs
        if block.kind == "Merge":
            return [self._merged(node)]
        if block.kind == FREE_BLOCK:
            return self._runner.free.of_block(block, self._runner.types)
        try:
            return BLOCKS[block.kind](block, values, self._runner.types, self._runner.value_of)
        except (IndexError, KeyError, ValueError) as error:  # as a Gain without an input
            raise DrawnFault("its inputs and parameters do not fit each other") from error

    def _begin(self, node: BlockAtWork) -> None:
        self._turns += 1
        node.turn, node.typed = self._turns, True

    def _merged(self, node: BlockAtWork) -> MatlabValue:
        """What the subsystem gives that was executed last."""
        ports = [port for port in node.inputs if port is not None]
        last = max(ports, key=lambda port: self._by_id[port[0]].turn)
        now = self._value(last)
        if {one.kind for one in map(self._value, ports)} != {now.kind}:
            raise DrawnFault("its inputs have several types: give them one")
        written = node.block.parameters.get("InitialOutput", UNSAID).strip()
        if self._by_id[last[0]].turn or written == UNSAID:
            return now
        return each_converted(self._runner.value_of(written), now.kind, NumberRules())

    def _typed(
        self, node: BlockAtWork, system: "SystemAtWork", values: Sequence[MatlabValue]
    ) -> list[MatlabValue]:
        """The outputs of a system before its first step: 0 in the types that a step would give them."""
        try:
            with self._runner.stores.kept():
                given = deepcopy(system, {id(self._runner): self._runner}).step(values)
        except DrawnFault:
            return node.outputs
        pairs = zip(node.outputs, given, strict=True)
        first = self._runner.types.initial
        return [
            first(one.kind, *shape(one)) if now.kind == "double" != one.kind else now for now, one in pairs
        ]

    def _values(self, node: BlockAtWork) -> list[MatlabValue]:
        """Of its inputs; one that is not connected is 0, in the type of the first that is."""
        found = [None if port is None else self._value(port) for port in node.inputs]
        kind = next((one.kind for one in found if one is not None), "double")
        zero = each_converted(double(0), kind, NumberRules()) if kind in TYPES else double(0)
        return [zero if one is None else one for one in found]

    def _value(self, port: tuple[str, int]) -> MatlabValue:
        node = self._by_id[port[0]]
        if node.memory is not None:
            return node.memory
        if node.called and not node.typed and node.system is not None:
            node.typed = True
            node.outputs = self._typed(node, node.system, self._values(node))
        return node.outputs[port[1] - 1]

    def _runs(self, node: BlockAtWork) -> bool:
        """Whether a subsystem is executed in this step."""
        if node.tried:
            return True
        if is_called(node.block):
            return False  # and nothing calls it
        if not node.control or node.fed is None:
            return True
        now = [float(one.value) for one in scalars(self._value(node.fed))]
        if node.control == "enable":
            was, node.on = node.on, any(one > 0 for one in now)
            inside = node.block.system
            if node.on and not was and inside is not None and is_reset(inside) and node.system is not None:
                node.system.begin_anew()
            return node.on
        if node.control == "trigger":
            before, node.was = node.was, now
            return any(edge(node.trigger, a, b) for a, b in zip(before, now, strict=False))
        raise DrawnFault(f"a subsystem that is controlled by {node.control} is not known here")

    def _charted(
        self, node: BlockAtWork, machine: ChartMachine, values: Sequence[MatlabValue]
    ) -> list[MatlabValue]:
        self._feed(machine, values)
        return woken(machine, self._events(node, machine))

    @staticmethod
    def _feed(machine: ChartMachine, values: Sequence[MatlabValue | None]) -> None:
        """The values of a chart's inputs; ``None``: one that stays as it is."""
        data = machine.chart.root.data.values()
        for one, value in zip((d for d in data if d.scope == "input"), values, strict=False):
            if value is not None:
                machine.memory.receive(one.ssid, value)

    # --- function calls ------------------------------------------------------------------------------------

    def _call(self, caller: BlockAtWork, event: str) -> None:
        """Execute what an event calls, with the outputs of its chart as they are now.

        What that gives is seen by the chart at once, where it is among its inputs.
        """
        if caller.chart is not None:
            caller.outputs = outputs_of(caller.chart)
        for call in caller.calls[event]:
            self._execute(call)
        if caller.chart is None:
            return
        called = (port is not None and self._by_id[port[0]].called for port in caller.inputs)
        pairs = zip(self._values(caller), called, strict=True)
        self._feed(caller.chart, [value if by_call else None for value, by_call in pairs])

    def _execute(self, call: FunctionCall) -> None:
        node = self._by_id[call.target]
        with told(node):
            values = self._values(node)
            if node.chart is not None:
                self._feed(node.chart, values)
                events = [one for one in node.chart.chart.root.events.values() if one.scope == "input"]
                node.outputs = woken(node.chart, [call_event(node.block.shown, events, call.event)])
            elif node.system is not None:
                self._begin(node)
                node.outputs = node.system.step(values)

    def _events(self, node: BlockAtWork, machine: ChartMachine) -> list[str] | None:
        """The input events of this step; ``None`` for a chart without any, which runs in every step."""
        every = [one for one in machine.chart.root.events.values() if one.scope == "input"]
        if not every:
            return None
        now = [] if node.fed is None else [float(one.value) for one in scalars(self._value(node.fed))]
        before, node.was = node.was, now
        found = zip(every, before, now, strict=False)
        return [one.name for one, old, new in found if edge(one.trigger, old, new)]


def _executed(
    function: SimulinkFunction, system: SystemAtWork, given: Mapping[str, MatlabValue]
) -> Mapping[str, MatlabValue]:
    """What a Simulink function gives for some arguments."""
    found = system.step([given[name] for name in function.inputs])
    return dict(zip(function.outputs, found, strict=True))


def _port(node: BlockAtWork) -> tuple[str, int]:
    port = node.inputs[0]
    assert port is not None
    return port


__all__ = ["SystemAtWork"]
