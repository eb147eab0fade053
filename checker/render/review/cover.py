"""The first pages of a review: who reviews what, the worst findings, totals, and what is open."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256

from rovercheck.checker.render.review.model import (
    PROVED,
    UNKNOWN,
    VIOLATED,
    HazardRow,
    Review,
    ReviewedProperty,
)

WORST = 10
"""Findings that the first page names."""


@dataclass(frozen=True)
class WorstFinding:
    """A finding of the first page, and how many others have its cause."""

    finding: ReviewedProperty
    same: int = 0


@dataclass(frozen=True)
class HazardTotal:
    """How many properties stand between us and a hazard, by verdict; how many violations are accepted."""

    hazard: HazardRow
    proved: int = 0
    violated: int = 0
    unknown: int = 0
    accepted: int = 0


@dataclass(frozen=True)
class OpenPoints:
    """What nobody has settled: each a list of properties."""

    changed: tuple[ReviewedProperty, ...]
    unknown: tuple[ReviewedProperty, ...]
    lapsed: tuple[ReviewedProperty, ...]
    undecided: tuple[ReviewedProperty, ...]
    vacuous: tuple[ReviewedProperty, ...]

    @property
    def named(self) -> Sequence[tuple[str, tuple[ReviewedProperty, ...]]]:
        """Each list with what is open about it, those that are empty left out."""
        every = (
            ("not as expected", self.changed),
            ("not decided within the limits", self.unknown),
            ("accepted until a day that is over", self.lapsed),
            ("violated, and nobody has accepted it", self.undecided),
            ("proved of a case that never occurs", self.vacuous),
        )
        return [(says, of) for says, of in every if of]

    @property
    def count(self) -> int:
        """How many properties have an open point."""
        return len({p.id for _, of in self.named for p in of})


def worst(review: Review, most: int = WORST) -> tuple[WorstFinding, ...]:
    """The gravest findings, one for each cause."""
    causes = Counter(_cause(p) for p in review.findings)
    first: dict[str, WorstFinding] = {}
    for one in review.findings:
        first.setdefault(_cause(one), WorstFinding(one, causes[_cause(one)] - 1))
    return tuple(first.values())[:most]


def _cause(one: ReviewedProperty) -> str:
    return one.cause or one.id


def hazard_totals(review: Review) -> tuple[HazardTotal, ...]:
    """A row for each hazard in its order; what no hazard names comes last, as far as there is any."""
    unrated = HazardRow("", "No hazard names what would be broken.", "unrated", "")
    rows = *review.hazards.values(), unrated
    totals = (_total(row, [p for p in review.properties if p.hazard == row.id]) for row in rows)
    return tuple(one for one in totals if one.hazard.id or one.proved or one.violated or one.unknown)


def _total(row: HazardRow, of: Sequence[ReviewedProperty]) -> HazardTotal:
    count = Counter(p.verdict for p in of)
    accepted = sum(p.accepted for p in of)
    return HazardTotal(row, count[PROVED], count[VIOLATED], count[UNKNOWN], accepted)


def open_points(review: Review) -> OpenPoints:
    """What nobody has settled, the gravest first."""
    shown = sorted(review.properties, key=lambda p: p.place)
    return OpenPoints(
        tuple(p for p in shown if not p.as_expected),
        tuple(p for p in shown if p.verdict == UNKNOWN),
        tuple(p for p in shown if p.lapsed),
        tuple(p for p in shown if p.undecided),
        tuple(p for p in shown if p.vacuous),
    )


def state_totals(review: Review, words: Mapping[str, str]) -> Iterator[tuple[str, str, int]]:
    """How many requirements are in each state, with its name and word, those that occur."""
    count = Counter(row.state for row in review.demands)
    yield from ((state, word, count[state]) for state, word in words.items() if count[state])


def identity(review: Review) -> str:
    """What a page is about, as a short key: decisions on one page are not taken for those on another."""
    made = review.origin
    said = "\n".join((review.title, made.variant, *(digest for _, digest in made.digests)))
    return sha256(said.encode()).hexdigest()[:16]


def decision_state(one: ReviewedProperty) -> str:
    """Who lives with a finding, in a word."""
    if one.lapsed:
        return "expired"
    if one.accepted:
        return "accepted"
    return "open" if one.finding else ""
