"""Which chart decides an output of a part: a function block that only passes it on is looked through."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from rovercheck.spec_model.lang.action import expressions, writes
from rovercheck.spec_model.lang.chart import Block, Chart, Path, State
from rovercheck.spec_model.lang.walk import variables


@dataclass(frozen=True)
class Deciders:
    """What decides an output.

    ``places`` are the location variables of the charts, those of the parallel states that have to do with it;
    ``charts`` the charts, ``blocks`` the function blocks that pass their value on, the last one first.
    """

    places: frozenset[str]
    charts: tuple[str, ...]
    blocks: tuple[str, ...]

    @property
    def told(self) -> str:
        """As a sentence names it: ``Obstacles, which TranslateDecision passes on``."""
        if not self.charts:
            return " and ".join(self.blocks[:1])
        charts = " and ".join(self.charts)
        return f"{charts}, which {self.blocks[0]} passes on" if self.blocks else charts


@cache
def deciders(components: tuple[Chart | Block, ...], variable: str) -> Deciders:
    """What decides a variable that components of a part write, as far as the part holds it."""
    places, charts, blocks = set[str](), dict[str, None](), dict[str, None]()
    waiting, seen = [variable], {variable}
    while waiting:
        name = waiting.pop()
        for component in components:
            if isinstance(component, Chart) and (found := list(_locations(component, name))):
                places |= set(found)
                charts[component.name] = None
            elif isinstance(component, Block) and name in component.written:
                blocks[component.name] = None
                read = set(variables(*expressions(component.do))) - seen
                seen |= read
                waiting += sorted(read)
    return Deciders(frozenset(places), tuple(charts), tuple(blocks))


def _locations(chart: Chart, variable: str) -> Iterator[str]:
    """The locations of a chart that have to do with a variable: a location itself, or data of the chart."""
    composites = [path for path, state in chart.states.items() if state.states and not state.parallel]
    levels = {chart.location(path).name: path for path in composites}
    if variable in levels:
        yield variable
    if variable not in chart.written:
        return
    writers = [path for path, state in chart.states.items() if _writes(state, variable)]
    for name, level in levels.items():
        if any(_along(level, path) for path in writers):
            yield name


def _along(one: Path, other: Path) -> bool:
    """Whether one of two paths leads to the other."""
    shorter = min(len(one), len(other))
    return one[:shorter] == other[:shorter]


def _writes(state: State, variable: str) -> bool:
    """Whether a state writes a variable itself, or a transition that is drawn with it."""
    actions = [*state.entry, *state.during, *state.exit]
    segments = [*state.default, *state.transitions, *(t for j in state.junctions for t in j.transitions)]
    for transition in segments:
        actions += [*transition.do, *transition.then]
    return variable in writes(actions)
