"""The block diagram of a system: charts, enabled subsystems, and the signals between them.

What a component reads is a signal of what was executed before it in the same step, or else the value that a
later one gave in the step before, which a delay holds.  A variable that several charts write goes through all
of them; past an enabled subsystem it goes through a switch, as the subsystem's own output is held.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby

from rovercheck.checker.export.slx.blocks import ChartBlock
from rovercheck.checker.export.slx.formulas import CHOICE_SCRIPT, FormulaWriter
from rovercheck.checker.export.slx.names import LONGEST, SlxNames, identifier
from rovercheck.checker.simulink.writer.systems import WrittenSystem
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import System


@dataclass(eq=False)
class EnabledBlock:
    """An enabled subsystem, with its own level of blocks.  ``read`` is what its condition reads."""

    name: str
    by: Expr
    formula: str
    read: dict[str, Var]
    asked: dict[str, tuple[str, tuple[str, ...]]]
    chooses: bool
    sid: str
    level: "Level"


@dataclass(eq=False)
class Level:
    """The blocks of the model or of one enabled subsystem, in their order of execution.

    ``ports`` are where signals come from at the moment, ``delays`` those that come from the step before;
    ``mixed`` are those that come from a switch.
    """

    system: WrittenSystem
    above: "Level | None" = None
    sid: str = ""
    blocks: list[ChartBlock | EnabledBlock] = field(default_factory=list)
    ports: dict[str, str] = field(default_factory=dict)
    delays: dict[str, str] = field(default_factory=dict)
    mixed: set[str] = field(default_factory=set)
    ins: int = 0
    outs: int = 0

    def charts(self) -> Iterator[ChartBlock]:
        """The charts in it, those of subsystems too."""
        for one in self.blocks:
            if isinstance(one, ChartBlock):
                yield one
            else:
                yield from one.level.charts()

    def subsystems(self) -> Iterator[EnabledBlock]:
        """The subsystems in it, nested ones too."""
        for one in self.blocks:
            if isinstance(one, EnabledBlock):
                yield one
                yield from one.level.subsystems()


class Diagram:
    """The blocks of a system; ``charts`` are the charts of Simulink in order."""

    def __init__(self, system: System, root: WrittenSystem, formulas: FormulaWriter, name: str) -> None:
        self.system, self.formulas = system, formulas
        self._names = SlxNames()
        self.top = Level(root)
        parts: Sequence[Component] = system.components
        if all(not isinstance(one, Enabled) for one in parts):
            self._chart_of(self.top, name, list(parts))
        else:
            if system.frozen and isinstance(parts[0], Enabled):
                self._chart_of(self.top, "Frozen", [])
            self._fill(self.top, parts)
        self.charts = list(self.top.charts())
        self.charts[0].frozen = system.frozen
        self._writers = Counter(name for one in self.charts for name in one.written)
        self.carried = {name for name, count in self._writers.items() if count > 1}
        for one in self.charts:
            one.carried = [name for name in one.written if name in self.carried]
            one.write(system)
        self.signals = self._signals()
        self._shown: set[str] = set()

    def _fill(self, level: Level, components: Sequence[Component]) -> None:
        for enabled, some in groupby(components, lambda one: isinstance(one, Enabled)):
            group = list(some)
            if not enabled:
                last = f"_to_{group[-1].name}" if len(group) > 1 else ""
                self._chart_of(level, f"{group[0].name}{last}", group)
                continue
            for one in group:
                assert isinstance(one, Enabled)
                self._enabled(level, one)

    def _chart_of(self, level: Level, name: str, group: Sequence[Component]) -> None:
        charts = [one for one in group if isinstance(one, Chart | Block)]
        level.blocks.append(ChartBlock(self._named(name), level.system, charts, self.formulas))

    def _enabled(self, level: Level, one: Enabled) -> None:
        self.formulas.begin([])
        formula = self.formulas(one.by)
        read, asked, chooses = self.formulas.read, self.formulas.asked, self.formulas.chooses
        name = self._named(one.name or f"enabled {one.components[0].name}")
        sid, inside = level.system.subsystem(name, 0, 0, "enable")
        inside.block("EnablePort", "Enable", StatesWhenEnabling="held")
        made = EnabledBlock(name, one.by, formula, read, asked, chooses, sid, Level(inside, level, sid))
        level.blocks.append(made)
        self._fill(made.level, one.components)

    def _named(self, name: str) -> str:
        wanted = identifier(name)[: LONGEST - 20].strip("_")
        return self._names(wanted) if self._names.free(wanted) else self._named(f"{wanted} 2")

    def _signals(self) -> dict[str, Var]:
        """All variables by name, with what asks whether a state of another chart is active."""
        found = {one.name: one for one in (*self.system.inputs.values(), *self.system.frozen)}
        found |= self.system.written
        return found | {name: Var(name, boolean) for name in self._asked()}

    def _asked(self) -> dict[str, tuple[str, tuple[str, ...]]]:
        """The signals that say whether a state of another chart is active, with that state."""
        charts = [one.asked for one in self.charts]
        some = [*charts, *(one.asked for one in self.top.subsystems())]
        return {name: place for one in some for name, place in one.items()}

    # --- signals -------------------------------------------------------------------------------------------

    def connect(self, shown: Sequence[str]) -> None:
        """Draw all signals; ``shown`` are variables that leave the subsystems that they are written in."""
        self._shown = {*shown, *self.carried}
        asked = self._asked()
        for one in self.charts:
            own = {chart.name for chart in one.charts}
            if signals := {name: place for name, place in asked.items() if place[0] in own}:
                one.shows(signals)
                one.signals = list(signals)
        self._connect(self.top)

    def _connect(self, level: Level) -> None:
        for one in level.blocks:
            if isinstance(one, ChartBlock):
                self._connect_chart(level, one)
            else:
                self._connect_enabled(level, one)
        for name, delay in level.delays.items():
            level.system.line(level.ports[name], delay)

    def _connect_chart(self, level: Level, one: ChartBlock) -> None:
        for number, (name, (signal, variable)) in enumerate(one.fed.items(), 1):
            one.chart.data(name, "input", self.formulas.type_of(variable.domain))
            level.system.line(self._port(level, signal), f"{one.sid}/{number}")
        for number, variable in enumerate(self.given(one), 1):
            level.ports[variable.name] = f"{one.sid}/{number}"

    def given(self, one: ChartBlock) -> list[Var]:
        """The outputs of a chart: what is shown, or read by others."""
        others = {name for other in self.charts if other is not one for name in other.read}
        others |= {name for other in self.top.subsystems() for name in other.read} | self._shown
        found = [variable for name, variable in one.written.items() if name in others]
        return [*found, *(self.signals[name] for name in one.signals)]

    def _connect_enabled(self, level: Level, one: EnabledBlock) -> None:
        enable = self._enable(level, one)
        level.system.line(enable, f"{one.sid}#enable")
        earlier = {name: self._port(level, name) for name in self.carried if self._also_outside(one, name)}
        self._connect(one.level)
        inner = one.level
        for name in self._leaving(one):
            inner.outs += 1
            first = {} if name not in inner.mixed else {"InitialOutput": self._first(name)}
            port = inner.system.outport(self.formulas.names(name), inner.outs, **first)
            inner.system.line(inner.ports[name], port)
            level.ports[name] = f"{one.sid}/{inner.outs}"
            if name in earlier:
                level.ports[name] = self._switch(level, one, name, enable, earlier[name])
        made = next(block for block in level.system.blocks if block.sid == one.sid)
        made.ports = {"in": inner.ins, "out": inner.outs, "enable": 1}

    def _leaving(self, one: EnabledBlock) -> list[str]:
        inside = list(one.level.charts())
        gives = {v.name: None for chart in inside for v in self.given(chart)}
        reads = {name for other in self.charts if other not in inside for name in other.read}
        reads |= {name for o in self.top.subsystems() if o not in one.level.subsystems() for name in o.read}
        return [name for name in gives if name in reads or name in self._shown]

    def _also_outside(self, one: EnabledBlock, name: str) -> bool:
        """Whether a variable is written in a subsystem and elsewhere."""
        inside = sum(name in chart.written for chart in one.level.charts())
        return 0 < inside < self._writers[name]

    def _switch(self, level: Level, one: EnabledBlock, name: str, enable: str, earlier: str) -> str:
        """A variable that others write, too: what the subsystem gave it, if that was executed."""
        block = level.system.block(
            "Switch", f"{one.name} {self.formulas.names(name)}", {"in": 3, "out": 1}, Criteria="u2 ~= 0"
        )
        for number, port in enumerate((level.ports[name], enable, earlier), 1):
            level.system.line(port, f"{block}/{number}")
        level.mixed.add(name)
        return block

    def _enable(self, level: Level, one: EnabledBlock) -> str:
        if isinstance(one.by, Var) and one.by.name in one.read:
            return self._port(level, one.by.name)
        names = {self.formulas.names(name): name for name in one.read}
        own = self.formulas.names(f"enable {one.name}")
        script = f"function {own} = enabled({', '.join(names)})\n{own} = {one.formula};\nend\n"
        script += CHOICE_SCRIPT if one.chooses else ""
        sid, chart = level.system.chart(f"{one.name}_enable", "MATLAB Function", script)
        for number, (name, signal) in enumerate(names.items(), 1):
            chart.data(name, "input", self.formulas.type_of(one.read[signal].domain))
            level.system.line(self._port(level, signal), f"{sid}/{number}")
        chart.data(own, "output", "boolean")
        return sid

    def _port(self, level: Level, signal: str) -> str:
        """Where a signal comes from."""
        if signal in level.ports:
            return level.ports[signal]
        here = sum(signal in one.written or signal in one.signals for one in level.charts())
        if level.above is None or here == max(1, self._writers[signal]):
            name = f"last {self.formulas.names(signal)}"
            first = {"InitialCondition": self._first(signal)}
            delay = level.system.block("UnitDelay", name, {"in": 1, "out": 1}, None, **first)
            level.ports[signal] = level.delays[signal] = delay
        else:
            level.ins += 1
            level.ports[signal] = level.system.inport(self.formulas.names(signal), level.ins)
            level.above.system.line(self._port(level.above, signal), f"{level.sid}/{level.ins}")
        return level.ports[signal]

    def _first(self, name: str) -> str:
        one = self.signals[name]
        return self.formulas.constant(one.init, one.sort)


__all__ = ["Diagram"]
