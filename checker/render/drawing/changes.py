"""In what two versions of a chart or block differ: actions, and the arrows of each state and junction."""

from collections.abc import Iterator
from dataclasses import dataclass

from rovercheck.checker.render.drawing.labels import ChartArrow, action_lines, arrows, label
from rovercheck.spec_model.lang.chart import Block, Chart


@dataclass(frozen=True)
class DrawnChange:
    """One place with what stood there before and what stands there after; empty for nothing."""

    place: str
    before: tuple[str, ...]
    after: tuple[str, ...]


def changes(before: Chart | Block, after: Chart | Block) -> tuple[DrawnChange, ...]:
    """Every place that differs, in drawing order, new places last."""
    old, new = dict(_lines(before)), dict(_lines(after))
    places = dict.fromkeys((*old, *new))
    found = (DrawnChange(place, old.get(place, ()), new.get(place, ())) for place in places)
    return tuple(change for change in found if change.before != change.after)


def _lines(part: Chart | Block) -> Iterator[tuple[str, tuple[str, ...]]]:
    if isinstance(part, Block):
        yield part.name, tuple(map(str, part.do))
        return
    by_source: dict[str, list[str]] = {}
    for arrow in arrows(part):
        start = ".".join(arrow.source) or part.name
        place = f"default transition of {start}" if arrow.default else f"transitions of {start}"
        by_source.setdefault(place, []).append(_written(arrow))
    for path, state in part.states.items():
        yield f"actions of {'.'.join(path) or part.name}", action_lines(state)
    yield from ((place, tuple(lines)) for place, lines in by_source.items())


def _written(arrow: ChartArrow) -> str:
    shown = label(arrow.transition)
    return f"{arrow.order}: {shown} → {arrow.target[-1]}" if shown else f"{arrow.order}: → {arrow.target[-1]}"
