"""Engines in turn: each is asked what the ones before it left open, until every goal is decided."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from time import monotonic

from checker.engine import Engine, Limits, engines
from checker.portfolio.disagreement import contradict, said
from checker.portfolio.order import ORDERS
from checker.portfolio.question import Found, Question, Told
from checker.portfolio.shape import shape
from checker.verdict import Answer, Open, Reached
from spec_model.lang.expr import Var

OUT_OF_MEMORY = "the memory limit is reached"

SHORTENED = 128
"""Ticks of the longest run for which a shorter one is looked for: unrolling further takes minutes."""


def in_turn(question: Question, limits: Limits, told: Told) -> Iterator[Found]:
    """After each turn all that is found so far; the last one holds an answer for every goal.

    Raises ``Disagreement`` when a turn contradicts what an earlier one left to be confirmed.
    """
    known = engines()
    turns = ORDERS[shape(question).kind]
    present = [t for t in turns if t.engine in known]
    deadline = limits.deadline()
    found: dict[str, tuple[Answer, str]] = {}
    for turn in present:
        if found and _over(question, found, limits, deadline):
            break
        goals = [g for g in question.open(found) if _worth(found.get(g.name))]
        if not goals:
            break
        left = None if deadline is None else max(0.0, deadline - monotonic())
        told.granted(left)
        answers = asked(known[turn.engine], question, turn.within(limits, left), told, goals)
        found |= {g.name: _both(question, g, found.get(g.name), answers[g.name]) for g in goals}
        told.granted(limits.seconds)  # for what is made of the answers
        yield dict(found)


def _both(
    question: Question, goal: Var, before: tuple[Answer, str] | None, now: tuple[Answer, str]
) -> tuple[Answer, str]:
    """What two turns say of a goal together.  Raises ``Disagreement``."""
    if before is None:
        return now
    if contradict(before[0], now[0]):
        raise said(question.system, goal, (before, now))
    return better(before, now)


def _worth(known: tuple[Answer, str] | None) -> bool:
    """Whether a goal is worth another engine: a run that is known need only be made shorter."""
    return known is None or not isinstance(known[0], Reached) or len(known[0].run) <= SHORTENED


def _over(question: Question, found: Found, limits: Limits, deadline: float | None) -> bool:
    """Whether no further engine is worth asking."""
    open_ = question.open(found)
    if not open_:
        return True
    looked = limits.depth is not None and all(_looked(found[g.name][0], limits.depth) for g in open_)
    # Whether other runs leave a domain does not matter to a run that is replayed.
    shown = all(_shortest(found[g.name][0]) for g in question.wanted)
    return looked or shown or (deadline is not None and monotonic() >= deadline)


def _shortest(answer: Answer) -> bool:
    return isinstance(answer, Reached) and answer.shortest


def _looked(answer: Answer, depth: int) -> bool:
    return isinstance(answer, Open) and answer.depth >= depth


def asked(
    engine: Engine, question: Question, limits: Limits, told: Told, goals: Sequence[Var]
) -> dict[str, tuple[Answer, str]]:
    """What one engine says of some goals."""
    try:
        answers: Mapping[str, Answer] = engine.check(question.system, goals, limits, told.progress)
    except MemoryError:
        answers = {g.name: Open(OUT_OF_MEMORY, 0) for g in goals}
    return {name: (answer, engine.NAME) for name, answer in answers.items()}


def better(first: tuple[Answer, str], second: tuple[Answer, str]) -> tuple[Answer, str]:
    """Of two answers to one goal what both say together: the shorter run, the deeper search."""
    match first[0], second[0]:
        case Open(), Open():
            return _deeper(first, second)
        case Reached() as run, Open(_, depth):
            return (replace(run, shortest=True), first[1]) if depth >= len(run.run) - 1 else first
        case Open(), Reached():
            return better(second, first)
        case Reached(one, shortest), Reached(other):
            return first if shortest or len(one) < len(other) else second
        case Open(), _:
            return second
        case _:
            return first


def _deeper(first: tuple[Answer, str], second: tuple[Answer, str]) -> tuple[Answer, str]:
    (a, by_a), (b, by_b) = first, second
    assert isinstance(a, Open) and isinstance(b, Open)
    reason = f"{by_a}: {a.reason}; {by_b}: {b.reason}"
    return Open(reason, max(a.depth, b.depth)), by_a if a.depth > b.depth else by_b
