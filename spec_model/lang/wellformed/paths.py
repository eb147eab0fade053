"""Paths: regions they may not cross, default transitions, and states that nothing leads to."""

from collections.abc import Iterator, Sequence

from rovercheck.spec_model.lang.chart import Chart, Path, Transition
from rovercheck.spec_model.lang.wellformed.places import Leg, common_composite, legs, name_of, parallel_name


def path_faults(chart: Chart) -> Iterator[str]:
    """Faults of complete paths and of what they enter."""
    all_legs = list(legs(chart))
    for leg in all_legs:
        yield from _default_faults(leg) if leg.default else _crossing_faults(chart, leg)
    reach = PathReach(chart, all_legs)
    yield from _completion_faults(chart, reach.completed)
    yield from _unreachable_faults(chart, reach.entered, all_legs)


def _default_faults(leg: Leg) -> Iterator[str]:
    composite = name_of(leg.source)
    if leg.complete and (leg.end[: len(leg.source)] != leg.source or leg.end == leg.source):
        yield f"{leg.where} goes to {name_of(leg.end)}, which is not inside {composite}."
    if leg.segment.event is not None:
        yield (
            f"{leg.where} waits for the event {leg.segment.event}, but a default path of {composite} is "
            "followed at once; remove the event."
        )


def _crossing_faults(chart: Chart, leg: Leg) -> Iterator[str]:
    if not leg.complete:
        return
    scope = common_composite(leg.source, leg.end)
    if chart.states[scope].parallel:
        yield (
            f"{leg.where} goes from {name_of(leg.source)} to {name_of(leg.end)} across the regions of "
            f"{parallel_name(scope)}; regions are active together, send an event instead."
        )


class PathReach:
    """The states that can be active, and the composites ``completed``: entered without an explicit child.

    Every state is looked at once, however deeply it lies and in whatever order transitions lead to it.
    """

    def __init__(self, chart: Chart, all_legs: Sequence[Leg]) -> None:
        self.entered: set[Path] = set()
        self.completed: set[Path] = set()
        self._chart = chart
        self._ends: dict[tuple[Path, bool], list[Path]] = {}
        for leg in all_legs:
            if leg.complete:
                self._ends.setdefault((leg.source, leg.default), []).append(leg.end)
        self._named: set[Path] = set()
        self._whole: set[Path] = set()
        self._todo: list[Path] = []
        self._complete(())
        while self._todo:
            self._name(self._todo.pop())

    def _name(self, target: Path) -> None:
        """A transition leads to the state: it and what it lies in are entered, with their other regions."""
        state = target
        while state and state not in self._named:
            self._named.add(state)
            self._enter(state)
            parent = state[:-1]
            if self._chart.states[parent].parallel:
                for region in self._chart.states[parent].states:
                    if region.name != state[-1]:
                        self._complete((*parent, region.name))
            state = parent
        self._complete(target)

    def _enter(self, path: Path) -> None:
        if path not in self.entered:
            self.entered.add(path)
            self._todo += self._ends.pop((path, False), ())

    def _complete(self, path: Path) -> None:
        """The state is entered by itself, with all its regions or by its default transition."""
        todo = [path]
        while todo:
            path = todo.pop()
            if path in self._whole:
                continue
            self._whole.add(path)
            if path:
                self._enter(path)
            state = self._chart.states[path]
            if state.parallel:
                todo += [(*path, region.name) for region in state.states]
            elif state.states:
                self.completed.add(path)
                self._todo += self._ends.pop((path, True), ())


def _completion_faults(chart: Chart, completed: set[Path]) -> Iterator[str]:
    for path in sorted(completed):
        default = chart.states[path].default
        if not default:
            yield (
                f"{name_of(path)} is entered without naming one of its states and has no default transition; "
                "give it default=."
            )
        elif not any(_always(chart, path, transition) for transition in default):
            yield (
                f"the default transitions of {name_of(path)} all have guards, so that it may be entered with "
                "none valid; end them with one that has no guard."
            )


def _always(chart: Chart, level: Path, transition: Transition) -> bool:
    """Whether the transition can always be followed to a state."""
    if transition.guard is not None or transition.event is not None:
        return False
    end = chart.resolve(level, transition.target)
    if end is None or end not in chart.junctions:
        return True
    return any(_always(chart, end[:-1], onward) for onward in chart.junctions[end].transitions)


def _unreachable_faults(chart: Chart, entered: set[Path], all_legs: list[Leg]) -> Iterator[str]:
    for path in filter(None, chart.states):
        parent = chart.states[path[:-1]]
        known = not path[:-1] or path[:-1] in entered
        if path not in entered and known and (parent.parallel or parent.default):
            yield f"no transition and no default transition leads to {name_of(path)}; draw one or remove it."
    reached = {leg.end for leg in all_legs}
    for path in chart.junctions:
        if path not in reached:
            yield f"no transition leads to junction {name_of(path)}; draw one or remove the junction."
