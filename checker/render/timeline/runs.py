"""The values of a variable over time as runs: equal values in a row, and running counters."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

from rovercheck.checker.render.lanes import Tone
from rovercheck.checker.render.limits import timer
from rovercheck.checker.render.periods import RepeatedTicks
from rovercheck.checker.render.story import value
from rovercheck.checker.render.timeline.model import Lane, LaneKind, NeededTicks, TimelineRun
from rovercheck.checker.render.timeline.tones import tone
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.domain import Num

STEADY = 3
"""Ticks in a row with the same difference are one ramp."""

Values = Sequence[int | None]
"""A raw value for each tick; None where there is none."""


def runs(trace: Trace, name: str, values: Values, kind: LaneKind) -> Iterator[TimelineRun]:
    """Equal values in a row are one run; so is a steady count of a number."""
    sort = trace.system.variables[name].sort
    scale = sort.resolution if isinstance(sort, Num) else Fraction(1)
    for first, last in stretches(values, steady=kind in (LaneKind.LINE, LaneKind.RAMP)):
        start, end = values[first], values[last]
        if start is None or end is None:
            continue
        shown, until = (_shown(trace, name, raw, kind) for raw in (start, end))
        meaning = tone(shown) if kind is LaneKind.BAND else Tone.ACTION
        until = until if start != end else ""
        yield TimelineRun(first + 1, last + 1, shown, start * scale, end * scale, meaning, until)


def _shown(trace: Trace, name: str, raw: int, kind: LaneKind) -> str:
    if kind is not LaneKind.RAMP:
        return value(trace, name, raw)
    known = timer(trace, name)
    return known.shown(raw) if known else f"{raw} steps"


def stretches(values: Values, steady: bool) -> Iterator[tuple[int, int]]:
    """The indices at which runs start and end."""
    first = 0
    while first < len(values):
        last = _reach(values, first, 0)
        if steady and last == first and last + 1 < len(values):
            here, after = values[first], values[first + 1]
            if here is not None and after is not None:
                far = _reach(values, first, after - here)
                last = far if far - first + 1 >= STEADY else first
        yield first, last
        first = last + 1


def _reach(values: Values, first: int, step: int) -> int:
    """How far values rise by this step from the first on."""
    last = first
    while last + 1 < len(values):
        here, after = values[last], values[last + 1]
        if here is None or after is None:
            if here is not after:
                break
        elif after - here != step:
            break
        last += 1
    return last


def outside(lane: Lane, folds: Sequence[RepeatedTicks]) -> Lane:
    """The lane without what is in ticks that only repeat others; what reaches into them is cut there."""
    for fold in folds:
        spans = ((1, fold.first - 1), (fold.last + 1, lane.runs[-1].last if lane.runs else 0))
        lane = replace(
            lane,
            runs=tuple(piece for run in lane.runs for span in spans for piece in _cut(run, *span)),
            needed=tuple(
                NeededTicks(max(need.first, low), min(need.last, high), need.condition)
                for need in lane.needed
                for low, high in spans
                if need.first <= high and need.last >= low
            ),
            shots=tuple(shot for shot in lane.shots if not fold.first <= shot.tick <= fold.last),
        )
    return lane


def _cut(run: TimelineRun, low: int, high: int) -> Iterator[TimelineRun]:
    """The piece of a run between two ticks; that of a steady count says nothing where it does not begin."""
    first, last = max(run.first, low), min(run.last, high)
    if (first, last) == (run.first, run.last):
        yield run
    elif first <= last:
        step = (run.high - run.low) / max(1, run.last - run.first)
        label = run.label if first == run.first or not run.until else ""
        ends = run.low + step * (first - run.first), run.low + step * (last - run.first)
        yield TimelineRun(first, last, label, *ends, run.tone)
