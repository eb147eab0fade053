"""Directed sends (rule G10): receivers that react, no endless nesting, no sender left by its own send."""

from collections.abc import Iterator
from dataclasses import dataclass

from rovercheck.spec_model.lang.action import Send, each_action
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.wellformed.places import (
    ActionPlace,
    Leg,
    common_composite,
    legs,
    name_of,
    places,
)


@dataclass(frozen=True)
class _Site:
    """A send, the state whose action or transition it is in, and the state it executes."""

    send: Send
    place: ActionPlace
    receiver: Path

    def __str__(self) -> str:
        return f"`{self.send}` in {self.place.where}"


def send_faults(chart: Chart) -> Iterator[str]:
    """Faults of sends and of transitions that wait for an event."""
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
    waiting = [leg for leg in all_legs if leg.segment.event is not None]
    waits = {(outer, leg.segment.event) for leg in waiting for outer in _around(leg.source)}
    for site in sites:
        if (site.receiver, site.send.event) not in waits:
            yield (
                f"{site}: no transition inside {name_of(site.receiver)} "
                f"waits for the event {site.send.event}."
            )
    sent = {(site.receiver, site.send.event) for site in sites}
    heard = {
        id(leg.segment)
        for leg in waiting
        if any((outer, leg.segment.event) in sent for outer in _around(leg.source))
    }
    for leg in waiting:
        if id(leg.segment) not in heard:
            event, state = leg.segment.event, name_of(leg.source)
            yield f"{leg.where} waits for the event {event}, which is never sent to {state}."


def _nesting_faults(chart: Chart, sites: list[_Site], all_legs: list[Leg]) -> Iterator[str]:
    run = {receiver: _Run(chart, receiver, all_legs) for receiver in {s.receiver: None for s in sites}}
    onward = {r: {s.receiver: None for s in sites if s.place.owner in run[r].touched} for r in run}
    nested = {receiver: _closure(receiver, onward) for receiver in run}
    for site in sites:
        to_itself = _within(site.place.owner, site.receiver)
        leaving = [fault for r in nested[site.receiver] for fault in _departure_faults(site, run[r])]
        if leaving and not to_itself:
            yield from leaving
        elif to_itself or any(site.place.owner in run[r].touched for r in nested[site.receiver]):
            yield f"{site} can lead to the same send again, for ever; break the cycle of sends."


class _Run:
    """What may happen when a state is executed: transitions inside it by the states they leave, and
    ``touched``.

    These are the states whose actions may run: those inside it, and what its transitions leave and enter.
    """

    def __init__(self, chart: Chart, executed: Path, all_legs: list[Leg]) -> None:
        self.executed = executed
        self.leaving: dict[Path, list[Leg]] = {}
        touched = {executed}
        for leg in all_legs:
            if leg.complete and _within(leg.source, executed):
                depth = len(common_composite(leg.source, leg.end)) + 1
                self.leaving.setdefault(leg.source[:depth], []).append(leg)
                touched |= {leg.source[:depth], leg.end[:depth]}
        self.touched = {p for p in chart.states if any(outer in touched for outer in _around(p))}


def _departure_faults(site: _Site, run: _Run) -> Iterator[str]:
    """Transitions taken during a send that leave the state the sender is in."""
    for left in _around(site.place.owner):
        for leg in run.leaving.get(left, ()):
            yield (
                f"{site} executes {name_of(run.executed)}, where {leg.where} would leave "
                f"{name_of(site.place.owner)} in the middle of its own action."
            )


def _closure(receiver: Path, onward: dict[Path, dict[Path, None]]) -> list[Path]:
    """The states executed when this one is, by sends that lead to sends."""
    found: dict[Path, None] = {}
    todo = [receiver]
    while todo:
        executed = todo.pop()
        if executed not in found:
            found[executed] = None
            todo += onward[executed]
    return list(found)


def _around(path: Path) -> list[Path]:
    """A state and all that it is in, the chart first."""
    return [path[:depth] for depth in range(len(path) + 1)]


def _within(path: Path, outer: Path) -> bool:
    return path[: len(outer)] == outer
