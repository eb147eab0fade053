"""Answers that cannot both be true are an internal error, and shown as one."""

from collections.abc import Iterable
from dataclasses import dataclass

from checker.results.verdict import Answer, Open, Reached, Unreachable
from checker.verify.portfolio.question import in_words, light
from spec_model.lang.expr import Var
from spec_model.lang.system import TransitionSystem


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


def disagreement_of(system: TransitionSystem, goal: Var, each: Iterable[tuple[Answer, str]]) -> Disagreement:
    """What engines say of a goal, as the error that it is."""
    sayings = (Statement(by, light(answer), _replays(system, goal, answer)) for answer, by in each)
    return Disagreement(system.name, goal.name, tuple(sayings))


def _replays(system: TransitionSystem, goal: Var, answer: Answer) -> bool | None:
    """Whether the run of an answer reaches the goal by the reference semantics."""
    from checker.verify.runs.minimise import transferred

    return transferred(answer.run, system, goal) is not None if isinstance(answer, Reached) else None
