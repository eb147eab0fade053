"""A chart as a region of a machine of SCXML: its states as drawn, and one that waits for its first step."""

from xml.etree.ElementTree import Element

from rovercheck.checker.export.scxml.content import (
    Content,
    ContentWriter,
    chosen,
    element,
    raised,
    refuse_sends,
    sends,
)
from rovercheck.checker.export.scxml.entering import EntryOrder, Waiting
from rovercheck.checker.export.scxml.moments import Arrival
from rovercheck.checker.export.scxml.paths import ChartPaths, within
from rovercheck.checker.export.scxml.transitions import TransitionWriter
from rovercheck.checker.export.scxml.turns import ChartTurns
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.chart import Chart, Path, State
from rovercheck.spec_model.lang.expr import Const
from rovercheck.spec_model.lang.lower.timers import ChartTimers


class ChartRegion:
    """One chart.  ``end`` is what follows its step; ``begin`` begins one."""

    def __init__(self, chart: Chart, content: ContentWriter, timers: ChartTimers, end: Content) -> None:
        self._paths, self._order = ChartPaths(chart), EntryOrder(chart)
        self._waiting: list[tuple[Path, str]] = []
        self._between: list[tuple[Path, Element]] = []
        self._arriving: list[Arrival] = []
        self._elements: dict[Path, Element] = {}
        self.chart, self._timers, self._names = chart, timers, content.formulas.names
        self._content = ContentWriter(content.formulas, timers.plainly)
        idle = {
            p for p, s in chart.states.items() if not (s.transitions or s.during or timers.durations.get(p))
        }
        self.turns = ChartTurns(chart, self._content, idle, end)
        counted = self._content([*timers.at_start(), *timers.at_start_entered()])
        self.begin = (*counted, *raised(self.turns.event_inside(())))

    def element(self) -> Element:
        """Its states; the first is active until its first step."""
        root = self.chart.root
        begins = self._content.formulas.begins[self.chart.name]
        made = element("state", id=self._id(()), initial=begins)
        waits = element("state", id=begins)
        made.append(waits)
        event = self.turns.event_inside(())
        regions = made
        if root.parallel:
            regions = element("parallel", id=self._names.beside(self.chart.name, (), "regions"))
            waits.append(element("transition", self.turns.after(()), event=event, target=regions.get("id")))
            regions.append(element("transition", self.turns.inside(()), event=event))
            made.append(regions)
            for path in self._paths.entered((), ()):
                self._refuse_sends(path)
        else:
            default = self._transitions(None, (), self.turns.after(()))
            default.default(waits, event)
            self._arriving += default.arriving
        self._inside(regions, (), root)
        for one in self._arriving:  # which may lead to further ones
            transitions = self._transitions(None, one.path, one.onward)
            transitions.arrive(self._elements[one.path], one.event, one.end)
            self._arriving += transitions.arriving
        return made

    def _id(self, path: Path) -> str:
        return self._names.states[self.chart.name, path]

    def _transitions(
        self, source: Path | None, composite: Path = (), onward: Content = ()
    ) -> TransitionWriter:
        return TransitionWriter(
            self._paths, self._content, self._timers, self.turns, source, composite, onward
        )

    def _inside(self, made: Element, path: Path, state: State) -> None:
        """What is drawn in a state, and what is active between two of its states."""
        made.extend([self._state((*path, one.name), one) for one in state.states])
        made.extend([one for scope, one in self._between if scope == path])

    def _state(self, path: Path, state: State) -> Element:
        made = element("parallel" if state.parallel else "state", id=self._id(path))
        self._elements[path] = made
        at_once = path not in self._order.late and not sends(state.entry)
        for tag, content in (
            ("onentry", self._content(state.entry) if at_once else ()),
            ("onexit", (*(self._content(state.exit) if not sends(state.exit) else ()), *self._left(path))),
        ):
            if content:
                made.append(element(tag, content))
        transitions = self._transitions(path)
        transitions.leaving(made, self.turns.event(path))
        self._between += transitions.between
        self._arriving += transitions.arriving
        self._begin(made, path, self._order.waiting.get(path, Waiting((), ())))
        self._inside(made, path, state)
        return made

    def _begin(self, made: Element, path: Path, waits: Waiting) -> None:
        """Where a state begins: in another one, or where it waits."""
        state = self.chart.states[path]
        if sends(state.entry) and state.states and not state.parallel:
            self._elements[path] = element("state", id=self._names.beside(self.chart.name, path, "entered"))
            made.set("initial", self._elements[path].get("id", ""))
            made.append(self._elements[path])
            return
        transitions = self._transitions(None, path)
        if state.default and not waits.after:
            initial = transitions.initial()
            if initial is not None:
                made.append(initial)
                return
        if not state.default and not waits.entry:
            return
        first = element("state", id=self._names.beside(self.chart.name, path, "default"))
        made.set("initial", first.get("id", ""))
        before = [id for place, id in self._waiting if any(within(place, p) for p in waits.after)]
        condition = " && ".join(f"!In('{id}')" for id in before)
        if state.states:
            transitions.default(first, None, waits.entry, condition)
            made.extend([first, *transitions.waiting])
        else:
            self._refuse_sends(path)
            last = element("state", id=self._names.beside(self.chart.name, path, "active"))
            content = self._content(waits.entry)
            first.append(element("transition", content, cond=condition or None, target=last.get("id")))
            made.extend([first, last])
        self._waiting += [(path, one.get("id", "")) for one in (first, *transitions.waiting)]

    def _refuse_sends(self, path: Path) -> None:
        where = f"the entry action of {'.'.join((self.chart.name, *path))}"
        refuse_sends(self.chart, self.chart.states[path].entry, where)

    def _left(self, path: Path) -> Content:
        """What begins anew when a state is left: its timers, data local to it and others, all inactive."""
        found = list[Element](self._content(self._timers.on_exit(path)))
        for var, names in self.chart.local_to:
            owners = [self.chart.path(one) for one in names]
            if path in owners:
                others = [self._content.formulas.is_active(self.chart.name, p) for p in owners if p != path]
                reset = self._content([Assign(var, Const(var.init, var.sort))])
                found += chosen(" || ".join(others), (), reset) if others else reset
        return tuple(found)


__all__ = ["ChartRegion"]
