"""Functions of a chart, and a MATLAB function that is a block."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from rovercheck.checker.drawn.lower.chart_paths import PathWriter
from rovercheck.checker.drawn.lower.names import TextScope
from rovercheck.checker.drawn.lower.program import ProgramPart
from rovercheck.checker.drawn.lower.symbols import NotLowered, Symbolic
from rovercheck.checker.drawn.parsed import FunctionNode


@dataclass(frozen=True)
class ExecutedFunction:
    """The blocks of a Simulink function: what they do, what they give, and what delays then remember."""

    step: ProgramPart
    outputs: Mapping[str, Symbolic]
    after: ProgramPart


class FunctionWriter(PathWriter):
    """The functions of one chart; ``executed`` are its Simulink functions, by SSID."""

    executed: Mapping[int, ExecutedFunction] = MappingProxyType({})

    def call(self, function: FunctionNode, arguments: Sequence[Symbolic], scope: TextScope) -> list[Symbolic]:
        """A function of the chart: a MATLAB function, or a flow chart with its own data."""
        name = function.signature.name
        if name in scope.calls:
            raise NotLowered(f"{name} calls itself: write a loop")
        keeper = f"{self.writer.name}.{name}"
        if function.script:
            script = {one.signature.name: one for one in function.script}
            own = replace(scope, node=function.holder, script=script, keeper=keeper, kept=set())
            return self.script(function.script[0], arguments, own)
        if function.drawn.ssid in self.executed:
            return self._executed(function, arguments, scope)
        if function.flow is None:
            raise NotLowered(f"{name} is a function that is not known here")
        flow, signature = function.flow, function.signature
        for datum_name, one in flow.data.items():
            self._reset(one, f"{keeper}.{datum_name}")
            if datum_name in signature.inputs:
                at = signature.inputs.index(datum_name)
                if at < len(arguments):
                    self._all(self.datum(one, arguments[at]), arguments[at], replace(scope, node=flow))
        inner = TextScope(flow, self.rules, scope.event, calls=(*scope.calls, name), keeper=keeper)
        self._search(flow.defaults, inner, lambda path: None, function=flow)
        return [self.kept(self._now(self.cells[flow.data[name].ssid])) for name in signature.outputs]

    def _executed(
        self, function: FunctionNode, arguments: Sequence[Symbolic], scope: TextScope
    ) -> list[Symbolic]:
        """A Simulink function: its blocks with the arguments, which are matched with its ports by name."""
        signature, parts = function.signature, self.executed[function.drawn.ssid]
        if len(arguments) != len(signature.inputs):
            raise NotLowered(
                f"{signature.name} takes {len(signature.inputs)} values, and {len(arguments)} are given"
            )
        for name, value in zip(signature.inputs, arguments, strict=True):
            if name is not None:
                one = function.data[name]
                self._all(self.datum(one, value), value, replace(scope, node=function.holder))
        self.writer.include(*parts.step)
        for name in signature.outputs:
            value = parts.outputs[name]
            self._all(self.datum(function.data[name], value), value, replace(scope, node=function.holder))
        self.writer.include(*parts.after)
        return [self.kept(self._now(self.cells[function.data[name].ssid])) for name in signature.outputs]

    def run_block(self) -> None:
        """Execute the function of a block: its values are matched with the data by name."""
        [function] = self.chart.root.functions.values()
        data = self.chart.root.data
        scope = self._scope(self.chart.root)
        signature = function.script[0].signature if function.script else function.signature
        names = (name for name in signature.inputs if name is not None)
        given = [self._now(self.cells[data[name].ssid]) for name in names if name in data]
        found = self.call(function, given, scope)
        for name, value in zip(signature.outputs, found, strict=False):
            if name in data:
                self._all(self.datum(data[name], value), value, scope)


__all__ = ["ExecutedFunction", "FunctionWriter"]
