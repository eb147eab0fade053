"""Outputs that hold which state is active, as members of an enumeration."""

from collections.abc import Iterator

from rovercheck.checker.drawn.records import DrawnChart, DrawnContent, DrawnData, DrawnState

NONE = "None"
"""The member where no state is active, whose number is 0."""


def activity_members(chart: DrawnChart, one: DrawnData) -> dict[int, str]:
    """Of the states that an output tells of, by SSID, the names of their members.

    A leaf state whose name another one has is told with the names of the states around it.
    """
    content = _content(chart, one.activity_of)
    if content is None:
        return {}
    if one.activity != "leaf":
        return {state.ssid: state.name for state, _ in _states(content, ())}
    found = list(_leaves(content, ()))
    names = [path[-1] for _, path in found]
    return {state.ssid: path[-1] if names.count(path[-1]) == 1 else "_".join(path) for state, path in found}


def _content(chart: DrawnChart, ssid: int | None) -> DrawnContent | None:
    """What is in a state; of 0 what is in the chart."""
    if not ssid:
        return chart.content
    return next((one.content for one in chart.content.every_state() if one.ssid == ssid), None)


def _states(content: DrawnContent, path: tuple[str, ...]) -> Iterator[tuple[DrawnState, tuple[str, ...]]]:
    """The states of one level with their paths; those in a box are of the level around it."""
    for state in content.states:
        if state.kind == "box":
            yield from _states(state.content, path)
        elif state.kind in ("exclusive", "parallel"):
            yield state, (*path, state.name)


def _leaves(content: DrawnContent, path: tuple[str, ...]) -> Iterator[tuple[DrawnState, tuple[str, ...]]]:
    for state, own in _states(content, path):
        inside = list(_leaves(state.content, own))
        yield from inside or [(state, own)]


def tells_of_regions(chart: DrawnChart, one: DrawnData) -> bool:
    """Whether several of the states that an output tells of may be active together."""
    content, told = _content(chart, one.activity_of), activity_members(chart, one)
    if content is None or one.activity == "self":
        return False
    return any(state.kind == "parallel" and _holds_any(state, told) for state in content.every_state())


def _holds_any(state: DrawnState, told: dict[int, str]) -> bool:
    return state.ssid in told or any(one.ssid in told for one in state.content.every_state())


__all__ = ["NONE", "activity_members", "tells_of_regions"]
