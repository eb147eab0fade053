"""Which states of a chart are active: read off the values of all variables, or followed
along the transitions that fired.
"""

from collections.abc import Mapping

from rovercheck.checker.results.trace import TakenTransition
from rovercheck.spec_model.lang.chart import NOWHERE, Chart, Path

Active = frozenset[Path]
"""The paths of the active states, those around them included."""


def active(chart: Chart, values: Mapping[str, int]) -> Active:
    """The active states, given all values; what lies below a location that it does not hold is unknown."""
    found: set[Path] = set()
    levels: list[Path] = [()] if _entered(chart, values) else []
    for level in levels:
        inside = [(*level, name) for name in _children(chart, level, values)]
        found.update(inside)
        levels += inside
    return frozenset(found)


def _entered(chart: Chart, values: Mapping[str, int]) -> bool:
    entered = chart.entered
    return not chart.root.parallel or values.get(entered.name) == entered.domain.raw("yes")


def _children(chart: Chart, level: Path, values: Mapping[str, int]) -> list[str]:
    state = chart.states[level]
    if state.parallel or not state.states:
        return [child.name for child in state.states]
    place = chart.location(level)
    name = place.domain.show(values[place.name]) if place.name in values else NOWHERE
    return [] if name == NOWHERE else [name]


def followed(chart: Chart, before: Active, arrow: TakenTransition) -> Active:
    """The active states once an arrow of this chart has been taken, before any other fires (rule G9)."""
    source, target = _path(arrow.source), _path(arrow.target)
    left = source[: len(_scope(source, target)) + 1] if arrow.order else ()
    kept = {path for path in before if not left or path[: len(left)] != left}
    for depth in range(len(target)):
        for entered in _together(chart, target[:depth], target[: depth + 1]):
            kept |= {entered, *_regions(chart, entered)}
    return frozenset(kept)


def _path(dotted: str) -> Path:
    return tuple(dotted.split(".")) if dotted else ()


def _scope(source: Path, target: Path) -> Path:
    """The innermost composite with both ends inside it."""
    depth = min(len(source), len(target)) - 1
    while source[:depth] != target[:depth]:
        depth -= 1
    return source[:depth]


def _together(chart: Chart, level: Path, child: Path) -> set[Path]:
    """A state that is entered, with all regions beside it if it is one."""
    state = chart.states[level]
    return {(*level, region.name) for region in state.states} if state.parallel else {child}


def _regions(chart: Chart, path: Path) -> set[Path]:
    """The regions entered with a parallel state, and those that are the whole of a region."""
    state = chart.states[path]
    if not state.parallel:
        return set()
    inside = {(*path, region.name) for region in state.states}
    return inside.union(*(_regions(chart, region) for region in inside))
