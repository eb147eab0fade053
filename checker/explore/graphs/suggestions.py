"""Which projections of a system are worth a look, with the number of nodes each would have."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from rovercheck.checker.engines import Limits, Progress, quiet
from rovercheck.checker.explore.graphs.projection import exact_with, projection
from rovercheck.checker.explore.graphs.reachable_ticks import ReachableTicks
from rovercheck.checker.explore.graphs.search import explore
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

SMALL = 16
"""Values of a variable that is offered for a projection."""
MOST = 12
"""Projections offered."""


@dataclass(frozen=True)
class ReachedValues:
    """A variable, and how many of its values are reached."""

    var: Var
    values: int


@dataclass(frozen=True)
class Offer:
    """Variables to project on, and what that gives; ``mixed``: its paths need not be runs."""

    names: tuple[str, ...]
    nodes: int
    mixed: bool


@dataclass(frozen=True)
class Suggestions:
    """What can be projected on; where the exploration is ``cut``, all counts are lower bounds."""

    variables: tuple[ReachedValues, ...]
    offers: tuple[Offer, ...]
    valuations: int
    cut: str


def suggestions(system: TransitionSystem, limits: Limits, progress: Progress = quiet) -> Suggestions:
    """Projections on the locations of charts and on small variables."""
    places = _places(system)
    known = {v.name for v in (*system.variables, *system.frozen)}
    small = [v.name for v in system.variables if _offered(v) and v.name not in places]
    tried = [name for name in (*places, *small) if name in known]
    half = replace(limits, seconds=None if limits.seconds is None else limits.seconds / 2)
    explored = explore(system, tried, half, progress).explored
    if explored.stopped and places and small:
        explored = explore(system, [p for p in places if p in known], half, progress).explored
    return among(explored, places)


def _places(system: TransitionSystem) -> list[str]:
    return [v.name for c in system.source.charts for v in c.locations] if system.source else []


def _offered(var: Var) -> bool:
    return not var.hidden and 1 < len(var.domain) <= SMALL and not var.name.endswith(".entered")


def among(explored: ReachableTicks, places: Sequence[str], most: int | None = None) -> Suggestions:
    """Projections of what is explored already, those with more than ``most`` nodes left out."""
    own = {v.name: v for v in explored.variables}
    first = [name for name in places if name in own]
    names = [*first, *(n for n, v in own.items() if n not in first and _offered(v))]
    reached = tuple(ReachedValues(own[name], len(set(explored.column(name).tolist()))) for name in names)
    useful = [r.var.name for r in reached if r.values > 1]
    offers = [
        _offer(explored, group) for group in _groups(explored, [p for p in first if p in useful], useful)
    ]
    some = [offer for offer in offers if offer.nodes > 1 and (most is None or offer.nodes <= most)]
    some.sort(key=lambda offer: offer.nodes == 2)  # two nodes tell little
    return Suggestions(reached, tuple(some[:MOST]), len(explored), explored.stopped)


def _offer(explored: ReachableTicks, names: tuple[str, ...]) -> Offer:
    seen = projection(explored, [explored.column(name) for name in names])
    return Offer(names, len(seen.first), seen.mixes)


def _groups(
    explored: ReachableTicks, places: Sequence[str], useful: Sequence[str]
) -> Iterable[tuple[str, ...]]:
    """Locations one by one, of a chart, of all charts, with what makes these exact; small variables."""
    charts: dict[str, tuple[str, ...]] = {}
    for place in places:
        chart = place.split(".")[0]
        charts[chart] = (*charts.get(chart, ()), place)
    base = tuple(places) or tuple(useful[:1])
    refined = [] if explored.stopped or not base else exact_with(explored, base)
    groups = [
        *((place,) for place in places[:6]),
        *charts.values(),
        *((a[0], b[0]) for a, b in combinations(list(charts.values())[:3], 2)),
        base,
        *((*base, *names) for names, _ in refined[:2]),
        *((name,) for name in useful if name not in places),
    ]
    return dict.fromkeys(group for group in groups if group)
