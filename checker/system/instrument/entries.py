"""Which transitions enter a state, and which leave it: the pairs that can follow each other."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from rovercheck.spec_model.lang.chart import Chart, Path, Transition
from rovercheck.spec_model.lang.fired_transition import path_label
from rovercheck.spec_model.lang.wellformed.places import common_composite


@dataclass(frozen=True)
class TransitionGroup:
    """Transitions in priority order that start in one state, junction or, as defaults, composite."""

    owner: Path
    default: bool = False


@dataclass(frozen=True)
class Segment:
    """One segment: where it starts, its position there from 1, and its number in the chart from 1."""

    group: TransitionGroup
    order: int
    number: int
    drawn: Transition
    level: Path

    @property
    def text(self) -> str:
        """``Sup_OK -> Sup_CRIT (transition 1) [age_S > 120]``."""
        at = ".".join(self.group.owner)
        start = f"default{f' of {at}' if at else ''}" if self.group.default else at
        label = path_label([self.drawn])
        return f"{start} -> {self.drawn.target} (transition {self.order}){f' {label}' if label else ''}"


@dataclass(frozen=True)
class EntryOrigin:
    """Where a path begins: in the state that it leaves, or (default) in the composite that is entered."""

    path: Path
    default: bool


class ChartTransitions:
    """The segments of a chart, and the states that each of them enters."""

    def __init__(self, chart: Chart) -> None:
        self.chart = chart
        self.segments = tuple(_numbered(chart))
        self.by_group: dict[TransitionGroup, list[Segment]] = {}
        for segment in self.segments:
            self.by_group.setdefault(segment.group, []).append(segment)

    def target(self, segment: Segment) -> Path:
        found = self.chart.resolve(segment.level, segment.drawn.target)
        assert found is not None, "the chart is well formed"
        return found

    @cached_property
    def entering(self) -> dict[Path, list[Segment]]:
        """The last segments of paths that enter a state, for each state with transitions of its own."""
        left = [p for p, s in self.chart.states.items() if s.transitions]
        return {path: [s for s in self.segments if self.enters(s, path) is not False] for path in left}

    def enters(self, segment: Segment, state: Path) -> bool | None:
        """Whether a path that ends with the segment enters the state; None: it depends on its start."""
        target = self.target(segment)
        if target not in self.chart.states or target[: len(state)] != state:
            return False
        found = {_enters(origin, state, target) for origin in self._origins[segment.group]}
        return found.pop() if len(found) == 1 else None

    @cached_property
    def _origins(self) -> dict[TransitionGroup, set[EntryOrigin]]:
        """Where the paths begin that run through a place."""
        found: dict[TransitionGroup, set[EntryOrigin]] = {group: set() for group in self.by_group}
        todo = [
            (group, EntryOrigin(group.owner, group.default))
            for group in self.by_group
            if group.default or group.owner in self.chart.states
        ]
        while todo:
            group, origin = todo.pop()
            if origin in found.setdefault(group, set()):
                continue
            found[group].add(origin)
            ends = (self.target(s) for s in self.by_group.get(group, ()))
            todo += [(TransitionGroup(end), origin) for end in ends if end in self.chart.junctions]
        return found


def _enters(origin: EntryOrigin, state: Path, target: Path) -> bool:
    if origin.default:
        return len(state) > len(origin.path)
    return len(state) > len(common_composite(origin.path, target))


def _numbered(chart: Chart) -> Iterator[Segment]:
    for number, (group, order, drawn, level) in enumerate(_drawn(chart), start=1):
        yield Segment(group, order, number, drawn, level)


def _drawn(chart: Chart) -> Iterator[tuple[TransitionGroup, int, Transition, Path]]:
    for path, state in chart.states.items():
        for order, transition in enumerate(state.default, start=1):
            yield TransitionGroup(path, True), order, transition, path
        for order, transition in enumerate(state.transitions, start=1):
            yield TransitionGroup(path), order, transition, path[:-1]
    for path, junction in chart.junctions.items():
        for order, transition in enumerate(junction.transitions, start=1):
            yield TransitionGroup(path), order, transition, path[:-1]
