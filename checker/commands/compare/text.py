"""The report of a cross-check, for people in 80 columns and for machines."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from shlex import quote

from rovercheck.checker.board_tests.rows import in_rows
from rovercheck.checker.commands.shared.output import counted, text_width
from rovercheck.checker.commands.shared.text_wrap import filled, whole
from rovercheck.checker.compare.beside import StepMismatch, SteppedCharts, author_of
from rovercheck.checker.compare.coverage import taken
from rovercheck.checker.compare.reproduce import script_of
from rovercheck.checker.compare.result import CompareResult, CompareStage, Failure
from rovercheck.checker.compare.smaller import columns
from rovercheck.checker.compare.strategy import ENVIRONMENTS
from rovercheck.spec_model.abstraction import BoardSignal, Value
from rovercheck.spec_model.lang.system import TICK_MS

BEFORE = 3
"""Steps before that of the mismatch of which the transitions are told."""


@dataclass(frozen=True)
class CrosscheckReport:
    """A result, the implementation that it is about, and the tests written for its mismatches."""

    result: CompareResult
    address: str
    files: Sequence[Path] = ()
    charts: str = ""
    """How the charts differ from those specified, in words."""


def report(of: CrosscheckReport) -> str:
    """The whole report of one board."""
    result = of.result
    lines = [*map(_wrapped, result.notes)]
    for number, found in enumerate(shown(result), 1):
        told = _mismatch(number, found) if isinstance(found, StepMismatch) else _failure(number, found)
        lines += ["", *told, *_test(of.files, number)]
    for failure in result.failures:
        if not failure.steps:
            lines += ["", _wrapped(f"✗ In {failure.origin}: {failure.message}")]
    if others := result.mismatches[result.small :]:
        lines += ["", *(_wrapped(f"✗ {_in_short(one)}") for one in others)]
    return "\n".join([*lines, *([""] if lines else []), *_summary(result)])


def shown(result: CompareResult) -> Sequence[StepMismatch | Failure]:
    """What is reported with inputs and a test: small mismatches, then each way to fail, at its shortest."""
    causes: dict[str, Failure] = {}
    for failure in result.failures:
        if failure.steps:
            causes.setdefault(_cause(failure), failure)
    return [*result.mismatches[: result.small], *causes.values()]


def _cause(failure: Failure) -> str:
    """The message without the number of the step."""
    return failure.message.replace(f"step {failure.tick}:", "", 1)


def _wrapped(text: str, indent: str = "") -> str:
    width, then = text_width(), indent + "  "
    return "\n".join(filled(line, width, indent, then) for line in text.splitlines())


def _in_short(mismatch: StepMismatch) -> str:
    """A mismatch in a line: which output differs, where, after which transition of its chart."""
    first = mismatch.differences[0].name
    fired = [f for f in mismatch.steps[-1].fired if f.chart == author_of(mismatch.board, first)]
    transition = f"; {taken(fired[-1])}" if fired else ""
    return f"{mismatch.board.name}, step {mismatch.tick} of {mismatch.origin}: {first} differs{transition}"


# --- a mismatch ---------------------------------------------------------------------------------------


def _mismatch(number: int, mismatch: StepMismatch) -> Iterator[str]:
    board = mismatch.board
    first = mismatch.differences[0].name
    time = f"{mismatch.tick * TICK_MS / 1000:g} s"
    yield _wrapped(f"✗ {number}. {board.name}, step {mismatch.tick} = {time}: {first} differs.")
    yield from _inputs(mismatch)
    signals = {o.name: o.signal for o in board.outputs}
    yield f"   {'output':<26}{'charts':<24}implementation"
    for d in mismatch.differences:
        actual = "missing" if d.actual is None else signals[d.name].show(d.actual)
        yield f"   {d.name:<26}{signals[d.name].show(d.expected):<24}{actual}"
    yield from _transitions(mismatch, author_of(board, first))


def _failure(number: int, failure: Failure) -> Iterator[str]:
    time = f"{failure.tick * TICK_MS / 1000:g} s"
    yield _wrapped(
        f"✗ {number}. {failure.board.name}, step {failure.tick} = {time}: it does not answer as it must."
    )
    yield _wrapped(failure.message, "   ")
    yield from _inputs(failure)


def _inputs(mismatch: StepMismatch | Failure) -> Iterator[str]:
    """The inputs that are not at rest in the step, and since when; then how the run got there."""
    board = mismatch.board
    run = columns(board, [step.inputs for step in mismatch.steps])
    resting = ENVIRONMENTS[board.name].calm
    signals = {s.name: s for s in board.inputs}
    yield "   inputs that are not at rest in that step:"
    told = False
    for name, column in run.columns.items():
        last = column[-1]
        if last != resting[name]:
            since = next((k for k in range(len(column), 0, -1) if column[k - 1] != last), 0) + 1
            value = _stamped(last) if signals[name].stamp else signals[name].show(_known(last))
            told = True
            yield _wrapped(f"{name} = {value}, since step {since}", "     ")
    if not told:
        yield "     none"
    yield "   and before it:"
    yield from _history(mismatch)


def _known(value: Value | None) -> Value:
    assert value is not None
    return value


def _stamped(lag: Value | None) -> str:
    return "no update" if lag is None else f"updated {lag} ms before the step"


def _history(mismatch: StepMismatch | Failure) -> Iterator[str]:
    """What changes when, from inputs at rest on."""
    board = mismatch.board
    signals = {s.name: s for s in board.inputs}
    resting, step = ENVIRONMENTS[board.name].calm, 1
    for steps, changes, _ in in_rows(resting, {}, ((moment, {}) for moment in script_of(mismatch))):
        changed = [f"{name} = {_shown(signals[name], value)}" for name, value in changes.items()]
        yield _wrapped(f"step {step}: {', '.join(changed) or 'everything at rest'}", "     ")
        step += steps


def _shown(signal: BoardSignal, value: Value | None) -> str:
    if signal.stamp:
        return "silent" if value is None else f"updated {value} ms before each step"
    return signal.show(_known(value))


def _transitions(mismatch: StepMismatch, author: str) -> Iterator[str]:
    """The transition that decides the output; where none was taken, the states in which its chart stays."""
    fired = [f for f in mismatch.steps[-1].fired if f.chart == author]
    if fired:
        yield "   the charts took"
        for one in fired:
            yield _wrapped(str(taken(one)), "     ")
    else:
        yield _wrapped(
            f"the charts took no transition of {author} in that step{_states(mismatch, author)}", "   "
        )
    for back in range(min(BEFORE, mismatch.tick - 1), 0, -1):
        earlier = [f for f in mismatch.steps[-1 - back].fired if f.chart == author]
        for one in earlier:
            yield _wrapped(f"{counted(back, 'step', 'steps')} before: {taken(one)}", "     ")


def _states(mismatch: StepMismatch, author: str) -> str:
    """Where a chart is after the step."""
    chart = next((c for c in mismatch.board.system.charts if c.name == author), None)
    if chart is None:
        return ": it is a function block."
    charts = SteppedCharts(mismatch.board)
    for step in mismatch.steps:
        charts.step(step.inputs)
    at = charts.valuation()
    places = [v.domain.show(at[v.name]) for v in chart.locations if at[v.name]]
    return f"; it is in {', '.join(places)}." if places else "."


def _test(files: Sequence[Path], number: int) -> Iterator[str]:
    if number <= len(files):
        yield "   " + whole(f"pytest {quote(str(files[number - 1]))}")


# --- all of it ------------------------------------------------------------------------------------------


def _summary(result: CompareResult) -> Iterator[str]:
    cover, (took, of) = result.coverage, result.transitions
    met, sides = cover.boundaries()
    ended = result.compared < cover.steps
    part = f", {result.compared:,} of them compared, as a run ends where it differs" if ended else ""
    yield _wrapped(
        f"{_sign(result)} {result.board.name} {_verdict(result)}: {cover.steps:,} steps in "
        f"{counted(cover.runs, 'run', 'runs')}{part}; the charts took {took} of {of} transitions, "
        f"and inputs met {met} of {sides} sides of boundaries."
    )
    for stage in result.stages:
        if stage.because:
            yield _wrapped(_untried(stage), "  ")
    if _given_up(result):
        yield _wrapped(f"Try more with --failures N (now {result.allowance.failures}).", "  ")
    if result.small < len(result.mismatches):
        yield _wrapped(
            f"Mismatches with inputs and a test: {result.small} of {len(result.mismatches)}; "
            f"all of them with --mismatches {len(result.mismatches)}.", "  "
        )  # fmt: skip
    if result.uncompared:
        yield _wrapped(f"Not compared, because it never gave them: {', '.join(result.uncompared)}.", "  ")
    if result.missing and not _given_up(result):
        yield f"  Transitions that no run took ({len(result.missing)}; some cannot be):"
        yield from (_wrapped(str(transition), "    ") for transition in result.missing)


def _untried(stage: CompareStage) -> str:
    """``Random runs: 21 of 240 tried; given up after 3 runs not survived.``"""
    tried = f"{stage.tried} tried, not all" if stage.of is None else f"{stage.tried} of {stage.of} tried"
    return f"{stage.kind.capitalize()}: {tried}; {stage.because}."


def _sign(result: CompareResult) -> str:
    return "✗" if result.differs else "✓" if result.conforms else "?"


def _verdict(result: CompareResult) -> str:
    if result.differs:
        return f"does not conform ({', '.join(_differences(result))})"
    if result.conforms:
        return "conforms"
    return "is inconclusive (interrupted)" if result.interrupted else "is inconclusive (no output to compare)"


def _differences(result: CompareResult) -> Iterator[str]:
    if result.mismatches:
        yield counted(len(result.mismatches), "mismatch", "mismatches")
    if result.failures:
        gave_up = ", then the search gave up" if _given_up(result) else ""
        yield f"{counted(len(result.failures), 'run', 'runs')} not survived{gave_up}"


def _given_up(result: CompareResult) -> bool:
    return len(result.failures) >= result.allowance.failures
