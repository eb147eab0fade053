"""Functions of a chart at work: of MATLAB, flow charts, and those whose blocks are executed."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from typing import Literal

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.evaluate import CallFrame
from rovercheck.checker.drawn.interpret.memory import ChartMemory
from rovercheck.checker.drawn.interpret.statements import StatementRunner
from rovercheck.checker.drawn.interpret.values import MatlabValue, NumberRules
from rovercheck.checker.drawn.parsed import FunctionNode, ParsedChart, TransitionNode

END: Literal["end"] = "end"
Found = list[TransitionNode] | Literal["end"] | None
"""A complete path; the end of the search at a junction without a way on; nothing."""


class ChartFunctions(ABC):
    """The functions of one chart."""

    chart: ParsedChart
    rules: NumberRules
    memory: ChartMemory
    executed: dict[int, Callable[[Mapping[str, MatlabValue]], Mapping[str, MatlabValue]]]
    """Of each Simulink function, by SSID, what its blocks give for some arguments."""
    _runner: StatementRunner
    _persistent: dict[int, dict[str, MatlabValue]]

    @abstractmethod
    def _search(
        self, transitions: Sequence[TransitionNode], frame: CallFrame, in_function: bool = False
    ) -> Found:
        """The first complete path that begins with one of some transitions."""

    def call(self, function: FunctionNode, arguments: Sequence[MatlabValue], calls: int) -> list[MatlabValue]:
        """A function of the chart: a MATLAB function, or a flow chart with its own data."""
        if function.script:
            script = {one.signature.name: one for one in function.script}
            frame = CallFrame(function.holder, self.rules, script=script, calls=calls)
            frame.persistent = self._persistent.setdefault(function.drawn.ssid, {})
            return self._runner.script(function.script[0], arguments, frame)
        if function.drawn.ssid in self.executed:
            return self._executed(function, arguments)
        if function.flow is None:
            raise DrawnFault(f"{function.signature.name} is a function that is not known here")
        flow, signature = function.flow, function.signature
        for name, one in flow.data.items():
            self.memory.reset(one.ssid)
            if name in signature.inputs:
                self.memory.write(one.ssid, arguments[signature.inputs.index(name)])
        frame = CallFrame(flow, self.rules, calls=calls)
        self._search(flow.defaults, frame, in_function=True)
        return [self.memory.values[flow.data[name].ssid] for name in signature.outputs]

    def _executed(self, function: FunctionNode, arguments: Sequence[MatlabValue]) -> list[MatlabValue]:
        """A Simulink function: its arguments and results are matched with its ports by name."""
        signature, data = function.signature, function.data
        if len(arguments) != len(signature.inputs):
            raise DrawnFault(
                f"{signature.name} takes {len(signature.inputs)} values, and {len(arguments)} are given"
            )
        for name, value in zip(signature.inputs, arguments, strict=True):
            if name is not None:
                self.memory.write(data[name].ssid, value)
        given = {name: self.memory.values[one.ssid] for name, one in data.items()}
        for name, value in self.executed[function.drawn.ssid](given).items():
            self.memory.write(data[name].ssid, value)
        return [self.memory.values[data[name].ssid] for name in signature.outputs]

    # --- a MATLAB function as a block ----------------------------------------------------------------------

    def run_block(self) -> None:
        """Execute the function of a block: its values are matched with the data by name."""
        [function] = self.chart.root.functions.values()
        signature = function.script[0].signature if function.script else function.signature
        data = self.chart.root.data
        names = (name for name in signature.inputs if name is not None)
        given = [self.memory.values[data[name].ssid] for name in names if name in data]
        for name, value in zip(signature.outputs, self.call(function, given, 0), strict=False):
            if name in data:
                self.memory.write(data[name].ssid, value)


__all__ = ["END", "ChartFunctions", "Found"]
