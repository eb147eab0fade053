"""Collecting certificates while properties are decided."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Protocol

from rovercheck.checker.certify.certificate import Certificate, certificates
from rovercheck.checker.results.verdict import Answer, Exhausted, Inductive, Proved, Verdict, Violated
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem


class CertifyRequest(Protocol):
    """A question to an engine (``checker.verify.portfolio.Question``)."""

    @property
    def system(self) -> TransitionSystem: ...

    @property
    def goals(self) -> Sequence[Var]: ...


@dataclass
class Recorder:
    """Hears answers where they are found, and makes certificates of them at once.

    What there is no memory to make one of has none; the answer stands.
    """

    made: list[Certificate] = field(default_factory=list)
    most: int | None = None
    """Values (states times variables) of a closed set of which one is made."""

    def answered(self, asked: CertifyRequest, found: Mapping[str, tuple[Answer, str]]) -> None:
        """Answers to a question, each with the name of the engine that gave it."""
        for engine in sorted({by for _, by in found.values()}):
            own = {name: answer for name, (answer, by) in found.items() if by == engine}
            with suppress(MemoryError):
                self.made += certificates(asked.system, asked.goals, own, engine, self.most)


def rests_on_answers(verdict: Verdict) -> bool:
    """Whether a verdict claims that something never happens, which a certificate can show."""
    return isinstance(verdict, Proved | Violated) and isinstance(verdict.because, Exhausted | Inductive)


def certified(proved: Mapping[str, Verdict], made: Sequence[Certificate]) -> tuple[str, ...]:
    """The ids among the verdicts on which the certificates can be checked."""
    engines = {one.engine for one in made}
    return tuple(id for id, v in proved.items() if rests_on_answers(v) and v.engine in engines)
