"""A whole model at work: its diagram, its charts, its MATLAB functions, tick by tick."""

from collections.abc import Iterator, Mapping, Sequence

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.free import free_outputs
from rovercheck.checker.drawn.grammar.syntax import Expression
from rovercheck.checker.drawn.interpret.blocks import parsed_value
from rovercheck.checker.drawn.interpret.delays import settle
from rovercheck.checker.drawn.interpret.evaluate import CallFrame
from rovercheck.checker.drawn.interpret.memory import ChartMemory, FreeValues, TypeTable, dimensions
from rovercheck.checker.drawn.interpret.statements import StatementRunner
from rovercheck.checker.drawn.interpret.stores import StoresAtWork
from rovercheck.checker.drawn.interpret.system import SystemAtWork
from rovercheck.checker.drawn.interpret.values import (
    MatlabValue,
    NumberRules,
    Structure,
    array,
    double,
    each_converted,
    scalars,
    shape,
)
from rovercheck.checker.drawn.parameters import expanded, values_of
from rovercheck.checker.drawn.parsed import FunctionNode, StateNode, parsed_chart
from rovercheck.checker.drawn.records import DrawnBlock, DrawnChart, DrawnModel
from rovercheck.checker.drawn.refused import notes_of
from rovercheck.checker.drawn.stores import data_stores
from rovercheck.checker.drawn.wiring import number_of

Number = int | float


class ModelRunner:
    """Runs a model from its power-up.  Inputs and outputs have flat names: ``probe.level``, ``force(2)``.

    Raises ``DrawnFault``, here and in each step, for what has no meaning.
    """

    def __init__(self, model: DrawnModel, step: str = "") -> None:
        self.model, self.types = model, TypeTable.of(model)
        self.step_length = step or model.step
        self.named = values_of(model)
        named = [*model.free.values(), *(name for name, _ in free_outputs(model))]
        self.free = FreeValues(model.free, dict.fromkeys(named, 0.0))
        for note in notes_of(model):
            if note.kind == "refused":
                raise DrawnFault(str(note).rstrip("."))
        charts = {one.path: parsed_chart(one) for one in model.charts}
        self.stores = StoresAtWork(data_stores(model.system, charts), self.types, self.value_of)
        self._top = SystemAtWork(model.system, self)
        root = {number_of(one): one for one in model.system.blocks if one.kind == "Inport"}
        self._inports = [root[number] for number in sorted(root)]
        every = [one for one in model.system.blocks if one.kind == "Outport"]
        ends = {number_of(one): one for one in every}
        if len(ends) < len(every):
            raise DrawnFault("two Outports have one number: give each its own")
        self._outports = [ends[number] for number in sorted(ends)]
        self.machines = list(self._top.machines())
        """The charts at work, in their order of execution."""
        at_rest = [self._at_rest(port) for port in self._inports]
        with self.stores.kept():
            settle(self._top, at_rest, self)
        self._top.initialize(at_rest)

    def inputs(self) -> Iterator[str]:
        """The flat names of all inputs, in the order of their ports, and of what is free."""
        for port in self._inports:
            yield from (name for name, _ in _flat(port.shown, self._at_rest(port)))
        yield from self.free.values

    def step(self, given: Mapping[str, Number]) -> dict[str, Number]:
        """One step: the outputs by their flat names.  An input that is not given is as at rest."""
        values = [self._filled(port.shown, self._at_rest(port), given) for port in self._inports]
        self.free.values.update((name, given[name]) for name in self.free.values if name in given)
        for machine in self.machines:
            machine.fired = []
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
