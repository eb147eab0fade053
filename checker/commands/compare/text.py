"""The report of a cross-check, for people in 80 columns and for machines."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from shlex import quote

from rovercheck.checker.board_tests.rows import in_rows
from rovercheck.checker.commands.compare.cause_text import cause_lines, searched, times, wrapped
from rovercheck.checker.commands.shared.deviation_text import headline
from rovercheck.checker.commands.shared.known import known_lines, mark
from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.commands.shared.silence import talkative
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.compare.beside import StepMismatch
from rovercheck.checker.compare.coverage import taken
from rovercheck.checker.compare.reproduce import script_of
from rovercheck.checker.compare.result import CompareResult, CompareStage, Failure
from rovercheck.checker.compare.smaller import columns
from rovercheck.checker.compare.strategy import environment
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.known import KnownJudgement
from rovercheck.checker.diagnosis.causes import CauseGroups, DeviationCause, by_itself
from rovercheck.spec_model.abstraction import BoardSignal, Value

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
    judgement: KnownJudgement = field(default_factory=lambda: KnownJudgement({}))
    with_known: bool = False
    """Whether known deviations were named, or are to be written."""
    groups: CauseGroups = field(default_factory=CauseGroups)

    @property
    def findings(self) -> Sequence[DeviationCause]:
        """The deviations, those of one cause together; where none was looked for, each by itself."""
        return self.groups.causes or by_itself(self.result.deviations).causes

    def mismatch(self, one: Deviation) -> StepMismatch:
        """A run in whose last step a deviation is met."""
        return next(m for m in self.result.mismatches if m.deviation and m.deviation.scope == one.scope)

    def is_small(self, finding: DeviationCause) -> bool:
        """Whether it is told in full."""
        small = {m.deviation.scope for m in self.result.mismatches[: self.result.small] if m.deviation}
        return finding.first.scope in small

    @property
    def differs(self) -> bool:
        """Whether the implementation does something else than the charts that is not known."""
        unknown = self.judgement.unknown if self.judgement.found else len(self.result.mismatches)
        return bool(unknown or self.result.failures)

    @property
    def as_expected(self) -> bool:
        """Whether nothing but the known differs in every run that was asked for, and all was decided."""
        result = self.result
        return result.conclusive and not self.differs and not (result.mismatches and result.undecided)


def often(deviation: Deviation, result: CompareResult) -> str:
    """How often it was met, and where first: there its run is the shortest."""
    first = f"first in step {deviation.first.tick} of {deviation.origin}"
    return f"in {times(deviation.runs, deviation.count, result)}; {first}"


def report(of: CrosscheckReport) -> str:
    """The whole report of one board."""
    result = of.result
    lines = [wrapped(note if talkative() else note.partition("\n")[0]) for note in result.notes]
    full = [one for one in of.findings if of.is_small(one)]
    for number, one in enumerate(full, 1):
        lines += ["", *_mismatch(number, one, of), *_test(of.files, number)]
    for number, failure in enumerate(shown(result)[result.small :], result.small + 1):
        assert isinstance(failure, Failure)
        lines += ["", *_failure(number, failure), *_test(of.files, number)]
    for failure in result.failures:
        if not failure.steps:
            lines += ["", wrapped(f"✗ In {failure.origin}: {failure.message}")]
    for part in _by_part(of, full):
        lines += ["", *(_in_short(*part[0], of) if len(part) == 1 else _together(part, of, full))]
    return "\n".join([*lines, *([""] if lines else []), *_summary(of)])


def shown(result: CompareResult) -> Sequence[StepMismatch | Failure]:
    """What is reported with inputs and a test: small mismatches, then each way to fail, at its shortest."""
    causes: dict[str, Failure] = {}
    for failure in result.failures:
        if failure.steps:
            causes.setdefault(failure_cause(failure), failure)
    return [*result.mismatches[: result.small], *causes.values()]


def failure_cause(failure: Failure) -> str:
    """The message without the number of the step."""
    return failure.message.replace(f"step {failure.tick}:", "", 1)


Numbered = tuple[int, DeviationCause]


def _by_part(of: CrosscheckReport, full: Sequence[DeviationCause]) -> Iterator[list[Numbered]]:
    """The findings that are not told in full with their numbers, those of one chart or block together."""
    found: dict[str, list[Numbered]] = {}
    rest = [one for one in of.findings if one not in full]
    for number, one in enumerate(rest, len(full) + 1):
        found.setdefault(one.part, []).append((number, one))
    yield from found.values()


def _together(
    found: Sequence[Numbered], of: CrosscheckReport, full: Sequence[DeviationCause]
) -> Iterator[str]:
    """What one chart or block does otherwise, a line for each finding."""
    board, part = of.result.board.name, found[0][1].part
    more = "more " if part in {one.part for one in full} else ""
    yield wrapped(f"✗ {board}, {part or 'what no part decides'} differs in {len(found)} {more}ways:")
    for number, one in found:
        told = headline(one.first).removeprefix(f"{part}: ")
        runs = counted(one.first.runs, "run", "runs")
        yield wrapped(f"{number}. {told}, in {runs}{_mark(one, of)}", "   ")
        for move in one.first.scope.charts:
            yield wrapped(move.removeprefix(f"{part}: "), "      ")
        yield from cause_lines(one, of.result, "      ")


def _in_short(number: int, one: DeviationCause, of: CrosscheckReport) -> Iterator[str]:
    """A finding without its inputs: what differs, how often, what the charts do there, and why."""
    yield wrapped(f"✗ {number}. {of.result.board.name}, {headline(one.first)}.{_mark(one, of)}")
    yield wrapped(f"{often(one.first, of.result)}", "   ")
    for move in one.first.scope.charts:
        yield wrapped(move, "     ")
    yield from cause_lines(one, of.result, "   ")


def _mark(one: DeviationCause, of: CrosscheckReport) -> str:
    if not of.with_known:
        return ""
    judged = of.judgement.of(one.first)
    return f" ({mark(judged.word, judged.id)})"


# --- a mismatch ---------------------------------------------------------------------------------------


def _mismatch(number: int, one: DeviationCause, of: CrosscheckReport) -> Iterator[str]:
    mismatch = of.mismatch(one.first)
    board, deviation = mismatch.board, mismatch.deviation
    assert deviation is not None, "what a search found"
    yield wrapped(f"✗ {number}. {board.name}, {headline(deviation)}.{_mark(one, of)}")
    yield wrapped(f"{often(_met(deviation, of.result), of.result)}", "   ")
    time = f"{mismatch.tick * board.tick_ms / 1000:g} s"
    run = "a small run" if mismatch.small else "that run"
    others = "what the other causes explain differs" if deviation.scope.on_top else "other parts differ"
    before = f"; {others} before, in {counted(mismatch.earlier, 'step', 'steps')}"
    yield wrapped(f"in step {mismatch.tick} = {time} of {run}{before if mismatch.earlier else ''}:", "   ")
    yield from _inputs(mismatch)
    signals = {o.name: o.signal for o in board.outputs}
    yield f"   {'output':<26}{'charts':<24}implementation"
    for d in mismatch.differences:
        actual = "missing" if d.actual is None else signals[d.name].show(d.actual)
        yield f"   {d.name:<26}{signals[d.name].show(d.expected):<24}{actual}"
    yield from _moves(mismatch, deviation)
    yield from cause_lines(one, of.result, "   ")


def _met(deviation: Deviation, result: CompareResult) -> Deviation:
    """The same one as it was met in the runs, not in the small one."""
    return result.met.get(deviation.scope, deviation)


def _failure(number: int, failure: Failure) -> Iterator[str]:
    time = f"{failure.tick * failure.board.tick_ms / 1000:g} s"
    yield wrapped(
        f"✗ {number}. {failure.board.name}, step {failure.tick} = {time}: it does not answer as it must."
    )
    yield wrapped(failure.message, "   ")
    yield from _inputs(failure)


def _inputs(mismatch: StepMismatch | Failure) -> Iterator[str]:
    """The inputs that are not at rest in the step, and since when; then how the run got there."""
    board = mismatch.board
    run = columns(board, [step.inputs for step in mismatch.steps])
    resting = environment(board).calm
    signals = {s.name: s for s in board.inputs}
    yield "   inputs that are not at rest in that step:"
    told = False
    for name, column in run.columns.items():
        last = column[-1]
        if last != resting[name]:
            since = next((k for k in range(len(column), 0, -1) if column[k - 1] != last), 0) + 1
            value = _stamped(last) if signals[name].stamp else signals[name].show(_known(last))
            told = True
            yield wrapped(f"{name} = {value}, since step {since}", "     ")
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
    resting, step = environment(board).calm, 1
    for steps, changes, _ in in_rows(resting, {}, ((moment, {}) for moment in script_of(mismatch))):
        changed = [f"{name} = {_shown(signals[name], value)}" for name, value in changes.items()]
        yield wrapped(f"step {step}: {', '.join(changed) or 'everything at rest'}", "     ")
        step += steps


def _shown(signal: BoardSignal, value: Value | None) -> str:
    if signal.stamp:
        return "silent" if value is None else f"updated {value} ms before each step"
    return signal.show(_known(value))


def _moves(mismatch: StepMismatch, deviation: Deviation) -> Iterator[str]:
    """What the charts that decide the outputs do in that step, and before it where nothing else differs."""
    moves = deviation.first.moves
    if moves:
        yield "   the charts:"
        yield from (wrapped(move, "     ") for move in moves)
    else:
        yield wrapped(f"{deviation.first.decided_by} is decided by no state of a chart.", "   ")
    if mismatch.earlier:
        return
    charts = {f.chart for step in mismatch.steps for f in step.fired if _moved(f.chart, moves)}
    for back in range(min(BEFORE, mismatch.tick - 1), 0, -1):
        for one in mismatch.steps[-1 - back].fired:
            if one.chart in charts:
                yield wrapped(f"{counted(back, 'step', 'steps')} before: {taken(one)}", "     ")


def _moved(chart: str, moves: Sequence[str]) -> bool:
    """Whether one of the moves is of a chart: they begin with a place in it."""
    return any(move.startswith((f"{chart}:", f"{chart}.")) for move in moves)


def _test(files: Sequence[Path], number: int) -> Iterator[str]:
    if number <= len(files):
        yield "   " + whole(f"pytest {quote(str(files[number - 1]))}")


# --- all of it ------------------------------------------------------------------------------------------


def _summary(report: CrosscheckReport) -> Iterator[str]:
    result = report.result
    cover, (took, of) = result.coverage, result.transitions
    met, sides = cover.boundaries()
    ended = result.compared < cover.steps
    part = f", {result.compared:,} of them compared, as it did not survive some" if ended else ""
    yield wrapped(
        f"{_sign(report)} {result.board.name} {_verdict(report)}: {cover.steps:,} steps in "
        f"{counted(cover.runs, 'run', 'runs')}{part}; the charts took {took} of {of} transitions, "
        f"and inputs met {met} of {sides} sides of boundaries."
    )
    for line in known_lines(report.judgement):
        yield wrapped(line, "  ")
    for (name, because), runs in result.undecided.items():
        in_runs = counted(runs, "run", "runs")
        yield wrapped(f"? {name}: after a deviation, not all could be decided in {in_runs}: {because}.", "  ")
    for stage in result.stages:
        if stage.because:
            yield wrapped(untried(stage), "  ")
    if _given_up(result):
        yield wrapped(f"Try more with --failures N (now {result.allowance.failures}).", "  ")
    if result.small < len(report.findings):
        yield wrapped(
            f"Findings with a small run and a test: {result.small} of {len(report.findings)}; "
            f"all of them with --mismatches {len(report.findings)}.", "  "
        )  # fmt: skip
    for line in searched(report.groups):
        yield wrapped(line, "  ")
    if result.uncompared:
        yield wrapped(f"Not compared, because it never gave them: {', '.join(result.uncompared)}.", "  ")
    if result.missing and not _given_up(result):
        yield f"  Transitions that no run took ({len(result.missing)}; some cannot be):"
        yield from (wrapped(str(transition), "    ") for transition in result.missing)


def untried(stage: CompareStage) -> str:
    """``Random runs: 21 of 240 tried; given up after 3 runs not survived.``"""
    tried = f"{stage.tried} tried, not all" if stage.of is None else f"{stage.tried} of {stage.of} tried"
    return f"{stage.kind.capitalize()}: {tried}; {stage.because}."


def _sign(of: CrosscheckReport) -> str:
    return "✗" if of.differs else "✓" if of.as_expected else "?"


def _verdict(of: CrosscheckReport) -> str:
    result = of.result
    if of.differs:
        return f"does not conform ({', '.join(_differences(of))})"
    if result.mismatches:
        known = counted(len(result.mismatches), "known deviation", "known deviations")
        undecided = "" if of.as_expected else ", but not all could be decided"
        return f"has {known} and no other{undecided}"
    if result.conforms:
        return "conforms"
    why = (
        "interrupted" if result.interrupted else "runs are missing" if result.lost else "no output to compare"
    )
    return f"is inconclusive ({why})"


def _differences(of: CrosscheckReport) -> Iterator[str]:
    result = of.result
    if result.mismatches:
        findings = of.findings
        words = [of.judgement.of(one.first).word for one in findings] if of.judgement.found else []
        known = words.count("known")
        told = f", {known} of them known" if known else ""
        parts = len({one.part for one in findings})
        of_parts = f" of {counted(parts, 'part', 'parts')}" if parts < len(findings) else ""
        ways = len(result.mismatches)
        show = "show" if len(findings) > 1 else "shows"
        shown_in = f", which {show} in {ways} ways" if ways > len(findings) else ""
        yield counted(len(findings), "finding", "findings") + of_parts + told + shown_in
    if result.failures:
        gave_up = ", then the search gave up" if _given_up(result) else ""
        yield f"{counted(len(result.failures), 'run', 'runs')} not survived{gave_up}"


def _given_up(result: CompareResult) -> bool:
    return len(result.failures) >= result.allowance.failures
