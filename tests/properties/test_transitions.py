"""That every transition of the obstacle chart can be taken: together the witnesses take them all."""

from rovercheck.checker.engines import AUTO, Limits
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Proved
from rovercheck.checker.verify.decide import decide, tasks
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.lang.chart import Chart, Path, Transition
from rovercheck.spec_model.rover import systems

WITNESSES = [p for p in catalogue().values() if p.area in ("obstacles_transitions", "obstacles_states")]


def _ways(chart: Chart, level: Path, transition: Transition) -> int:
    """Through how many sequences of segments a transition leads to a state."""
    target = chart.resolve(level, transition.target)
    assert target is not None
    if target not in chart.junctions:
        return 1
    return sum(_ways(chart, target[:-1], after) for after in chart.junctions[target].transitions)


def test_the_witnesses_take_every_transition_of_the_figure() -> None:
    taken: set[tuple[str, int, str]] = set()
    for task in tasks(WITNESSES, systems()):
        for result in decide(task, systems(), AUTO, Limits()):
            assert isinstance(result.verdict, Proved) and isinstance(result.verdict.because, Trace)
            transitions = (a for tick in result.verdict.because.ticks for a in tick.transitions)
            taken |= {(a.source, a.order, a.label) for a in transitions if a.chart == "Obstacles" and a.order}
    [chart] = (c for c in systems()["obstacles_n"].charts if c.name == "Obstacles")
    for path, state in chart.states.items():
        for order, transition in enumerate(state.transitions, start=1):
            ways = {way for way in taken if way[:2] == (".".join(path), order)}
            assert len(ways) == _ways(chart, path[:-1], transition), (
                f"{'.'.join(path)}: transition {order} {transition}"
            )
