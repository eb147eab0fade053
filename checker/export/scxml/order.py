"""The order of execution: a region that takes the event of a step and gives each component its turn."""

from collections.abc import Sequence
from xml.etree.ElementTree import Element

from rovercheck.checker.export.scxml.charts import ChartRegion
from rovercheck.checker.export.scxml.content import Content, ContentWriter, chosen, comment, element, raised
from rovercheck.checker.export.scxml.names import TICK
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.expr import TRUE, Var
from rovercheck.spec_model.lang.lower.timers import ChartTimers
from rovercheck.spec_model.lang.system import System


class ExecutionOrder:
    """The components of a system; ``regions`` are its charts in their order, ``variables`` their counters."""

    def __init__(self, system: System, content: ContentWriter) -> None:
        self._system, self._content, self._names = system, content, content.formulas.names
        self._moments: list[tuple[str, Content]] = []
        self.regions: list[tuple[ChartRegion, Element]] = []
        self.variables: list[Var] = []
        self._first = self._run(system.components, ())
        self.regions.reverse()

    def element(self) -> Element:
        """The region."""
        made = element("state", id=self._names.order)
        taken = tuple(self._taken(one) for one in (*self._system.frozen, *self._system.inputs.values()))
        moments = [(TICK, (*taken, *self._first)), *reversed(self._moments)]
        made.extend([element("transition", content, event=event) for event, content in moments])
        for event, waits, content in (one for region, _ in self.regions for one in region.turns.ends()):
            cond = None if waits is TRUE else self._content.formulas(waits)
            made.append(element("transition", content, event=event, cond=cond))
        return made

    def _taken(self, one: Var) -> Element:
        name = self._names.data(one.name)
        return element("assign", location=name, expr=f"_event.data.{name}")

    def _run(self, components: Sequence[Component], after: Content) -> Content:
        """What executes components one after the other; written from the last to the first."""
        for component in reversed(components):
            match component:
                case Chart():
                    after = self._chart(component, after)
                case Block():
                    after = (comment(component.name), *self._content(component.do), *after)
                case Enabled():
                    onward = self._moment(f"after {component.name or 'enabled'}", after)
                    after = chosen(
                        self._content.formulas(component.by), self._run(component.components, onward), onward
                    )
        return after

    def _chart(self, chart: Chart, after: Content) -> Content:
        timers = ChartTimers(chart, self._system.step_ms, self._system.elapsed)
        ends = (*self._content(timers.at_end()), *after)
        region = ChartRegion(
            chart, self._content, timers, self._moment(f"end {self._names.states[chart.name, ()]}", ends)
        )
        self.regions.append((region, region.element()))
        self.variables = [*timers.variables, *region.turns.variables, *self.variables]
        return region.begin

    def _moment(self, event: str, content: Content) -> Content:
        """What gives the turn to something: an event at which it is done, unless it does so itself."""
        if not content or [one.tag for one in content] == ["raise"]:
            return content
        name = self._names.events(event, object())
        self._moments.append((name, content))
        return raised(name)


__all__ = ["ExecutionOrder"]
