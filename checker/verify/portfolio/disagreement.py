"""Answers that cannot both be true are an internal error, and shown as one."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from operator import or_

from rovercheck.checker.results.verdict import Answer, Reached
from rovercheck.checker.verify.portfolio.question import Contradiction, EngineAnswer, in_words, light
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem


@dataclass(frozen=True)
class Statement:
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
    """Two engines gave answers that cannot both be true: an internal error."""

    def __init__(self, system: str, goal: str, disagreement_of: tuple[Statement, ...]) -> None:
        super().__init__(system, goal, disagreement_of)
        self.system = system
        self.goal = goal
        self.said = disagreement_of

    def __str__(self) -> str:
        return f"engines disagree about {self.goal} of {self.system}. " + "; ".join(map(str, self.said)) + "."


def together(system: TransitionSystem, goal: Var, each: Sequence[EngineAnswer]) -> EngineAnswer:
    """What engines say of a goal together.  Raises ``Disagreement`` with all that they say."""
    try:
        return reduce(or_, each)
    except Contradiction:
        said = (Statement(by, light(answer), _replays(system, goal, answer)) for answer, by in each)
        raise Disagreement(system.name, goal.name, tuple(said)) from None


def _replays(system: TransitionSystem, goal: Var, answer: Answer) -> bool | None:
    """Whether the run of an answer reaches the goal by the reference semantics."""
    from rovercheck.checker.verify.runs.minimise import transferred

    return transferred(answer.run, system, goal) is not None if isinstance(answer, Reached) else None
