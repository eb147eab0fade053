"""``rovercheck trace``: the counterexample (or witness) of one property, in one of several forms."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import err, out, possible, table_width, write, wrote
from rovercheck.checker.commands.shared.progress import Watch
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.commands.trace.examples import TraceRequest
from rovercheck.checker.commands.trace.explain import ExplanationOptions
from rovercheck.checker.commands.trace.formats import exit_written, fitted
from rovercheck.checker.engines import Limits
from rovercheck.checker.render import Renderer, named, renderers
from rovercheck.checker.render.reasons import in_reason
from rovercheck.checker.render.trace_markdown import SPECIAL
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.forms import Property, Unbounded
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.checker.explain.other_runs import NoOtherRun
    from rovercheck.checker.store.verdicts import VerdictStore

FOR_READERS = ("table", "markdown")
SECONDS = 30.0
"""For each further run, unless a time limit is given."""


@dataclass(frozen=True)
class TraceDisplay:
    """How a run is shown, and how many runs.

    What people read shows only what the property depends on, unless ``everything`` is wanted.
    """

    format: str = "table"
    everything: bool = False
    output: Path | None = None
    explaining: ExplanationOptions = field(default_factory=ExplanationOptions)
    runs: int = 1
    by: str = "transitions"
    """In what several runs differ: the ``transitions`` that they take, or the ``reason`` of their end."""

    def check(self, prop: Property) -> None:
        """Raises ``UsageError`` for a format that there is not, that cannot show several runs, or for a place
        that cannot be written.
        """
        possible(self.output)
        if named("trace", self.format) is None:
            pick("trace format", self.format, renderers("trace"))
        if self.runs > 1 and self.format not in FOR_READERS:
            raise UsageError(
                f"--witnesses shows several runs, and a file of the format {self.format} holds one; "
                f"write --format {' or '.join(FOR_READERS)}, or leave --witnesses out."
            )
        if self.runs == 1 and self.by != "transitions":
            raise UsageError("--by says in what several runs are to differ; add --witnesses N.")
        if self.by == "reason" and not self.explaining.wanted:
            raise UsageError(
                "--by reason compares the causes of runs, which --no-explain does not look for; "
                "leave one of them out."
            )
        if self.runs > 1 and isinstance(prop.form, Unbounded):
            raise UsageError(
                f"{prop.id} is about runs without end, of which one is shown; leave --witnesses out."
            )

    @property
    def renderer(self) -> Renderer:
        """The renderer of the format, which there is."""
        found = named("trace", self.format)
        assert found is not None, "the format was checked"
        return found

    def cut(self, trace: Trace) -> Trace:
        """What is shown of a trace."""
        return trace if self.everything or self.format not in FOR_READERS else trace.focused()


def trace(
    wanted: TraceRequest,
    engine: str,
    limits: Limits,
    showing: TraceDisplay,
    store: "VerdictStore | None" = None,
) -> Exit:
    """Decide a property and show its trace; say so when its verdict rests on none."""
    prop, systems = wanted.property, wanted.systems
    showing.check(prop)
    [result] = results([prop], systems, SearchSettings(engine, limits, store=store))
    verdict = result.verdict
    if isinstance(verdict, Unknown):
        err.print(f"{prop.id} is unknown: {evidence(result)}", markup=False)
        return Exit.INCONCLUSIVE
    if not isinstance(verdict.because, Trace):
        missing = "in no run" if wanted.example else f"{verdict.word} and has no trace"
        err.print(f"{prop.id} is {missing}: {evidence(result)}", markup=False)
        if result.in_part:
            err.print(_only_some(result.system), markup=False)
        return Exit.AS_EXPECTED
    because = _reason(wanted, verdict.word)
    if showing.output is None and showing.format == "table":
        _print_heading(wanted, verdict.word)
    if result.limited_to:
        err.print(filled(f"Note: {result.limited_to}.", table_width()), markup=False)
    if not verdict.because.shortest and wanted.example:
        err.print("Not known to be a shortest run: a shorter one may do the same.", markup=False)
    if showing.runs > 1:
        _show_several(wanted, verdict.because, because, engine, limits, showing)
        return Exit.AS_EXPECTED
    first = wanted.drawn(showing.explaining(verdict.because, prop, systems)).with_reason(because)
    renderer = showing.renderer
    shown = showing.cut(first)
    others = exit_written(renderer, shown, systems, showing.output, showing.everything, wanted.boards)
    for place in (showing.output, *others):
        wrote(place)
    return Exit.AS_EXPECTED


def _only_some(system: str) -> str:
    return f"{system} has only some of the runs there are: this says nothing of the others."


def _print_heading(wanted: TraceRequest, verdict: str) -> None:
    prop = wanted.property
    said = prop.text if wanted.example else f"{prop.id} is {verdict}: {prop.text}"
    out.print(filled(said, table_width()), markup=False)


def _reason(wanted: TraceRequest, verdict: str) -> str:
    """Why the verdict is as it is, where that is written beside the one that is expected."""
    on_record = wanted.expected(wanted.property.id)
    return on_record.because if on_record.verdict == verdict else ""


def _show_several(
    wanted: TraceRequest, first: Trace, because: str, engine: str, limits: Limits, showing: TraceDisplay
) -> None:
    """Show runs as they are found, after what they have in common; into a file all of them together."""
    told: list[str] = []
    if because and showing.format == "markdown":
        told.append(f"**Why:** {because.translate(SPECIAL)}\n\n")
    elif because:
        told.append(filled(f"Why: {because}", table_width()) + "\n")
    if showing.output is None:
        for text in told:
            write(text, None)
    for text in _several(wanted, first, engine, limits, showing):
        if showing.output is None:
            write(text, None)
        told.append(text)
    if showing.output is not None:
        write("".join(told), showing.output)
        wrote(showing.output)


def _several(
    wanted: TraceRequest, first: Trace, engine: str, limits: Limits, showing: TraceDisplay
) -> Iterator[str]:
    """The text of several runs, each with what makes it different."""
    from rovercheck.checker.explain.other_causes import OtherCauses
    from rovercheck.checker.explain.other_runs import NoOtherRun, OtherRuns

    prop, system = wanted.property, wanted.systems[first.system.name]
    limits = limits if limits.seconds is not None else replace(limits, seconds=SECONDS)
    runs = [showing.explaining(first, prop, wanted.systems)]
    yield _heading("Run 1", [], showing) + _rendered(wanted.drawn(runs[0]), showing)
    by_transitions = OtherRuns(first, prop, system, wanted.watched) if showing.by == "transitions" else None
    by_reason = OtherCauses(prop, system)
    for number in range(2, showing.runs + 1):
        if by_transitions is None and runs[-1].necessary is None:
            unknown = (
                f"The cause of run {number - 1} is not known, so that no other cause can be told from it."
            )
            yield _heading(f"No run {number}", [unknown], showing)
            return
        with Watch(err, 1) as watch:
            say = partial(watch.say, f"{prop.id}: run {number}")
            other = (
                by_transitions.next(engine, limits, say)
                if by_transitions is not None
                else by_reason.next(runs, engine, limits, say)
            )
        if isinstance(other, NoOtherRun):
            yield _heading(f"No run {number}", _no_more(other, system, showing.by), showing)
            return
        trace, differences = (other, ()) if isinstance(other, Trace) else (other.trace, other.differences)
        runs.append(showing.explaining(trace, prop, wanted.systems))
        differences = differences or tuple(in_reason(runs[-1], earlier) for earlier in runs[:-1])
        unlike = [f"Unlike run {i} it {d}." for i, d in enumerate(differences, 1)]
        yield _heading(f"Run {number}", unlike, showing) + _rendered(wanted.drawn(runs[-1]), showing)


NO_MORE = {
    "transitions": (
        "No other was found that takes other transitions",
        "Every other run to this end takes the same transitions as one of these",
    ),
    "reason": (
        "No other was found that ends so for another reason",
        "Whenever another run first comes to this end, its last ticks are as one of these needs them",
    ),
}
"""What is said when there is no further run: not proved, and proved."""


def _no_more(found: "NoOtherRun", system: System, by: str) -> list[str]:
    unproved, proved = NO_MORE[by]
    if not found.proved:
        return [f"{unproved}; that there is none is not proved: {found.reason}."]
    every = f"{proved}: {found.reason}."
    return [every, _only_some(system.name)] if system.under else [every]


def _rendered(trace: Trace, showing: TraceDisplay) -> str:
    shown = fitted(showing.renderer, showing.output)(showing.cut(trace))
    assert isinstance(shown, str), "formats for readers are text"
    return shown


def _heading(title: str, lines: Sequence[str], showing: TraceDisplay) -> str:
    if showing.format == "markdown":
        return "\n\n".join([f"### {title}", *(line.translate(SPECIAL) for line in lines)]) + "\n\n"
    return "\n".join(["", f"--- {title} ---", *(filled(line, table_width()) for line in lines)]) + "\n"
