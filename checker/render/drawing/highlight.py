"""Which states and arrows of a chart to emphasise, named as traces and people name them."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from checker.render.drawing.scheme import ChartArrow
from checker.trace import Arrow
from spec_model.lang.chart import Chart, Path


@dataclass(frozen=True)
class Emphasis:
    """Active states by path and fired arrows by name."""

    states: frozenset[Path] = frozenset()
    arrows: frozenset[str] = frozenset()


def emphasis(
    chart: Chart, every: Iterable[ChartArrow], active: Collection[str], fired: Collection[Arrow]
) -> Emphasis:
    """What ``active`` state names and ``fired`` arrows of a trace mean in this chart.

    The states around an active state are active too.  Raises ``ModelError`` for an unknown state.
    """
    states: set[Path] = set()
    for name in active:
        path = chart.path(name)
        states.update(path[:depth] for depth in range(1, len(path) + 1))
    names = {a.name for a in every for f in fired if f.chart == chart.name and _is(a, f)}
    return Emphasis(frozenset(states), frozenset(names))


def _is(arrow: ChartArrow, fired: Arrow) -> bool:
    if arrow.default != (fired.order == 0):
        return False
    return _named(arrow.target, fired.target) and (
        arrow.default or (arrow.order == fired.order and _named(arrow.source, fired.source))
    )


def _named(path: Path, name: str) -> bool:
    wanted = tuple(name.split("."))
    return path[-len(wanted) :] == wanted
