"""In which ways a chart may be drawn: how long its lines of text are, and how each level is laid out."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.render.drawing.cuts import Cut, CutWay, cuts
from rovercheck.checker.render.drawing.labels import ChartArrow
from rovercheck.checker.render.drawing.picture import DrawnPicture
from rovercheck.checker.render.drawing.ranks import backward
from rovercheck.spec_model.lang.chart import Chart, Path


@dataclass(frozen=True)
class Manner:
    """Characters in a line of a label and of actions."""

    label: int
    action: int


MANNERS = (Manner(36, 62), Manner(28, 48), Manner(24, 42), Manner(20, 42), Manner(18, 40))
"""From generous to narrow."""


@dataclass(frozen=True)
class Sheet:
    """The chart and its arrows, which every level looks at, how they are drawn, and levels drawn so far.

    ``folded``: of long lists of actions only the beginning is drawn.
    """

    chart: Chart
    arrows: tuple[ChartArrow, ...]
    manner: Manner
    folded: bool = False
    drawn: dict[tuple[object, ...], DrawnPicture] = field(default_factory=dict)


def ways(sheet: Sheet, level: Path, names: Sequence[str], found: Sequence[Cut]) -> Iterable[CutWay]:
    """The ways of drawing a level that are worth trying."""
    states = sheet.chart.states
    inside = [c for c in found if not c.crosses and not c.loop]
    big = {s.name for s in states[level].states if s.states}
    between = frozenset(c.name for c in inside if {c.source, c.target} <= big)
    different: dict[CutWay, None] = {}
    for folded in dict.fromkeys([frozenset[str](), between]):
        straight = [(c.name, c.source, c.target) for c in inside if c.name not in folded]
        for breadth in (False, True):
            back = backward(names, straight, breadth)
            different[CutWay(back, folded)] = None
            if not folded and _turns(sheet, level):
                different[CutWay(back, upright=True)] = None
    return different


def _turns(sheet: Sheet, level: Path) -> bool:
    """Whether a level can be drawn from top to bottom, with all that arrows across its borders tie to it.

    Regions have their ports at the left and right, and arrows from a state to itself lie above it.
    """
    found = list(cuts(sheet.arrows, level, sheet.manner.label))
    if any(c.loop for c in found) or sheet.chart.states[level].parallel:
        return False
    inside = [(*level, s.name) for s in sheet.chart.states[level].states if s.states]
    return all(_turns(sheet, path) for path in inside if _crossed(sheet, path))


def _crossed(sheet: Sheet, path: Path) -> bool:
    """Whether an arrow crosses the border of a composite."""
    return any(c.crosses for c in cuts(sheet.arrows, path, sheet.manner.label))
