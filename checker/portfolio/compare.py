"""Every engine on the same question: answers that cannot both be true are a bug of ours, and shown as one."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

from checker.calm import transferred
from checker.engine import Limits, engines
from checker.portfolio.question import Found, Question, Told, in_words, light
from checker.portfolio.turns import asked, better
from checker.verdict import Answer, Open, Reached, Unreachable
from spec_model.lang.expr import Var
from spec_model.lang.system import TransitionSystem


@dataclass(frozen=True)
class Saying:
    """What one engine says of a goal; ``replayed``: whether its run, if it has one, reaches the goal."""

    engine: str
    answer: Answer
    replayed: bool | None

    @property
    def words(self) -> str:
        """The answer in words."""
        return in_words(self.answer)

    def __str__(self) -> str:
        run = (
            "" if self.replayed is None else ", which replays" if self.replayed else ", which does not replay"
        )
        return f"{self.engine}: {self.words}{run}"


class Disagreement(Exception):
    """Two engines gave answers that cannot both be true: a bug of ours."""

    def __init__(self, system: str, goal: str, said: tuple[Saying, ...]) -> None:
        super().__init__(system, goal, said)
        self.system = system
        self.goal = goal
        self.said = said

    def __str__(self) -> str:
        return f"engines disagree about {self.goal} of {self.system}. " + "; ".join(map(str, self.said)) + "."


def compared(question: Question, limits: Limits, told: Told) -> Found:
    """The best answer to each goal, when all engines have been asked.  Raises ``Disagreement``."""
    by_engine = {}
    for name, engine in engines().items():
        told.granted(limits.seconds)
        by_engine[name] = asked(engine, question, limits, told, question.goals)
    told.granted(limits.seconds)
    goals = {g.name: g for g in question.goals}
    merged: dict[str, tuple[Answer, str]] = {}
    for name, goal in goals.items():
        each = {by: found[name][0] for by, found in by_engine.items()}
        if any(contradict(a, b) for a, b in combinations(each.values(), 2)):
            raise Disagreement(question.system.name, name, _said(question.system, goal, each))
        for by, answer in each.items():
            merged[name] = better(merged[name], (answer, by)) if name in merged else (answer, by)
    return merged


def contradict(first: Answer, second: Answer) -> bool:
    """Whether two answers about one goal cannot both be true."""
    match first, second:
        case Reached(), Reached():
            longer = max(first, second, key=lambda a: len(a.run))
            return len(first.run) != len(second.run) and longer.shortest
        case (Reached(run), Open(_, depth)) | (Open(_, depth), Reached(run)):
            return depth >= len(run)
        case _:
            return {type(first), type(second)} == {Reached, Unreachable}


def _said(system: TransitionSystem, goal: Var, each: Mapping[str, Answer]) -> tuple[Saying, ...]:
    return tuple(
        Saying(engine, light(answer), _replays(system, goal, answer)) for engine, answer in each.items()
    )


def _replays(system: TransitionSystem, goal: Var, answer: Answer) -> bool | None:
    """Whether the run of an answer reaches the goal by the reference semantics."""
    return transferred(answer.run, system, goal) is not None if isinstance(answer, Reached) else None
