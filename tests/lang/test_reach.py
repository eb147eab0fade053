"""Which states can be active: found in one pass, compared with what is true of the definition."""

from collections.abc import Iterable

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rovercheck.spec_model.lang.chart import Chart, Path, State, to
from rovercheck.spec_model.lang.wellformed import check_chart
from rovercheck.spec_model.lang.wellformed.paths import PathReach
from rovercheck.spec_model.lang.wellformed.places import Leg, legs
from tests.profiles import examples
from tests.strategies import systems


def naive(chart: Chart, all_legs: Iterable[Leg]) -> tuple[set[Path], set[Path]]:
    """The states that can be active and the composites completed, as the definition says: until no more."""
    entered: set[Path] = set()
    completed: set[Path] = set()

    def complete(path: Path) -> None:
        entered.update([path] if path else [])
        state = chart.states[path]
        for region in state.states if state.parallel else ():
            complete((*path, region.name))
        if state.states and not state.parallel:
            completed.add(path)

    def enter(target: Path) -> None:
        for depth in range(1, len(target) + 1):
            parent, state = target[: depth - 1], target[:depth]
            entered.add(state)
            for region in chart.states[parent].states if chart.states[parent].parallel else ():
                if (*parent, region.name) != state:
                    complete((*parent, region.name))
        complete(target)

    complete(())
    size = -1
    while size != len(entered) + len(completed):
        size = len(entered) + len(completed)
        for leg in all_legs:
            if leg.complete and leg.source in (completed if leg.default else entered):
                enter(leg.end)
    return entered, completed


def same(chart: Chart, all_legs: list[Leg]) -> None:
    found = PathReach(chart, all_legs)
    assert (found.entered, found.completed) == naive(chart, all_legs)


@settings(examples(100), suppress_health_check=list(HealthCheck))
@given(st.data())
def test_the_states_that_can_be_active_are_those_of_the_definition(data: st.DataObject) -> None:
    """Also where some transitions are left out, so that not every state is reached."""
    for chart in data.draw(systems()).charts:
        every = list(legs(chart))
        same(chart, every)
        keep = data.draw(st.lists(st.booleans(), min_size=len(every), max_size=len(every)))
        same(chart, [leg for leg, kept in zip(every, keep, strict=True) if kept])


@settings(examples(300), suppress_health_check=list(HealthCheck))
@given(st.data())
def test_also_in_deep_trees_with_transitions_from_anywhere_to_anywhere(data: st.DataObject) -> None:
    """Regions entered by name complete the others, in any order of transitions."""
    counter = iter(range(1_000))

    def tree(depth: int) -> State:
        inside = [tree(depth - 1) for _ in range(data.draw(st.integers(0, 3)) if depth else 0)]
        return State(f"S{next(counter)}", states=inside, parallel=bool(inside) and data.draw(st.booleans()))

    chart = Chart("Deep", [tree(3), tree(3)], parallel=data.draw(st.booleans()))
    states = [path for path in chart.states if path]
    ends = st.tuples(st.sampled_from(list(chart.states)), st.booleans(), st.sampled_from(states))
    transitions = data.draw(st.lists(ends, max_size=12))
    same(chart, [Leg(source, default, "", to(end[-1]), end, True) for source, default, end in transitions])


def test_two_regions_that_are_entered_by_name_each_complete_the_other() -> None:
    both = [State(r, states=[State("X"), State("Y")]) for r in ("R1", "R2")]
    chart = Chart("C", [State("Off"), State("On", states=both, parallel=True)])
    jumps = [Leg((), True, "", to("Off"), ("Off",), True)]
    jumps += [Leg(("Off",), False, "", to("Y"), ("On", r, "Y"), True) for r in ("R1", "R2")]
    same(chart, jumps)
    assert {("On", "R1"), ("On", "R2")} <= PathReach(chart, jumps).completed


def test_each_transition_is_followed_once_however_deep_it_lies(monkeypatch: pytest.MonkeyPatch) -> None:
    """Transitions that lead inward, against the order of the tree, took a pass over all for each level."""
    inner = State("C150")
    for level in range(149, -1, -1):
        near = State(f"B{level}", transitions=[to(f"C{level + 1}")])
        inner = State(f"C{level}", states=[inner, near], default=f"B{level}")
    chart = Chart("Deep", [inner], default="C0")
    check_chart(chart)
    every, asked = list(legs(chart)), list[Path]()
    follow = PathReach._name

    def followed(reach: PathReach, target: Path) -> None:
        asked.append(target)
        follow(reach, target)

    monkeypatch.setattr(PathReach, "_name", followed)
    assert len(PathReach(chart, every).entered) == len(chart.states) - 1
    assert len(asked) <= len(every)
