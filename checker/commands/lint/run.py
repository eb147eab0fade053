"""``rovercheck lint``: what can never happen in charts, and where only the order of transitions decides."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Literal

from rovercheck.checker.commands.lint.document import LintRow, LintSummary, document
from rovercheck.checker.commands.lint.guards import guard_questions, without_way_out
from rovercheck.checker.commands.lint.runs import run_of
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
    guards = guard_questions(chosen.keys(), model.systems, looked)
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
    rows = [row for row in questions.values() if row["found"] != "happens"]
    rows += [row for row in told.values() if row["found"] in _WORTH[row["kind"]]]
    never = {(row["system"], row["chart"], row["what"]) for row in rows if row["kind"] == "state"}
    ends = (row for system in chosen.values() for row in without_way_out(system))
    rows += [row for row in ends if (row["system"], row["chart"], row["what"]) not in never]
    summaries = [_summary(name, [row for _, row in asked[name]]) for name in chosen]
    code = _code(rows)
    if as_json:
        print(json_text(document(rows, summaries, code), ascii=True))
        return code
    for line in _told(rows, summaries):
        out.print(line, markup=False)
    return code


MOST_TICKS = 4
"""Lines of a run that are shown, those of its end; --json has them all."""
_WORTH = {"condition": ("never", "unknown"), "order": ("happens", "unknown")}
"""What is told of guards: conditions that always hold, and orders that decide."""


def _code(rows: Iterable[LintRow]) -> Exit:
    """That the order decides, and a state that is not left, may be meant."""
    found = {row["found"] for row in rows if row["kind"] not in ("order", "way out")}
    undecided = any(row["found"] == "unknown" for row in rows)
    if "never" in found:
        return Exit.FAILED
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
    if row["kind"] == "order" and isinstance(result.verdict, Proved | Violated):
        because = result.verdict.because
        row["run"] = run_of(because) if isinstance(because, Trace) else ()


def _summary(name: str, rows: Sequence[LintRow]) -> LintSummary:
    states = [row for row in rows if row["kind"] == "state"]
    return LintSummary(system=name, states=len(states), transitions=len(rows) - len(states))


def _told(rows: Sequence[LintRow], summaries: Sequence[LintSummary]) -> Iterator[str]:
    for row in rows:
        mark, said = _sentence(row)
        kind = _CALLED.get(row["kind"], row["kind"])
        yield _wrapped(f"{mark} {row['system']}, {row['chart']}: {kind} {row['what']}{said}")
        yield _wrapped(row["evidence"], "    ")
        yield from (_wrapped(line, "      ") for line in row["run"][-MOST_TICKS:])
    for one in summaries:
        own = [row for row in rows if row["system"] == one["system"]]
        asked = [row for row in own if row["kind"] in ("state", "transition")]
        many = counted(one["transitions"], "transition", "transitions")
        said = f"{counted(one['states'], 'state', 'states')}, {many}"
        rest = "all of them can happen" if not asked else f"{len(asked)} of them as above"
        yield _wrapped(f"{'✓' if not own else '•'} {one['system']}: {said}, {rest}.")


_CALLED = {"way out": "state", "condition": "the condition of", "order": "transitions"}


def _sentence(row: LintRow) -> tuple[str, str]:
    """The mark of a row, and what is said of it."""
    verb = "active" if row["kind"] == "state" else "taken"
    match row["kind"], row["found"]:
        case "way out", _:
            return "•", " is never left once it is active."
        case "condition", "never":
            return "✗", " always holds where it is tested."
        case "order", "happens":
            return "•", " hold at the same time in some run: their order decides."
        case (("condition" | "order"), _):
            asked = "always holds" if row["kind"] == "condition" else "ever hold at the same time"
            return "?", f": whether it {asked} was not decided."
        case _, "never":
            return "✗", f" is never {verb}."
    return "?", f": whether it is ever {verb} was not decided."


def _wrapped(text: str, indent: str = "") -> str:
    return filled(" ".join(text.split()), text_width(), indent, f"{indent}  ")


__all__ = ["lint"]
