"""Directed sends (rule G10): receivers that react, no endless nesting, no sender left by its own send."""

from collections.abc import Iterator
from dataclasses import dataclass

from spec_model.lang.action import Send, each_action
from spec_model.lang.chart import Chart, Path
from spec_model.lang.errors import ModelError
from spec_model.lang.wellformed.places import Leg, Place, common_composite, legs, name_of, places


@dataclass(frozen=True)
class _Site:
    """A send, the state whose action or arrow it is in, and the state it executes."""

    send: Send
    place: Place
    receiver: Path

    def __str__(self) -> str:
        return f"`{self.send}` in {self.place.where}"


def send_faults(chart: Chart) -> Iterator[str]:
    """Faults of sends and of arrows that wait for an event."""
    sites, faults = _sites(chart)
    yield from faults
    all_legs = [leg for leg in legs(chart) if not leg.default]
    if not faults:
        yield from _silence_faults(sites, all_legs)
        yield from _nesting_faults(chart, sites, all_legs)


def _sites(chart: Chart) -> tuple[list[_Site], list[str]]:
    sites: list[_Site] = []
    faults: list[str] = []
    for place in places(chart):
        for action in each_action(place.actions):
            if isinstance(action, Send):
                try:
                    sites.append(_Site(action, place, chart.path(action.receiver)))
                except ModelError as error:
                    faults.append(f"`{action}` in {place.where} has no receiver: {error}")
    return sites, faults


def _silence_faults(sites: list[_Site], all_legs: list[Leg]) -> Iterator[str]:
    """Events sent to states that do not react, and events waited for that nobody sends there."""
    for site in sites:
        inside = [leg for leg in all_legs if _within(leg.source, site.receiver)]
        if all(leg.segment.event != site.send.event for leg in inside):
            yield f"{site}: no arrow inside {name_of(site.receiver)} waits for the event {site.send.event}."
    for leg in all_legs:
        event = leg.segment.event
        sources = [other.source for other in all_legs if other.segment is leg.segment]
        receivers = [site.receiver for site in sites if site.send.event == event]
        if event is not None and not any(_within(s, r) for s in sources for r in receivers):
            yield f"{leg.where} waits for the event {event}, which is never sent to {name_of(leg.source)}."


def _nesting_faults(chart: Chart, sites: list[_Site], all_legs: list[Leg]) -> Iterator[str]:
    touched = {s.receiver: _touched(chart, s.receiver, all_legs) for s in sites}
    onward = {id(s): [o for o in sites if o.place.owner in touched[s.receiver]] for s in sites}
    for site in sites:
        nested = _closure(site, onward)
        to_itself = _within(site.place.owner, site.receiver)
        leaving = [f for s in (site, *nested) for f in _departure_faults(site, s.receiver, all_legs)]
        if leaving and not to_itself:
            yield from leaving
        elif to_itself or any(s is site for s in nested):
            yield f"{site} can lead to the same send again, for ever; break the cycle of sends."


def _departure_faults(site: _Site, executed: Path, all_legs: list[Leg]) -> Iterator[str]:
    """Arrows taken during a send that leave the state the sender is in."""
    for leg in all_legs:
        if leg.complete and _within(leg.source, executed):
            scope = common_composite(leg.source, leg.end)
            if _within(site.place.owner, leg.source[: len(scope) + 1]):
                yield (
                    f"{site} executes {name_of(executed)}, where {leg.where} would leave "
                    f"{name_of(site.place.owner)} in the middle of its own action."
                )


def _touched(chart: Chart, executed: Path, all_legs: list[Leg]) -> set[Path]:
    """States whose actions may run when ``executed`` is: those inside it, and what its arrows enter."""
    found = {p for p in chart.states if _within(p, executed)}
    for leg in all_legs:
        if leg.complete and _within(leg.source, executed):
            scope = common_composite(leg.source, leg.end)
            ends = (leg.source[: len(scope) + 1], leg.end[: len(scope) + 1])
            found |= {p for p in chart.states if any(_within(p, end) for end in ends)}
    return found


def _closure(site: _Site, onward: dict[int, list[_Site]]) -> list[_Site]:
    found: dict[int, _Site] = {}
    todo = list(onward[id(site)])
    while todo:
        nested = todo.pop()
        if id(nested) not in found:
            found[id(nested)] = nested
            todo += onward[id(nested)]
    return list(found.values())


def _within(path: Path, outer: Path) -> bool:
    return path[: len(outer)] == outer
