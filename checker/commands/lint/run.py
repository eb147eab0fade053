"""``rovercheck lint``: what can never happen in charts, and where only the order of transitions decides."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from rovercheck.checker.commands.lint.document import NUMBERS, LintRow, LintSummary, document
from rovercheck.checker.commands.lint.guards import GuardQuestions, guard_questions, without_way_out
from rovercheck.checker.commands.lint.numbers import SECONDS, number_rows
from rovercheck.checker.commands.lint.runs import run_of
from rovercheck.checker.commands.lint.text import told_lines
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import out
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.engines import Limits
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.model.load import load
from rovercheck.checker.model.rover import rover
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Proved, Violated
from rovercheck.checker.system.instrument.goals import GoalKind
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.forms import Property, reachable
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import System


def lint(names: Sequence[str], seconds: float | None, as_json: bool, path: Path | None) -> Exit:
    """Look at the systems of a model; after Ctrl-C what was found so far is told.

    Raises ``UsageError`` for an unknown one, and for none.
    """
    model = rover() if path is None else load(path)
    if path is None and not names:
        raise UsageError("The rover has many systems: name some with --system, as in --system relay.")
    chosen = {name: pick("system", name, model.systems) for name in names} or dict(model.systems)
    found = LintQuestions(chosen, model.systems)
    try:
        found.ask(seconds, quiet=as_json)
    except KeyboardInterrupt:
        found.interrupted = True
    rows, summaries = found.rows(), found.summaries()
    code = _code(rows, found.interrupted)
    if as_json:
        print(json_text(document(rows, summaries, code, found.interrupted), ascii=True))
        return code
    for line in told_lines(rows, summaries, found.interrupted):
        out.print(line, markup=False)
    return code


@dataclass
class LintQuestions:
    """The questions about the systems ``chosen`` of a model, and how far they are answered."""

    chosen: Mapping[str, System]
    systems: Mapping[str, System]
    interrupted: bool = False
    _numbers: list[LintRow] = field(default_factory=list)
    _asked: dict[str, list[LintRow]] = field(default_factory=dict)
    """The rows of states and transitions, by system; what is not answered has no evidence."""
    _guards: list[LintRow] = field(default_factory=list)

    def ask(self, seconds: float | None, quiet: bool) -> None:
        """Answer the questions, within so many seconds for each search."""
        for system in self.chosen.values():
            self._numbers += number_rows(system, seconds)
        broken = {row["system"] for row in self._numbers if row["found"] == "happens"}
        sound = [name for name in self.chosen if name not in broken]
        looked = {
            name: watched(self.systems[name], (GoalKind.TRANSITIONS,)).system
            for name in _with_concrete(sound, self.systems)
        }
        if any(row["found"] == "unknown" for row in self._numbers):
            seconds = seconds or SECONDS  # a proof rests on it
        search = SearchSettings(limits=Limits(seconds=seconds), traces=False)
        asked = {name: list(_questions(self.chosen[name])) for name in sound}
        self._asked = {name: [row for _, row in own] for name, own in asked.items()}
        every = {prop.id: (prop, row) for own in asked.values() for prop, row in own}
        guards = guard_questions(sound, self.systems, looked)
        self._guards = [row for _, row in guards.asked]
        for result in results([prop for prop, _ in every.values()], looked, search, quiet):
            _answer(every[result.property.id][1], result)
        self._ask_of(guards, search, quiet)

    @staticmethod
    def _ask_of(guards: GuardQuestions, search: SearchSettings, quiet: bool) -> None:
        """A condition that never fails where it is tested is told only where it is tested in some run."""
        asked = {prop.id: row for prop, row in guards.asked}
        never: dict[str, tuple[LintRow, str]] = {}
        for result in results([prop for prop, _ in guards.asked], guards.systems, search, quiet):
            row, tested = asked[result.property.id], guards.again.get(result.property.id)
            _answer(row, result)
            if row["found"] == "never" and tested is not None:
                never[tested.id] = row, row["evidence"]
                row["found"], row["evidence"] = "unknown", ""
        again = [prop for prop in guards.again.values() if prop.id in never]
        for result in results(again, guards.systems, search, quiet) if again else ():
            row, because = never[result.property.id]
            match result.verdict:
                case Proved():
                    row["found"], row["evidence"] = "never", because
                case Violated():  # it is never tested, which its transition tells
                    row["found"] = "happens"
                case _:
                    row["evidence"] = evidence(result)

    def rows(self) -> list[LintRow]:
        """What is worth telling of what is answered."""
        asked = [row for own in self._asked.values() for row in own if row["found"] != "happens"]
        asked += [row for row in self._guards if row["found"] in _WORTH[row["kind"]]]
        rows = [*self._numbers, *(row for row in asked if row["evidence"] or not self.interrupted)]
        never = {(row["system"], row["chart"], row["what"]) for row in rows if row["kind"] == "state"}
        ends = (row for name in self._asked for row in without_way_out(self.chosen[name]))
        return rows + [row for row in ends if (row["system"], row["chart"], row["what"]) not in never]

    def summaries(self) -> list[LintSummary]:
        """How much of each system was asked about."""
        return [self._summary(*one) for one in self.chosen.items()]

    def _summary(self, name: str, system: System) -> LintSummary:
        rows = [row for _, row in _questions(system)]
        states = sum(row["kind"] == "state" for row in rows)
        every = [*self._asked.get(name, ()), *(row for row in self._guards if row["system"] == name)]
        return LintSummary(
            system=name, states=states, transitions=len(rows) - states, asked=name in self._asked,
            questions=len(every), answered=sum(bool(row["evidence"]) for row in every),
        )  # fmt: skip


_WORTH = {
    "condition": ("never", "unknown"), "order": ("happens", "unknown"),
    "overflow": ("happens", "never", "unknown"),
}  # fmt: skip
"""What is told: conditions that always hold, orders that decide, and all that may be too large."""
MEANT = ("order", "way out", "overflow")
"""What may be meant."""


def _code(rows: Sequence[LintRow], interrupted: bool) -> Exit:
    """What never happens fails, and so does a run without a meaning, unless it may be meant."""
    failed = any(
        row["found"] == ("happens" if row["kind"] in NUMBERS else "never")
        for row in rows
        if row["kind"] not in MEANT
    )
    if failed:
        return Exit.FAILED
    if interrupted:
        return Exit.INTERRUPTED
    undecided = any(row["found"] == "unknown" for row in rows)
    return Exit.INCONCLUSIVE if undecided else Exit.AS_EXPECTED


def _with_concrete(chosen: Iterable[str], systems: Mapping[str, System]) -> list[str]:
    """The systems chosen, and those on which their runs are reproduced."""
    found = list(chosen)
    for name in found:
        concrete = systems[name].concrete
        if concrete and concrete not in found:
            found.append(concrete)
    return found


def _questions(system: System) -> Iterator[tuple[Property, LintRow]]:
    """A question for each state and each transition of the charts of a system."""
    for chart in system.charts:
        for path in filter(None, chart.states):
            what = ".".join(path)
            yield _question(system, chart.name, "state", what, chart.active_path(path), f"state {what}")
    for goal in watched(system, (GoalKind.TRANSITIONS,)).goals:
        yield _question(system, goal.part, "transition", goal.text, goal.flag, goal.id)


def _question(
    system: System, chart: str, kind: Literal["state", "transition"], what: str, that: Expr, number: str
) -> tuple[Property, LintRow]:
    id_ = f"{system.name}, {chart}: {number}"
    prop = reachable(id_, f"{what} happens.", that=that, covers=["lint"], on=system.name)
    row = LintRow(system=system.name, chart=chart, kind=kind, what=what, found="unknown", evidence="", run=())
    return prop, row


def _answer(row: LintRow, result: Result) -> None:
    match result.verdict:
        case Proved():
            row["found"] = "happens"
        case Violated():
            row["found"] = "never"
    row["evidence"] = evidence(result)
    if row["kind"] in ("order", "overflow") and isinstance(result.verdict, Proved | Violated):
        because = result.verdict.because
        row["run"] = run_of(because) if isinstance(because, Trace) else ()


__all__ = ["LintQuestions", "lint"]
