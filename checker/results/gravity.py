"""Which finding is graver, as numbers: the order in which every output tells findings."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

T = TypeVar("T")


@dataclass(frozen=True)
class Gravity:
    """How grave a finding is; smaller numbers are graver.

    ``severity`` of its ``hazard``, which is numbered in the order of the file; ``requirement`` is the place
    of the gravest that it breaks.  ``within`` decides between two findings about one requirement.
    """

    severity: int
    hazard: int
    requirement: int
    within: tuple[bool, int, int, str]


def gravest_first(found: Sequence[T], gravity: Callable[[T], Gravity]) -> list[T]:
    """The gravest first: by severity, then by hazard.

    Of one hazard: for each requirement the gravest, in the order of the requirements, then for each the next,
    and so on.
    """
    turns = Counter[tuple[int, int]]()
    keyed = []
    for one in sorted(found, key=lambda one: gravity(one).within):
        how = gravity(one)
        turn = turns[how.hazard, how.requirement]
        turns[how.hazard, how.requirement] += 1
        keyed.append(((how.severity, how.hazard, turn, how.requirement), one))
    return [one for _, one in sorted(keyed, key=lambda pair: pair[0])]
