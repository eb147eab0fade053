"""What a question looks like: the few facts about it that choose the order of the engines."""

from collections.abc import Mapping
from dataclasses import dataclass

from rovercheck.checker.system.slice import sliced
from rovercheck.checker.system.width import FEW, WIDE, bits_of
from rovercheck.checker.verify.portfolio.question import PortfolioQuestion, Prior
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.system import TransitionSystem

VAST = 800
"""Bits of a state, of what the goals depend on: up to ``WIDE``, enumerating states is worth much
effort, up to this some, above it none (compiling such a step takes longer than deciding it)."""

BROAD = 64
"""Bits of a state: with more, enumerating is soon given up, and taken up again if no proof is found."""

MANY = 40
"""Bits that are free in each tick: with more, a wide state has more successors than can be enumerated."""


@dataclass(frozen=True)
class Shape:
    """``bits`` of a state of what the goals depend on, and what the caller knows of the answer.

    ``free`` bits of it are chosen anew in each tick.

    ``at_once`` of the bits can differ from their start in one state: of the counters of chart states that are
    never active together all but one are 0.  None: all of them.
    """

    bits: int
    prior: Prior = Prior.NONE
    at_once: int | None = None
    free: int | None = None

    @property
    def kind(self) -> str:
        """The row of the table of orders that is meant for it."""
        at_once = self.bits if self.at_once is None else self.at_once
        wide = at_once > WIDE
        free = None if self.prior.value or not wide else self.free
        if free is not None and free <= FEW:
            return "driven"
        if wide and (self.bits > VAST or (free is not None and free > MANY)):
            return "vast"
        return self.prior.value or ("wide" if wide else "broad" if at_once > BROAD else "narrow")

    @property
    def enumerable(self) -> bool:
        """Whether enumerating its states is worth much effort."""
        return self.kind in ("narrow", "broad")


def shape(question: PortfolioQuestion) -> Shape:
    """The shape of a question."""
    part = sliced(question.system, question.goals)
    bits = {v.name: (len(v.domain) - 1).bit_length() for v in part.variables}
    return Shape(sum(bits.values()), question.prior, _at_once(question.system, bits), bits_of(part.inputs))


def _at_once(system: TransitionSystem, bits: Mapping[str, int]) -> int:
    left = dict(bits)
    charts = system.source.charts if system.source else ()
    return sum(_counting(chart, (), _counters(chart, left)) for chart in charts) + sum(left.values())


def _counters(chart: Chart, left: dict[str, int]) -> dict[Path, int]:
    """The bits of the counters of each state, taken out of those that are ``left``."""
    owners = {".".join((chart.name, *path)): path for path in chart.states}
    found: dict[Path, int] = {}
    for name in list(left):
        owner, _, word = name.rpartition(".")
        if owner in owners and word.rstrip("0123456789") in ("after", "duration"):
            found[owners[owner]] = found.get(owners[owner], 0) + left.pop(name)
    return found


def _counting(chart: Chart, path: Path, counters: Mapping[Path, int]) -> int:
    """The most bits of counters in and below a chart state that can count in one state."""
    state = chart.states[path]
    inside = [_counting(chart, (*path, child.name), counters) for child in state.states]
    return counters.get(path, 0) + (sum(inside) if state.parallel else max(inside, default=0))
