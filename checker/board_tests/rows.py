"""The steps of a test as rows: equal steps in a row, and what changes before them.

Of a time stamp a row says how many ms before each of its steps the datum came, None where none comes: so a
row holds for as long as a source keeps its rhythm.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from rovercheck.checker.results.board_test import BoardTest, BoardUnderTest, SignalKind, StepSignal, Value

CLOCK = 1 << 32
"""The clock of a board starts again at 0 there."""

Moment = Mapping[str, Value | None]
"""The inputs of a step without the clock, stamps as their lags in ms or None; or the outputs required of it,
None where any value will do."""

Row = tuple[int, Moment, Moment]
"""Equal steps: how many, and the inputs and outputs that differ from those of the step before."""


def clock_of(inputs: Iterable[StepSignal]) -> str:
    """The name of the clock."""
    [clock] = [s.name for s in inputs if s.kind is SignalKind.CLOCK]
    return clock


def moments(inputs: Sequence[StepSignal], given: Iterable[Mapping[str, Value]]) -> Iterator[Moment]:
    """What concrete inputs, step by step from power-up, say without the clock."""
    clock = clock_of(inputs)
    stamps = [s.name for s in inputs if s.kind is SignalKind.STAMP]
    before: Mapping[str, Value] = {s.name: s.initial for s in inputs}
    for at in given:
        lags = {n: (at[clock] - at[n]) % CLOCK if at[n] != before[n] else None for n in stamps}
        yield {s.name: lags.get(s.name, at[s.name]) for s in inputs if s.name != clock}
        before = at


def at_rest(inputs: Sequence[StepSignal]) -> Moment:
    """The inputs before the first step."""
    return {
        s.name: None if s.kind is SignalKind.STAMP else s.initial
        for s in inputs
        if s.kind is not SignalKind.CLOCK
    }


def in_rows(inputs: Moment, outputs: Moment, steps: Iterable[tuple[Moment, Moment]]) -> list[Row]:
    """Steps of inputs and required outputs as few changes, from what holds before the first."""
    found: list[Row] = []
    for given, required in steps:
        changed = {n: v for n, v in given.items() if v != inputs[n]}
        wanted = {n: v for n, v in required.items() if v != outputs[n]}
        if found and not changed and not wanted:
            found[-1] = (found[-1][0] + 1, *found[-1][1:])
        else:
            found.append((1, changed, wanted))
        inputs, outputs = given, required
    return found


def rows(test: BoardTest) -> list[Row]:
    """The rows of a test.  Before the first, inputs are at rest, and outputs may be anything."""
    inputs, anything = test.board.inputs, dict.fromkeys(o.name for o in test.board.outputs)
    given = moments(inputs, (step.inputs for step in test.steps))
    required = ({name: step.outputs.get(name) for name in anything} for step in test.steps)
    return in_rows(at_rest(inputs), anything, zip(given, required, strict=True))


def by_board(tests: Iterable[BoardTest]) -> dict[BoardUnderTest, list[BoardTest]]:
    """The tests of each board, in their order."""
    found: dict[BoardUnderTest, list[BoardTest]] = {}
    for test in tests:
        found.setdefault(test.board, []).append(test)
    return found


def start_ms(test: BoardTest) -> int:
    """The time of the first step; 0 of a test without steps."""
    return int(test.steps[0].inputs[clock_of(test.board.inputs)]) if test.steps else 0
