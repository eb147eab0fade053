"""Verdicts in a line: what they rest on, and what is expected."""

from rovercheck.checker.render.story import repeating
from rovercheck.checker.results.trace import Trace, counted_ticks
from rovercheck.checker.results.verdict import (
    Exhausted,
    Inductive,
    Proved,
    StoredInvariant,
    StoredRun,
    Unknown,
    Violated,
)
from rovercheck.checker.verify.result import Result
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Reachable


def in_short(result: Result) -> str:
    """The evidence in half a line."""
    verdict, system = result.verdict, result.system
    match verdict:
        case Unknown(reason, depth):
            return f"after {counted_ticks(depth)} of {system}: {reason}"
        case Proved((Exhausted() | Inductive() | StoredInvariant()) as evidence_, _, claim):
            return _joined(f"{evidence_.how} of {system}", claim, result.limited_to)
        case Violated((Exhausted() | Inductive() | StoredInvariant()) as evidence_):
            return _joined(f"never: {evidence_.how} of {system}", result.limited_to)
        case Proved((Trace() | StoredRun()) as trace):
            return _joined(f"reached in {ticks(trace, f' of {system}')}", result.limited_to)
        case Violated((Trace() | StoredRun()) as trace):
            return _joined(ticks(trace, f" of {system}"), result.limited_to)
    raise AssertionError(verdict)


def evidence(result: Result) -> str:
    """What the verdict rests on, in a few words."""
    verdict = result.verdict
    match verdict:
        case Unknown(reason, depth, engine):
            none = "no run to it" if isinstance(result.property.form, Reachable) else "no counterexample"
            return f"{engine} on {result.system}, {none} within {counted_ticks(depth)}: {reason}"
        case Proved((Exhausted() | Inductive() | StoredInvariant()) as shown, engine, claim):
            whole = f"{engine}: {shown.how} of {result.system}"
            whole += f", depth {shown.depth}" if isinstance(shown, Exhausted) else ""
            return _joined(whole, claim, result.limited_to)
        case Violated((Exhausted() | Inductive() | StoredInvariant()) as shown, engine):
            return _joined(f"{engine}: in none of {shown.how} of {result.system}", result.limited_to)
        case Proved((Trace() | StoredRun()) as trace, engine):
            return _joined(f"{engine}: witness of {ticks(trace, f' on {result.system}')}", result.limited_to)
        case Violated((Trace() | StoredRun()) as trace, engine):
            return _joined(
                f"{engine}: counterexample of {ticks(trace, f' on {result.system}')}", result.limited_to
            )
    raise AssertionError(verdict)


def ticks(trace: Trace | StoredRun, where: str) -> str:
    """``155 ticks = 3.1 s of board1``, and how many of them repeat for ever."""
    seconds = trace.ms(len(trace)) / 1000
    return f"{counted_ticks(len(trace))} = {seconds:g} s{where}{repeating(trace)}"


def recorded(entry: Expected) -> str:
    depth = f" after {counted_ticks(entry.depth)}" if entry.depth is not None else ""
    return f"{entry.verdict}{depth}"


def _joined(*said: str) -> str:
    return ", ".join(filter(None, said))
