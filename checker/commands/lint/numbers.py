"""What ``rovercheck lint`` tells of numbers: values outside their domains, and steps without a meaning."""

from collections.abc import Iterator

from rovercheck.checker.commands.lint.document import LintRow, RowKind
from rovercheck.checker.commands.lint.runs import input_lines
from rovercheck.checker.engines import AUTO, Limits
from rovercheck.checker.results.trace import counted_ticks
from rovercheck.checker.results.verdict import Open, Reached, Run, Unreachable
from rovercheck.checker.system.instrument.first_faults import FaultGoal, with_first_faults
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.decide import SILENT, EngineCall
from rovercheck.checker.verify.runs.domains import stray
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.system import System

SECONDS = 20.0
"""For the search of a system, unless a limit is given: a run out of a domain may have millions of ticks."""


def number_rows(system: System, seconds: float | None) -> Iterator[LintRow]:
    """A row for each datum that may leave its domain, and for each step that may have no meaning.

    What its formulas leave no doubt of is none of them.  Where one happens, a proof about another is that it
    does not happen first: what comes after the one has no meaning.
    """
    asked, goals = with_first_faults(lowered(system))
    if not goals:
        return
    limits = Limits(seconds=seconds or SECONDS)
    found = EngineCall(AUTO, limits, SILENT, limits.deadline())(asked, [goal.flag for goal in goals])
    ends = any(isinstance(answer, Reached) for answer, _ in found.values())
    first = ", unless something of the other rows has happened before" if ends else ""
    for goal in goals:
        row = _row(system, goal)
        match found[goal.flag.name]:
            case Reached(run), by:
                row["found"], row["run"] = "happens", list(_told(system, run))
                row["evidence"] = f"{by}: a run of {counted_ticks(len(run))} of {system.name}"
            case Unreachable(because), by:
                row["found"], row["evidence"] = "never", f"{by}: {because.how} of {system.name}{first}"
            case Open(reason, depth), by:
                row["evidence"] = f"{by}: not within {counted_ticks(depth)} of {system.name}: {reason}"
        yield row


def _row(system: System, goal: FaultGoal) -> LintRow:
    writers = (part.name for part in parts(system.components) if goal.var.name in part.written)
    kind: RowKind = "step" if goal.fault else "range"
    return LintRow(
        system=system.name, chart=", ".join(dict.fromkeys(writers)), kind=kind, what=goal.text,
        found="unknown", evidence="", run=(),
    )  # fmt: skip


def _told(system: System, run: Run) -> Iterator[str]:
    """The inputs of a run, which is replayed before."""
    whole = lowered(system)
    at = stray(whole, run)
    assert at is not None and at.tick == len(run), "a run that shows a fault meets it when it is replayed"
    inputs = {var.name: var for var in whole.inputs}
    shown = [{name: raw for name, raw in tick.items() if name in inputs} for tick in run.inputs]
    return input_lines(shown, inputs)


__all__ = ["SECONDS", "number_rows"]
