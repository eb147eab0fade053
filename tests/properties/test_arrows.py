"""The properties that every arrow of the obstacle chart can be taken: together their runs take them all."""

from rovercheck.checker.engines import Limits, quiet
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Proved
from rovercheck.checker.verify.decide import AUTO, decide, tasks
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.lang.chart import Chart, Path, Transition
from rovercheck.spec_model.rover import systems

WITNESSES = [p for p in catalogue().values() if p.area in ("obstacles_arrows", "obstacles_states")]


def _ways(chart: Chart, level: Path, arrow: Transition) -> int:
    """Through how many sequences of segments an arrow leads to a state."""
    target = chart.resolve(level, arrow.target)
    assert target is not None
    if target not in chart.junctions:
        return 1
    return sum(_ways(chart, target[:-1], after) for after in chart.junctions[target].transitions)


def test_the_witnesses_take_every_arrow_of_the_figure() -> None:
    taken: set[tuple[str, int, str]] = set()
    for task in tasks(WITNESSES, systems()):
        for result in decide(task, systems(), AUTO, Limits(), quiet):
            assert isinstance(result.verdict, Proved) and isinstance(result.verdict.because, Trace)
            arrows = (a for tick in result.verdict.because.ticks for a in tick.arrows)
            taken |= {(a.source, a.order, a.label) for a in arrows if a.chart == "Obstacles" and a.order}
    [chart] = (c for c in systems()["obstacles_n"].charts if c.name == "Obstacles")
    for path, state in chart.states.items():
        for order, arrow in enumerate(state.transitions, start=1):
            ways = {way for way in taken if way[:2] == (".".join(path), order)}
            assert len(ways) == _ways(chart, path[:-1], arrow), f"{'.'.join(path)}: arrow {order} {arrow}"
