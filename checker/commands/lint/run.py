"""``rovercheck lint``: every state and transition of charts asked whether some run gets there."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Literal

from rovercheck.checker.commands.lint.document import LintRow, LintSummary, document
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, out, text_width
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.engines import Limits
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.model.load import load
from rovercheck.checker.model.rover import rover
from rovercheck.checker.render.verdict_text import evidence
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
    asked = {name: list(_asked(system)) for name, system in chosen.items()}
    looked = {
        name: watched(model.systems[name], (GoalKind.TRANSITIONS,)).system
        for name in _with_concrete(chosen, model.systems)
    }
    questions = {prop.id: row for rows in asked.values() for prop, row in rows}
    properties = [prop for rows in asked.values() for prop, _ in rows]
    search = SearchSettings(limits=Limits(seconds=seconds), traces=False)
    for result in results(properties, looked, search, quiet=as_json):
        _answer(questions[result.property.id], result)
    rows = [row for row in questions.values() if row["found"] != "happens"]
    summaries = [_summary(name, [row for _, row in asked[name]]) for name in chosen]
    undecided = any(row["found"] == "unknown" for row in rows)
    code = Exit.AS_EXPECTED if not rows else Exit.INCONCLUSIVE if undecided else Exit.FAILED
    if any(row["found"] == "never" for row in rows):
        code = Exit.FAILED
    if as_json:
        print(json_text(document(rows, summaries, code), ascii=True))
        return code
    for line in _told(rows, summaries):
        out.print(line, markup=False)
    return code


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
    row = LintRow(system=system.name, chart=chart, kind=kind, what=what, found="unknown", evidence="")
    return prop, row


def _answer(row: LintRow, result: Result) -> None:
    match result.verdict:
        case Proved():
            row["found"] = "happens"
        case Violated():
            row["found"] = "never"
    row["evidence"] = evidence(result)


def _summary(name: str, rows: Sequence[LintRow]) -> LintSummary:
    states = [row for row in rows if row["kind"] == "state"]
    return LintSummary(system=name, states=len(states), transitions=len(rows) - len(states))


def _told(rows: Sequence[LintRow], summaries: Sequence[LintSummary]) -> Iterator[str]:
    for row in rows:
        verb = "active" if row["kind"] == "state" else "taken"
        where = f"{row['system']}, {row['chart']}: {row['kind']} {row['what']}"
        if row["found"] == "never":
            yield _wrapped(f"✗ {where} is never {verb}.")
        else:
            yield _wrapped(f"? {where}: whether it is ever {verb} was not decided.")
        yield _wrapped(row["evidence"], "    ")
    for one in summaries:
        own = [row for row in rows if row["system"] == one["system"]]
        many = counted(one["transitions"], "transition", "transitions")
        said = f"{counted(one['states'], 'state', 'states')}, {many}"
        rest = "all of them can happen" if not own else f"{len(own)} of them as above"
        yield _wrapped(f"{'✓' if not own else '•'} {one['system']}: {said}, {rest}.")


def _wrapped(text: str, indent: str = "") -> str:
    return filled(" ".join(text.split()), text_width(), indent, f"{indent}  ")


__all__ = ["lint"]
