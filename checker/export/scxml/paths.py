"""Paths through a chart that are known beforehand: what is always complete, and what it enters."""

from collections.abc import Collection
from functools import cached_property

from rovercheck.spec_model.lang.action import Action, reads
from rovercheck.spec_model.lang.chart import Chart, Path, Transition

Segments = tuple[Transition, ...]


class ChartPaths:
    """The paths of one chart."""

    def __init__(self, chart: Chart) -> None:
        self.chart = chart

    def target(self, level: Path, segment: Transition) -> Path:
        """The state or junction where a segment ends that is drawn at a level."""
        found = self.chart.resolve(level, segment.target)
        assert found is not None
        return found

    def sure(self, level: Path, segment: Transition) -> tuple[Segments, Path] | None:
        """The segments from one on and the state where they end, if that path is then always complete."""
        segments, target = [segment], self.target(level, segment)
        while target in self.chart.junctions:
            onward = self.chart.junctions[target].transitions[:1]
            if not onward or onward[0].guard is not None or onward[0].event is not None:
                return None
            segments += onward
            target = self.target(target[:-1], onward[0])
        return tuple(segments), target

    def default(self, composite: Path) -> tuple[Segments, Path] | None:
        """The default path of a composite, if there is nothing to choose."""
        first = self.chart.states[composite].default[:1]
        return self.sure(composite, first[0]) if first and first[0].guard is None else None

    def entered(self, scope: Path, end: Path) -> list[Path]:
        """The states that are entered inside a composite on the way to a state, and then in that, in order.

        What a composite chooses to enter is not among them.
        """
        state = self.chart.states[scope]
        if scope == end and not state.parallel:
            default = self.default(scope)
            return self.entered(scope, default[1]) if default else []
        inner = [(*scope, one.name) for one in state.states] if state.parallel else [end[: len(scope) + 1]]
        return [p for one in inner for p in (one, *self.entered(one, end if within(end, one) else one))]

    def waits_for_exit(self, do: Collection[Action], left: Path) -> bool:
        """Whether condition actions must run before a state is left, as leaving it has to do with them."""
        inside = {p: s for p, s in self.chart.states.items() if within(p, left)}
        exits = any(s.exit for s in inside.values()) or self._owners & inside.keys()
        return bool(exits or self._places & reads([*do]).keys())

    @cached_property
    def _owners(self) -> set[Path]:
        """States to which data are local."""
        return {self.chart.path(one) for _, names in self.chart.local_to for one in names}

    @cached_property
    def _places(self) -> set[str]:
        return {place.name for place in self.chart.locations}


def scope_of(source: Path, target: Path) -> Path:
    """The innermost composite that holds both ends of a transition."""
    depth = min(len(source), len(target)) - 1
    while source[:depth] != target[:depth]:
        depth -= 1
    return source[:depth]


def within(path: Path, outer: Path) -> bool:
    """Whether a state lies in another one, or is it."""
    return path[: len(outer)] == outer


__all__ = ["ChartPaths", "Segments", "scope_of", "within"]
