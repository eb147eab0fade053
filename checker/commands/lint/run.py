"""``rovercheck lint``: what can never happen in charts, and where only the order of transitions decides."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Literal

from rovercheck.checker.commands.lint.document import NUMBERS, LintRow, LintSummary, document
from rovercheck.checker.commands.lint.guards import guard_questions, without_way_out
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
    """Look at the systems of a model.  Raises ``UsageError`` for an unknown one, and for none."""
    model = rover() if path is None else load(path)
    if path is None and not names:
        raise UsageError("The rover has many systems: name some with --system, as in --system relay.")
    chosen = {name: pick("system", name, model.systems) for name in names} or dict(model.systems)
    numbers = [row for system in chosen.values() for row in number_rows(system, seconds)]
    broken = {row["system"] for row in numbers if row["found"] == "happens"}
    asked = {name: list(_asked(system)) for name, system in chosen.items()}
    sound = [name for name in chosen if name not in broken]
    looked = {
        name: watched(model.systems[name], (GoalKind.TRANSITIONS,)).system
        for name in _with_concrete(sound, model.systems)
    }
    questions = {prop.id: row for name in sound for prop, row in asked[name]}
    properties = [prop for name in sound for prop, _ in asked[name]]
    if any(row["found"] == "unknown" for row in numbers):
        seconds = seconds or SECONDS  # a proof rests on it
    search = SearchSettings(limits=Limits(seconds=seconds), traces=False)
    for result in results(properties, looked, search, quiet=as_json):
        _answer(questions[result.property.id], result)
    guards = guard_questions(sound, model.systems, looked)
    told = dict((prop.id, row) for prop, row in guards.asked)
    for result in results([prop for prop, _ in guards.asked], guards.systems, search, quiet=as_json):
        _answer(told[result.property.id], result)
    again = {prop.id: told[of] for of, prop in guards.again.items() if told[of]["found"] == "never"}
    asked_again = [prop for prop in guards.again.values() if prop.id in again]
    for result in results(asked_again, guards.systems, search, quiet=as_json) if asked_again else ():
        row = again[result.property.id]
        if isinstance(result.verdict, Violated):  # it is never tested, which its transition tells
            row["found"] = "happens"
        elif not isinstance(result.verdict, Proved):
            row["found"], row["evidence"] = "unknown", evidence(result)
    rows = [*numbers, *(row for row in questions.values() if row["found"] != "happens")]
    rows += [row for row in told.values() if row["found"] in _WORTH[row["kind"]]]
    never = {(row["system"], row["chart"], row["what"]) for row in rows if row["kind"] == "state"}
    ends = (row for name in sound for row in without_way_out(chosen[name]))
    rows += [row for row in ends if (row["system"], row["chart"], row["what"]) not in never]
    summaries = [_summary(name, [row for _, row in asked[name]], name in sound) for name in chosen]
    code = _code(rows)
    if as_json:
        print(json_text(document(rows, summaries, code), ascii=True))
        return code
    for line in told_lines(rows, summaries):
        out.print(line, markup=False)
    return code


_WORTH = {
    "condition": ("never", "unknown"), "order": ("happens", "unknown"),
    "overflow": ("happens", "never", "unknown"),
}  # fmt: skip
"""What is told: conditions that always hold, orders that decide, and all that may be too large."""
MEANT = ("order", "way out", "overflow")
"""What may be meant."""


def _code(rows: Sequence[LintRow]) -> Exit:
    """What never happens fails, and so does a run without a meaning, unless it may be meant."""
    failed = any(
        row["found"] == ("happens" if row["kind"] in NUMBERS else "never")
        for row in rows
        if row["kind"] not in MEANT
    )
    if failed:
        return Exit.FAILED
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


def _asked(system: System) -> Iterator[tuple[Property, LintRow]]:
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


def _summary(name: str, rows: Sequence[LintRow], asked: bool) -> LintSummary:
    states = [row for row in rows if row["kind"] == "state"]
    return LintSummary(system=name, states=len(states), transitions=len(rows) - len(states), asked=asked)


__all__ = ["lint"]
