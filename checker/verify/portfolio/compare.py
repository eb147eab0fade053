"""Every engine on the same question, and their answers compared."""

from functools import reduce
from itertools import combinations

from checker.engines import Limits, engines
from checker.results.verdict import Answer
from checker.verify.portfolio.disagreement import contradict, said
from checker.verify.portfolio.question import Callbacks, Found, PortfolioQuestion
from checker.verify.portfolio.turns import asked, better


def compared(question: PortfolioQuestion, limits: Limits, told: Callbacks) -> Found:
    """The best answer to each goal, when all engines have been asked.  Raises ``Disagreement``."""
    by_engine = {}
    for name, engine in engines().items():
        told.granted(limits.seconds)
        by_engine[name] = asked(engine, question, limits, told, question.goals)
    told.granted(limits.seconds)
    goals = {g.name: g for g in question.goals}
    merged: dict[str, tuple[Answer, str]] = {}
    for name, goal in goals.items():
        each = [found[name] for found in by_engine.values()]
        if any(contradict(a, b) for (a, _), (b, _) in combinations(each, 2)):
            raise said(question.system, goal, each)
        merged[name] = reduce(better, each)
    return merged
