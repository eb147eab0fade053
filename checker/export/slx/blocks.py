"""Components that are executed one after the other as one chart of Simulink, a region for each."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.export.slx.actions import ActionWriter, event_name
from rovercheck.checker.export.slx.charts import ChartWriter
from rovercheck.checker.export.slx.formulas import CHOICE, CHOICE_SCRIPT, FormulaWriter
from rovercheck.checker.export.slx.words import ChartWords
from rovercheck.checker.simulink.writer.systems import WrittenSystem
from rovercheck.spec_model.lang.action import Send, each_action
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import System


@dataclass(eq=False)
class ChartBlock:
    """One chart of Simulink in ``diagram``, named ``name``.

    ``read`` are the variables that its formulas read, ``local`` what belongs to nobody else: temporaries and
    counters.  ``frozen`` are latched in its first step.  ``carried`` are written by other charts, too: each
    begins a step with the value that the last of these gave it.
    """

    name: str
    diagram: WrittenSystem
    parts: Sequence[Chart | Block]
    formulas: FormulaWriter
    frozen: Sequence[Var] = ()
    carried: Collection[str] = ()
    read: dict[str, Var] = field(default_factory=dict)
    asked: dict[str, tuple[str, tuple[str, ...]]] = field(default_factory=dict)
    local: list[Var] = field(default_factory=list)
    signals: Sequence[str] = ()
    """Those that say whether its states are active."""
    order: int = 0

    def __post_init__(self) -> None:
        self.sid, self.chart = self.diagram.chart(self.name)
        self.chart.parallel = True

    @property
    def charts(self) -> list[Chart]:
        """Those of its parts that are charts."""
        return [one for one in self.parts if isinstance(one, Chart)]

    @property
    def written(self) -> Mapping[str, Var]:
        """What its parts write, by name."""
        found = {one.name: one for one in self.frozen}
        for part in self.parts:
            found |= part.written
        return found

    # --- regions -------------------------------------------------------------------------------------------

    def write(self, system: System) -> None:
        """All regions."""
        self.formulas.begin(self.charts)
        names = self.formulas.names
        if self.carried:
            self.region("begin", [f"{names(one)} = {names(before(one))};" for one in self.carried])
        if self.frozen:
            self._frozen()
        for number, part in enumerate(self.parts):
            later = self.parts[number:]
            changing = {name for other in later for name in other.written}
            changing |= {v.name for c in later if isinstance(c, Chart) for v in (*c.locations, c.entered)}
            if isinstance(part, Block):
                self.region(part.name, [*ActionWriter(self.formulas, None).lines(part.do)])
                self.local += part.temporaries
            else:
                self._chart(part, system, changing)
        if self.formulas.chooses:
            self._choice()
        self.read, self.asked = self.formulas.read, self.formulas.asked

    def region(self, name: str, lines: Sequence[str], section: str = "en, du:") -> None:
        """A region that does the same in every step."""
        self.order += 1
        label = self.formulas.names(f"region {name}")
        self.chart.state("\n".join([label, section, *lines]) if lines else label, None, self.order)

    def shows(self, signals: Mapping[str, tuple[str, tuple[str, ...]]]) -> None:
        """Signals that say at the end of each step whether some states are active."""
        lines = [
            f"{self.formulas.names(one)} = in({self.formulas.states[place]});"
            for one, place in signals.items()
        ]
        self.region(f"{self.name} active states", lines)

    def _chart(self, chart: Chart, system: System, changing: set[str]) -> None:
        words = ChartWords(chart, self.formulas, system.step_ms, changing, system.elapsed, system.tick_ms)
        writer = ChartWriter(chart, self.chart, self.formulas, words)
        writer.write()
        if words.before:
            self.region(f"{chart.name} before", words.before)
        self.order += 1
        writer.nodes[()].order = self.order
        if words.after:
            self.region(f"{chart.name} after", words.after)
        self.local += [Var(name, domain, init) for name, (domain, init) in words.data.items()]
        events = {a.event for a in each_action(chart.all_actions) if isinstance(a, Send)}
        events |= {t.event for t in chart.transitions if t.event is not None}
        for event in sorted(events):
            self.chart.event(self.formulas.names(event_name(chart, event)))

    def _frozen(self) -> None:
        names = self.formulas.names
        lines = [f"{names(one.name)} = {names(given(one.name))};" for one in self.frozen]
        self.region("Frozen", lines, "en:")

    def _choice(self) -> None:
        made = self.chart.function(f"y = {CHOICE}(c, a, b)", script=CHOICE_SCRIPT)
        for name, kind in (("c", "boolean"), ("a", "double"), ("b", "double")):
            self.chart.data(name, "function input", kind, holder=made)
        self.chart.data("y", "function output", "double", holder=made)

    # --- ports ---------------------------------------------------------------------------------------------

    @property
    def fed(self) -> dict[str, tuple[str, Var]]:
        """The names of its inputs in the chart, with the variables that they have the values of."""
        own = self.written.keys() | {one.name for one in self.local}
        found = {self.formulas.names(n): (n, one) for n, one in self.read.items() if n not in own}
        known = self.written
        found |= {self.formulas.names(before(one)): (one, known[one]) for one in self.carried}
        return found | {self.formulas.names(given(v.name)): (given(v.name), v) for v in self.frozen}


def before(name: str) -> str:
    """What the value of a variable is called in which a chart begins a step."""
    return f"{name}.before"


def given(name: str) -> str:
    """What the input is called that says what a frozen variable is."""
    return f"{name}.given"


__all__ = ["ChartBlock", "before", "given"]
