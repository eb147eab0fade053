"""What a question looks like: the few facts about it that choose the order of the engines."""

from dataclasses import dataclass

from checker.portfolio.question import Hint, Question
from checker.slice import sliced

WIDE, VAST = 200, 800
"""Bits of a valuation, of what the goals depend on: up to the first, enumerating valuations is worth much
effort, up to the second some, above it none (compiling such a step takes longer than deciding it)."""


@dataclass(frozen=True)
class Shape:
    """``bits`` of a valuation of what the goals depend on, and what whoever asks knows of the answer."""

    bits: int
    hint: Hint = Hint.NONE

    @property
    def kind(self) -> str:
        """The row of the table of orders that is meant for it."""
        if self.bits > VAST:
            return "vast"
        return self.hint.value or ("wide" if self.bits > WIDE else "narrow")


def shape(question: Question) -> Shape:
    """The shape of a question."""
    part = sliced(question.system, question.goals)
    return Shape(sum((len(v.domain) - 1).bit_length() for v in part.variables), question.hint)
