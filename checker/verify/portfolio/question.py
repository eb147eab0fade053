"""A question to engines, and who is told what while it is asked."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import NamedTuple

from rovercheck.checker.engines import Progress, engines, quiet
from rovercheck.checker.results.trace import counted_ticks
from rovercheck.checker.results.verdict import Answer, Evidence, Exhausted, Open, Reached, Unreachable
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import TransitionSystem


class Contradiction(Exception):
    """Two answers about one goal cannot both be true."""


class EngineAnswer(NamedTuple):
    """An answer, and the name of the engine that gave it.  ``a | b`` is what both say together.

    >>> EngineAnswer(Open("the time limit is reached", 4), "bmc") | EngineAnswer(Open("no idea", 0), "pdr")
    EngineAnswer(answer=Open(reason='bmc: the time limit is reached; pdr: no idea', depth=4), engine='bmc')
    """

    answer: Answer
    engine: str

    def __or__(self, other: "EngineAnswer") -> "EngineAnswer":
        """The shorter run, the deeper search.  Raises ``Contradiction``."""
        if contradict(self.answer, other.answer):
            raise Contradiction
        match self.answer, other.answer:
            case Open(), Open():
                return self._deeper(other)
            case Reached() as run, Open(_, depth):
                return (
                    self._replace(answer=replace(run, shortest=True)) if depth >= len(run.run) - 1 else self
                )
            case Open(), Reached():
                return other | self
            case Reached(one, shortest), Reached(another):
                return self if shortest or len(one) < len(another) else other
            case Open(), _:
                return other
            case _:
                return self

    def _deeper(self, other: "EngineAnswer") -> "EngineAnswer":
        assert isinstance(self.answer, Open) and isinstance(other.answer, Open)
        deeper = self if self.answer.depth > other.answer.depth else other
        reason = f"{self._reason}; {other._reason}"
        return EngineAnswer(Open(reason, max(self.answer.depth, other.answer.depth)), deeper.engine)

    @property
    def _reason(self) -> str:
        """Why it is open, with the engine whose reason it is, unless those put together already say it."""
        assert isinstance(self.answer, Open)
        reason = self.answer.reason
        told = reason.startswith(tuple(f"{name}: " for name in engines()))
        return reason if told else f"{self.engine}: {reason}"


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


Found = Mapping[str, EngineAnswer]
"""An answer for each goal, by its name."""


def stays(question: "PortfolioQuestion", found: Found) -> bool:
    """Whether it is shown among the answers that no run leaves a domain."""
    return all(c.name in found and isinstance(found[c.name][0], Unreachable) for c in question.checks)


def conclusive(answer: Answer) -> bool:
    """Whether no engine can add to an answer."""
    return isinstance(answer, Unreachable) or (isinstance(answer, Reached) and answer.shortest)


class Prior(StrEnum):
    """What is known of the answer beforehand."""

    NONE = ""
    SHORT = "short"
    """If there is a run, it is probably short, and it counts whatever other runs do."""
    CONCRETE = "concrete"
    """An over-approximation has a run, so there probably is one."""


@dataclass(frozen=True)
class PortfolioQuestion:
    """Is any of the ``wanted`` goals ever true after a tick, and does the model leave a domain?

    ``candidates`` are formulas that may be an invariant, from a recorded proof: of the same charts, or of
    charts before they were changed.  None: no proof is recorded.
    """

    system: TransitionSystem
    wanted: tuple[Var, ...]
    prior: Prior = Prior.NONE
    candidates: tuple[Expr, ...] | None = None

    @property
    def checks(self) -> tuple[Var, ...]:
        """The variables that tell that the model has left a domain."""
        return tuple(check for check, _ in self.system.checks)

    @property
    def goals(self) -> tuple[Var, ...]:
        """All goals that engines decide."""
        return (*self.wanted, *self.checks)

    def open(self, found: Found) -> list[Var]:
        """The goals without a conclusive answer; a run that may not be a shortest one is none."""
        return [*_open(self.wanted, found), *self.unsettled(found)]

    def unsettled(self, found: Found) -> list[Var]:
        """The checks of which it is not known whether the model breaks them."""
        return _open(self.checks, found)


def _open(goals: Sequence[Var], found: Found) -> list[Var]:
    return [g for g in goals if g.name not in found or not conclusive(found[g.name][0])]


def _nothing(_: object) -> None:
    pass


def _no_answers(_: PortfolioQuestion, __: Found) -> None:
    pass


@dataclass(frozen=True)
class Callbacks:
    """Functions that an engine call reports to.

    ``on_budget`` receives, before each engine and after its answer, how many seconds are left for the
    question (None: any number).  ``on_answer`` receives the answers of a question as they are found.
    """

    progress: Progress = quiet
    on_budget: Callable[[float | None], None] = _nothing
    on_answer: Callable[[PortfolioQuestion, Found], None] = _no_answers


def in_words(answer: Answer) -> str:
    """``after 8 ticks``, ``never: all 154 reachable states``, ``not within 300 ticks: the time ...``."""
    match answer:
        case Reached(run):
            return f"after {counted_ticks(len(run))}"
        case Unreachable(because):
            return f"never: {because.how}"
        case Open(reason, depth):
            return f"not within {counted_ticks(depth)}: {reason}"


def light(answer: Answer) -> Answer:
    """The answer without the states that an exhausted search kept: fit for travelling."""
    return Unreachable(light_evidence(answer.because)) if isinstance(answer, Unreachable) else answer


def light_evidence(evidence: Evidence) -> Evidence:
    """The evidence without the states themselves."""
    return replace(evidence, closed=None, diagram=None) if isinstance(evidence, Exhausted) else evidence
