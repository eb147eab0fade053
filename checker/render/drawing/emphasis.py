"""Which states and arrows of a chart to emphasise, named as traces and people name them."""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from rovercheck.checker.render.drawing.labels import ChartArrow, label
from rovercheck.checker.results.trace import TakenTransition
from rovercheck.spec_model.lang.chart import Chart, Path


@dataclass(frozen=True)
class Emphasis:
    """Active states by path and fired arrows by name."""

    states: frozenset[Path] = frozenset()
    arrows: frozenset[str] = frozenset()


def emphasis(
    chart: Chart, every: Iterable[ChartArrow], active: Collection[str], fired: Collection[TakenTransition]
) -> Emphasis:
    """What ``active`` state names and ``fired`` arrows of a trace mean in this chart.

    The states around an active state are active too.  Raises ``ModelError`` for an unknown state.
    """
    states: set[Path] = set()
    for name in active:
        path = chart.path(name)
        states.update(path[:depth] for depth in range(1, len(path) + 1))
    every = tuple(every)
    names = {a.name for f in fired if f.chart == chart.name for a in segments(chart, every, f)}
    return Emphasis(frozenset(states), frozenset(names))


def segments(chart: Chart, every: Sequence[ChartArrow], fired: TakenTransition) -> tuple[ChartArrow, ...]:
    """The segments of the drawn path that fired; none when no path has its ends and its label."""
    leaving: dict[Path, list[ChartArrow]] = {}
    for arrow in every:
        if not arrow.default:
            leaving.setdefault(arrow.source, []).append(arrow)
    starts = [a for a in every if _starts(a, fired)]
    paths: list[tuple[ChartArrow, ...]] = [(a,) for a in starts]
    for path in paths:
        end = path[-1].target
        if end in chart.junctions:
            paths += [(*path, a) for a in leaving.get(end, ()) if a not in path]
        elif _named(end, fired.target) and _label(path) == fired.label:
            return path
    return ()


def _label(path: Sequence[ChartArrow]) -> str:
    return " → ".join(filter(None, (label(a.transition) for a in path)))


def _starts(arrow: ChartArrow, fired: TakenTransition) -> bool:
    if arrow.default or fired.order == 0:
        return arrow.default and fired.order == 0
    return arrow.order == fired.order and _named(arrow.source, fired.source)


def _named(path: Path, name: str) -> bool:
    wanted = tuple(name.split("."))
    return path[-len(wanted) :] == wanted
