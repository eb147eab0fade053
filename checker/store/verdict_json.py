"""Verdicts as JSON: what they rest on, without the states of a search, and a run as its inputs."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypedDict

from rovercheck.checker.model.kept_runs import KeptRun, kept, row
from rovercheck.checker.results.trace import NecessaryInputs, Needed, Trace
from rovercheck.checker.results.verdict import (
    Evidence,
    Exhausted,
    Inductive,
    Proved,
    Run,
    Stored,
    StoredInvariant,
    StoredRun,
    Violated,
)

MOST_TICKS = 1_000_000
"""Ticks of a run that is kept."""
LARGEST = 1 << 63
"""Of what is counted."""

Definite = Proved | Violated
"""A verdict that is kept: what is unknown is looked for again."""


class VerdictEntry(TypedDict):
    """A verdict, the system that it is about and what it rests on."""

    system: str
    word: Literal["proved", "violated"]
    engine: str
    claim: str
    because: Mapping[str, Any]
    together: list[str]
    """The properties that were searched together; certificates are kept for all of them."""


def entry(verdict: Definite, system: str, together: Sequence[str] = ()) -> VerdictEntry:
    """The verdict as JSON."""
    because = verdict.because
    return {
        "system": system,
        "word": "proved" if isinstance(verdict, Proved) else "violated",
        "engine": verdict.engine,
        "claim": verdict.claim if isinstance(verdict, Proved) else "",
        "because": _because(because, system),
        "together": list(together),
    }


def _because(because: Evidence | Trace | Stored, system: str) -> Mapping[str, Any]:
    match because:
        case Exhausted():
            counted = [because.states, because.transitions, because.depth]
            return {"exhausted": counted, "variables": [*because.variables], "skipped": because.skipped}
        case Inductive():
            return {"inductive": len(because.conjuncts), "ticks": because.ticks}
        case StoredInvariant():
            return {"inductive": because.conjuncts, "ticks": because.ticks}
        case Trace():
            frozen = {name: because.before[name] for name in because.system.frozen}
            run = Run(frozen, tuple(tick.inputs for tick in because.ticks))
            total = because.ms(len(because))
            kept_run = StoredRun(run, total, because.loop, because.trapped, because.shortest)
            return _because(kept_run, system)
        case StoredRun():
            return {
                "run": row(KeptRun(system, because.run)),
                "ms": because.total_ms,
                "loop": because.loop,
                "trapped": because.trapped,
                "shortest": because.shortest,
            }


def verdict(found: VerdictEntry) -> Definite:
    """The verdict that was written.  Raises ``ValueError`` or the like for anything else."""
    because, engine = _evidence(found["because"]), str(found["engine"])
    if found["word"] == "proved":
        return Proved(because, engine, str(found["claim"]))
    if found["word"] == "violated":
        return Violated(because, engine)
    raise ValueError(f"{found['word']!r} is no verdict that is kept")


def _evidence(found: Mapping[str, Any]) -> Exhausted | Stored:
    match found:
        case {
            "exhausted": [int(states), int(tried), int(depth)],
            "variables": list(names),
            "skipped": skipped,
        }:
            states, tried, depth = (_count(one, LARGEST) for one in (states, tried, depth))
            return Exhausted(states, tried, depth, tuple(map(str, names)), bool(skipped))
        case {"inductive": int(count), "ticks": int(ticks)}:
            return StoredInvariant(_count(count, LARGEST), _count(ticks, LARGEST))
        case {"run": dict(one), "ms": int(ms), "loop": loop, "trapped": trapped, "shortest": shortest}:
            run = kept(one, MOST_TICKS).run
            back, stuck = (None if end is None else _count(end, len(run)) for end in (loop, trapped))
            return StoredRun(run, _count(ms, LARGEST), back, stuck, bool(shortest))
    raise ValueError(f"{str(found)[:60]} is nothing that a verdict rests on")


def _count(value: object, most: int) -> int:
    if isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= most:
        return value
    raise ValueError(f"{str(value)[:60]} is no number from 0 to {most:,}")


def necessary_row(found: NecessaryInputs) -> dict[str, Any]:
    """The inputs that force the end of a run as JSON."""
    needed = [[one.number, one.name, sorted(one.values)] for one in found.needed]
    return {"needed": needed, "minimal": found.minimal, "smallest": found.smallest}


def necessary_inputs(found: Mapping[str, Any]) -> NecessaryInputs:
    """What was written.  Raises ``ValueError`` or the like for anything else."""
    needed = [
        Needed(int(number), str(name), frozenset(map(int, values)))
        for number, name, values in found["needed"]
    ]
    return NecessaryInputs(tuple(needed), bool(found["minimal"]), bool(found["smallest"]))
