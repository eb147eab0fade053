"""What a user's choice of engine makes of a question: its answers, each as soon as it counts."""

from collections.abc import Iterator

from checker.engines import ALL, AUTO, Engine, Limits, engines
from checker.results.verdict import Answer, Open, Reached, Unreachable
from checker.verify.portfolio.compare import compared
from checker.verify.portfolio.question import Callbacks, Found, PortfolioQuestion, conclusive, stays
from checker.verify.portfolio.turns import asked, in_turn


def answers(question: PortfolioQuestion, engine: str | Engine, limits: Limits, told: Callbacks) -> Found:
    """An answer for each goal and each check of the system.  Raises ``Disagreement``."""
    found: dict[str, tuple[Answer, str]] = {}
    for more in as_found(question, engine, limits, told):
        found |= more
    return found


def as_found(
    question: PortfolioQuestion, engine: str | Engine, limits: Limits, told: Callbacks
) -> Iterator[Found]:
    """The same answers, each once: runs as they are found, the rest when no more can change.

    That a goal is never reached counts only if the model never leaves a domain; that it does is told at once.
    """
    given: set[str] = set()
    found: Found = {}
    for found in _rounds(question, engine, limits, told):
        new = {n: a for n, a in found.items() if n not in given and _final(question, found, n)}
        given |= new.keys()
        yield from _told(question, new, told)
    rest = {n: _meant(question, found, n) for n in found if n not in given}
    yield from _told(question, rest, told)


def _told(question: PortfolioQuestion, new: Found, told: Callbacks) -> Iterator[Found]:
    if new:
        told.answered(question, new)
        yield new


def _rounds(
    question: PortfolioQuestion, engine: str | Engine, limits: Limits, told: Callbacks
) -> Iterator[Found]:
    if engine == AUTO:
        yield from in_turn(question, limits, told)
    elif engine == ALL:
        yield compared(question, limits, told)
    else:
        one = engines()[engine] if isinstance(engine, str) else engine
        told.granted(limits.seconds)
        alone = asked(one, question, limits, told, question.goals)
        told.granted(limits.seconds)
        yield alone


def _final(question: PortfolioQuestion, found: Found, goal: str) -> bool:
    """Whether an answer counts whatever other engines say."""
    answer, _ = found[goal]
    if isinstance(answer, Reached) and goal in {check.name for check in question.checks}:
        return True
    return conclusive(answer) and (isinstance(answer, Reached) or stays(question, found))


def _meant(question: PortfolioQuestion, found: Found, goal: str) -> tuple[Answer, str]:
    """The answer, open if it rests on the model staying in its domains and that is not known."""
    answer, by = found[goal]
    if isinstance(answer, Unreachable):
        for check in question.checks:
            staying = found[check.name][0]
            if isinstance(staying, Open) and goal != check.name:
                reason = f"not reached as long as values stay in their domains; {check.doc}? {staying.reason}"
                return Open(reason, staying.depth), by
    return answer, by
