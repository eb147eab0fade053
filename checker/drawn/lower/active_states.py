"""Which states of a chart are active, as conditions and as assignments."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial

from rovercheck.checker.drawn.lower.chart_data import ChartDataWriter
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.names import TextScope
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.regions import left_in_part, seen_in_part, sends
from rovercheck.checker.drawn.lower.symbols import folded
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.parsed import ParsedChart, StateNode
from rovercheck.checker.drawn.records import DrawnData
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import TRUE, Const, Expr, Var, any_of


class ActiveStateWriter(ChartDataWriter):
    """What is active of one chart, and where its texts stand.

    Regions have a variable each where events may be answered while only some of them are active.  Those of
    the chart, if they are never left, are so in the step only in which they are entered.
    """

    def __init__(
        self, chart: ParsedChart, view: ChartView, table: DataTable, writer: ProgramWriter,
        named: Mapping[str, str], data_names: Callable[[DrawnData, StateNode], str],
    ) -> None:  # fmt: skip
        super().__init__(chart, view, table, writer, named, data_names)
        self.sends = sends(chart)
        self._stack: list[tuple[int, str]] = []
        """What is executed now, from the outside to the inside: a state, 0 for the chart, and its event."""
        self._dropped: Var | None = None
        self._regions: dict[int, Var] = {}
        self._last: dict[int, Var] = {}
        self._stays = chart.root.parallel and not left_in_part(chart, chart.root)
        for node in chart.root.every():
            if node.parallel and seen_in_part(chart, node):
                self._regions |= {region.ssid: self._region(region) for region in node.children}
            if node.history is not None and node.children and not node.parallel:
                self._last[node.ssid] = self._left_last(node)

    def _region(self, region: StateNode) -> Var:
        name = f"{self.writer.name}.{'.'.join(self.view.paths[region.ssid])}.active"
        return Var(name, boolean, self.table.starting.get(name, 0), "whether the region is active", True)

    def _begin_regions(self) -> None:
        """Regions of the chart that are never left are active from its first step on."""
        if self._stays:
            for region in self.chart.root.children:
                if region.ssid in self._regions:
                    variable = self._regions[region.ssid]
                    self.writer.temporaries[variable.name] = variable
                    self.writer.assign(variable, self._has_begun)

    def _left_last(self, node: StateNode) -> Var:
        place = self.view.location(node)
        name = f"{place.name}.last"
        return Var(name, place.domain, self.table.starting.get(name, 0), "the child left last", True)

    @property
    def _event(self) -> str:
        """The event that is answered now; empty in a plain step."""
        return self._stack[-1][1] if self._stack else ""

    @property
    def _is_nested(self) -> bool:
        """Whether an event is answered that an action sent."""
        return sum(ssid <= 0 for ssid, _ in self._stack) > 1

    def _is_event(self, name: str, scope: TextScope) -> bool:
        if scope.function and f"{scope.function}:{name}" in self.writer.locals:
            return False
        return any(name in node.events for node in self.chart.root.every())

    def active(self, node: StateNode) -> Expr:
        """Whether a state is active at this point."""
        parent = node.parent
        if parent is None:
            return TRUE
        if parent.parallel:
            region = self._regions.get(node.ssid)
            return self.writer.read(region) if region is not None else self._around(parent)
        place = self.view.location(parent)
        return folded(self.writer.read(place) == Const(place.domain.raw(self.view.name(node)), place.sort))

    def _around(self, node: StateNode) -> Expr:
        """The same of a state with regions, of which each is active as it is."""
        return self.active(node) if node.parent is not None else self._has_begun

    @property
    def _has_begun(self) -> Expr:
        return folded(self.writer.read(self.view.begun) == Const(1, self.view.begun.sort))

    def _place(self, node: StateNode, child: StateNode | None) -> None:
        """Make a child of an exclusive state active, or none."""
        place = self.view.location(node)
        raw = 0 if child is None else place.domain.raw(self.view.name(child))
        self.writer.assign(place, Const(raw, place.sort))

    def _scope(self, node: StateNode, holds: StateNode | None = None) -> TextScope:
        """Where a text of a state stands, and what must be active for it to go on."""
        alive = None if holds is None else partial(self.active, holds)
        return TextScope(
            node, self.rules, self._event, keeper=self.writer.name, left=self._dropped, alive=alive
        )

    @contextmanager
    def _dropping(self) -> Iterator[None]:
        """A part of which the rest is dropped where a state was left meanwhile."""
        before = self._dropped
        with self.writer.until("dropped") as self._dropped:
            yield
        self._dropped = before

    def _for_active_child(
        self, node: StateNode, children: Sequence[StateNode], act: Callable[[StateNode], None]
    ) -> None:
        """Do something with the child that is active now, if one is."""
        if not children:
            return
        if len(children) > 8:
            half, place = len(children) // 2, self.view.location(node)
            if not isinstance(self.writer.read(place), Const):
                order = sorted(children, key=lambda one: place.domain.raw(self.view.name(one)))
                some, others = order[:half], order[half:]
                self.writer.choose(
                    any_of(*(self.active(one) for one in some)),
                    lambda: self._for_active_child(node, some, act),
                    lambda: self._for_active_child(node, others, act),
                )
                return
        first, *others_ = children
        self.writer.choose(
            self.active(first), lambda: act(first), lambda: self._for_active_child(node, others_, act)
        )


__all__ = ["ActiveStateWriter"]
