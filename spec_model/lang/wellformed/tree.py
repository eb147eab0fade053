"""The drawing as a tree: names, composites, where transitions end, junction cycles."""

from collections import Counter
from collections.abc import Iterator, Sequence

from rovercheck.spec_model.lang.chart import NOWHERE, Chart, Path, State, Transition
from rovercheck.spec_model.lang.errors import did_you_mean
from rovercheck.spec_model.lang.wellformed.places import name_of, parallel_name, transition_names


def tree_faults(chart: Chart) -> Iterator[str]:
    """Names, and what composites may have."""
    if not chart.root.states:
        yield "a chart needs at least one state; a chart without states is a Block."
    for path, state in chart.root.walk():
        yield from _name_faults(path, state)
        yield from _composite_faults(path, state)


def _name_faults(path: Path, state: State) -> Iterator[str]:
    names = [s.name for s in state.states] + [j.name for j in state.junctions]
    for name, times in Counter(names).items():
        if times > 1:
            yield (
                f"{times} states or junctions of {name_of(path)} are named {name!r}; "
                "names at one level must differ."
            )
        if "." in name or name in ("", NOWHERE):
            yield f"{name!r} in {name_of(path)} cannot be a name; write one without dots, not {NOWHERE!r}."


def _composite_faults(path: Path, state: State) -> Iterator[str]:
    if state.parallel and state.default:
        yield f"{name_of(path)} is parallel and has a default transition; all regions are entered, remove it."
    if path and state.parallel and not state.states:
        yield f"{name_of(path)} is parallel and has no regions; give it states or remove parallel=True."
    if path and state.default and not state.states:
        yield f"{name_of(path)} has a default transition and no states; remove it."
    for junction in state.junctions:
        if not junction.transitions:
            yield (
                f"junction {junction.name} has no transitions, "
                "so that no path through it is complete; draw one."
            )
    if state.parallel:
        yield from _region_faults(path, state)


def _region_faults(path: Path, state: State) -> Iterator[str]:
    for region in state.states:
        if region.transitions:
            yield (
                f"{region.name} is a region of {parallel_name(path)} and has transitions; "
                "a region is left only with all its siblings: draw the transition from the composite."
            )


def target_faults(chart: Chart) -> Iterator[str]:
    """Transitions whose end is unknown or ambiguous."""
    for path, state in chart.states.items():
        yield from _ends(chart, path, transition_names(state.default, path, default=True))
        yield from _ends(chart, path[:-1], transition_names(state.transitions, path))
        for junction in state.junctions:
            yield from _ends(chart, path, transition_names(junction.transitions, (*path, junction.name)))


def _ends(chart: Chart, level: Path, transitions: Sequence[tuple[str, Transition]]) -> Iterator[str]:
    for name, transition in transitions:
        end = chart.resolve(level, transition.target)
        if end is None:
            yield f"{name} goes to {transition.target!r}, {_why(chart, transition.target)}"
        elif not end:
            yield f"{name} goes to the chart itself; name one of its states."


def _why(chart: Chart, target: str) -> str:
    wanted = tuple(target.split("."))
    ends = [p for p in (*chart.states, *chart.junctions) if p]
    found = [".".join(p) for p in ends if p[-len(wanted) :] == wanted]
    if found:
        return f"which is {len(found)} states of this chart; write one of: {', '.join(found)}."
    return f"which is no state of this chart. {did_you_mean(target, {p[-1] for p in ends})}"


def junction_cycle_faults(chart: Chart) -> Iterator[str]:
    """Junctions from which transitions lead back to them without passing a state."""
    onward = {
        path: [chart.resolve(path[:-1], t.target) for t in junction.transitions]
        for path, junction in chart.junctions.items()
    }
    for start, ends in onward.items():
        seen: set[Path] = set()
        todo = list(ends)
        while todo:
            end = todo.pop()
            if end is not None and end in onward and end not in seen:
                seen.add(end)
                todo += onward[end]
        if start in seen:
            yield (
                f"the transitions from junction {start[-1]} lead back to it without a state; break the cycle."
            )
