"""A trace cut into the steps of its player: transition by transition, with what is active after each."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.render.drawing.activity import Active, active, followed
from rovercheck.checker.render.story import Quiet, Repeats, StoryEvent, rows
from rovercheck.checker.results.trace import TakenTransition, Trace
from rovercheck.spec_model.lang.chart import Chart

States = Mapping[str, Active]
"""The active states of each chart, by its name."""


@dataclass(frozen=True)
class PlayerStep:
    """Transitions ``first`` to ``last`` (exclusive) of an event, and what is active after them.

    Several transitions are one step if all but the first are default transitions.  ``event`` is a position
    among the events of the trace; it is None for the step before the first tick.
    """

    event: int | None
    first: int
    last: int
    states: States


@dataclass(frozen=True)
class Script:
    """What is played: the events of a trace, its quiet stretches, where it repeats, and the steps."""

    events: tuple[StoryEvent, ...]
    quiet: tuple[Quiet, ...]
    repeats: Repeats | None
    steps: tuple[PlayerStep, ...]


def shown_charts(trace: Trace, *, everything: bool = False) -> tuple[Chart, ...]:
    """The charts on which the property depends, as far as they are known; with ``everything`` all."""
    every = tuple(trace.system.statecharts.values())
    named = tuple(chart for chart in every if chart.name in trace.property.charts)
    return every if everything else named or every


def script(trace: Trace, *, everything: bool = False) -> Script:
    """The steps of a trace and the words for them; ``everything`` tells also what does not matter."""
    charts = shown_charts(trace, everything=everything)
    told = list(rows(trace if everything else trace.focused()))
    events = tuple(row for row in told if isinstance(row, StoryEvent))
    quiet = tuple(row for row in told if isinstance(row, Quiet))
    repeats = next((row for row in told if isinstance(row, Repeats)), None)
    return Script(events, quiet, repeats, tuple(_steps(trace, charts, events)))


def _steps(trace: Trace, charts: Sequence[Chart], events: Sequence[StoryEvent]) -> Iterator[PlayerStep]:
    states = _states(charts, trace.before)
    yield PlayerStep(None, 0, 0, states)
    for number, event in enumerate(events):
        after = _states(charts, trace.ticks[event.number - 1].after)
        cuts = _cuts(event.transitions)
        for first, last in cuts[:-1]:
            states = _moved(charts, states, event.transitions[first:last])
            yield PlayerStep(number, first, last, states)
        states = after
        yield PlayerStep(number, *cuts[-1], after)


def _states(charts: Sequence[Chart], values: Mapping[str, int]) -> States:
    return {chart.name: active(chart, values) for chart in charts}


def _cuts(transitions: Sequence[TakenTransition]) -> list[tuple[int, int]]:
    """Where each step starts and ends; an event without transitions is one step."""
    starts = [i for i, transition in enumerate(transitions) if i == 0 or transition.order] or [0]
    return list(zip(starts, [*starts[1:], len(transitions)], strict=True))


def _moved(charts: Sequence[Chart], states: States, transitions: Sequence[TakenTransition]) -> States:
    now = dict(states)
    by_name = {chart.name: chart for chart in charts}
    for transition in transitions:
        if transition.chart in by_name:
            now[transition.chart] = followed(by_name[transition.chart], now[transition.chart], transition)
    return now
