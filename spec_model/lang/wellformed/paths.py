"""Paths: regions they may not cross, default transitions, and states that nothing leads to."""

from collections.abc import Iterator

from spec_model.lang.chart import Chart, Path, Transition
from spec_model.lang.wellformed.places import Leg, common_composite, legs, name_of, parallel_name


def path_faults(chart: Chart) -> Iterator[str]:
    """Faults of complete paths and of what they enter."""
    all_legs = list(legs(chart))
    for leg in all_legs:
        yield from _default_faults(leg) if leg.default else _crossing_faults(chart, leg)
    entered, defaulted = _reach(chart, all_legs)
    yield from _completion_faults(chart, defaulted)
    yield from _unreachable_faults(chart, entered, all_legs)


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


def _reach(chart: Chart, all_legs: list[Leg]) -> tuple[set[Path], set[Path]]:
    """The states that can be active, and the composites entered without an explicit child."""
    entered: set[Path] = set()
    completed: set[Path] = set()
    _complete(chart, (), entered, completed)
    size = -1
    while size != len(entered) + len(completed):
        size = len(entered) + len(completed)
        for leg in all_legs:
            if leg.complete and leg.source in (completed if leg.default else entered):
                _enter(chart, leg.end, entered, completed)
    return entered, completed


def _enter(chart: Chart, target: Path, entered: set[Path], completed: set[Path]) -> None:
    for depth in range(1, len(target) + 1):
        parent, state = target[: depth - 1], target[:depth]
        entered.add(state)
        if chart.states[parent].parallel:
            for region in chart.states[parent].states:
                if (*parent, region.name) != state:
                    _complete(chart, (*parent, region.name), entered, completed)
    _complete(chart, target, entered, completed)


def _complete(chart: Chart, path: Path, entered: set[Path], completed: set[Path]) -> None:
    if path:
        entered.add(path)
    state = chart.states[path]
    if state.parallel:
        for region in state.states:
            _complete(chart, (*path, region.name), entered, completed)
    elif state.states:
        completed.add(path)


def _completion_faults(chart: Chart, completed: set[Path]) -> Iterator[str]:
    for path in sorted(completed):
        default = chart.states[path].default
        if not default:
            yield (
                f"{name_of(path)} is entered without naming one of its states and has no default transition; "
                "give it default=."
            )
        elif not any(_always(chart, path, arrow) for arrow in default):
            yield (
                f"the default transitions of {name_of(path)} all have guards, so that it may be entered with "
                "none valid; end them with one that has no guard."
            )


def _always(chart: Chart, level: Path, arrow: Transition) -> bool:
    """Whether the arrow can always be followed to a state."""
    if arrow.guard is not None or arrow.event is not None:
        return False
    end = chart.resolve(level, arrow.target)
    if end is None or end not in chart.junctions:
        return True
    return any(_always(chart, end[:-1], onward) for onward in chart.junctions[end].transitions)


def _unreachable_faults(chart: Chart, entered: set[Path], all_legs: list[Leg]) -> Iterator[str]:
    for path in filter(None, chart.states):
        parent = chart.states[path[:-1]]
        known = not path[:-1] or path[:-1] in entered
        if path not in entered and known and (parent.parallel or parent.default):
            yield f"no arrow and no default transition leads to {name_of(path)}; draw one or remove it."
    reached = {leg.end for leg in all_legs}
    for path in chart.junctions:
        if path not in reached:
            yield f"no arrow leads to junction {name_of(path)}; draw one or remove the junction."
