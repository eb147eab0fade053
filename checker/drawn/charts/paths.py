"""Complete paths of a drawn chart: where one leaves or enters other states than a chart of ours would."""

from collections.abc import Iterator, Sequence

from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.lower.transitions import around_all
from rovercheck.checker.drawn.parsed import JunctionNode, ParsedChart, StateNode, TransitionNode

MOST_PATHS = 50_000
"""Paths of a chart that are looked at one by one."""
DrawnPath = tuple[TransitionNode, ...]


def paths_from(transitions: Sequence[TransitionNode]) -> Iterator[DrawnPath]:
    """All paths that begin with some transitions, to a state or to a dead end.

    Raises ``NotLowered`` for a loop of junctions, and for too many paths.
    """
    waiting: list[DrawnPath] = [(one,) for one in reversed(transitions)]
    count = 0
    while waiting:
        path = waiting.pop()
        end = path[-1].target
        if isinstance(end, JunctionNode) and end.outgoing:
            if any(one.target is end for one in path[:-1]):
                raise NotLowered(f"{path[-1]}: junctions lead in a circle")
            waiting += [(*path, one) for one in reversed(end.outgoing)]
            continue
        count += 1
        if count > MOST_PATHS:
            raise NotLowered(f"{path[0]}: more than {MOST_PATHS:,} paths begin with it")
        yield path


def ends_in_state(path: DrawnPath) -> bool:
    """Whether a path leads to a state, or to a history junction in one."""
    end = path[-1].target
    return isinstance(end, StateNode) or (isinstance(end, JunctionNode) and end.history)


def end_of(path: DrawnPath) -> StateNode:
    """The state that a complete path leads to."""
    end = path[-1].target
    assert end is not None
    if isinstance(end, JunctionNode):
        return end.holder
    return behind_border(path[-1]) or end


def behind_border(one: TransitionNode) -> StateNode | None:
    """The state that a transition from inside a state to its border enters, if it is always the same."""
    end = one.target
    if not isinstance(end, StateNode) or end not in one.holder.lineage() or end.history or end.parallel:
        return None
    match end.defaults:
        case [TransitionNode(target=StateNode() as first) as only] if first is not end:
            label = only.label
            silent = not (label.events or label.condition_actions or label.transition_actions)
            return first if silent and label.guard is None else None
    return None


def refuse_other_scopes(chart: ParsedChart) -> None:
    """Raises ``NotLowered`` for a path that leaves or enters more, or less, than a chart of the language."""
    for node in chart.root.every():
        for path in paths_from(node.outer):
            if ends_in_state(path):
                _refuse_scope(chart.root, node, path)
                _refuse_reentry(chart.root, node, path)


def _refuse_scope(root: StateNode, source: StateNode, path: DrawnPath) -> None:
    around, target = around_all(root, path), end_of(path)
    if around is target:
        raise NotLowered(
            f"{path[-1]}: it leads from inside {target.path} to its border, so that it stays active: draw it "
            "to one of its states"
        )
    if around is not _common(source, target):
        raise NotLowered(
            f"{path[-1]}: it is drawn so that {around.path} stays active, and no further state: draw all "
            "of it inside the innermost state that holds both of its ends"
        )


def _common(source: StateNode, target: StateNode) -> StateNode:
    """The innermost state with both ends inside it."""
    outside = list(source.lineage())[1:]
    around = set(map(id, list(target.lineage())[1:]))
    return next(one for one in outside if id(one) in around)


def _refuse_reentry(root: StateNode, source: StateNode, path: DrawnPath) -> None:
    """A region whose transition leaves the state of the regions and enters it again."""
    around, target = around_all(root, path), end_of(path)
    inside = {id(one) for one in target.lineage()} | {id(one) for one in target.every()}
    for node in source.lineage():
        if node is around or node.parent is None:
            return
        parent = node.parent
        again = id(parent) in inside and parent is not around and around in list(parent.lineage())
        if parent.parallel and again and parent.children[-1] is not node:
            raise NotLowered(
                f"{path[-1]}: it leaves {parent.path} from one of its regions and enters it again, while "
                "later regions are still to be executed: let the last region do it"
            )


def refuse_dead_ends(transitions: Sequence[TransitionNode]) -> None:
    """Raises ``NotLowered`` for a dead end behind which those of an earlier junction would be tested."""
    for path in paths_from(transitions):
        if path[-1].target is None or ends_in_state(path):
            continue
        begun = transitions
        for one in path[:-1]:
            if begun[-1] is not one:
                raise NotLowered(f"{path[-1]}: {DEAD_END}")
            begun = one.target.outgoing if isinstance(one.target, JunctionNode) else begun


DEAD_END = (
    "it leads to a dead end, at which Stateflow stops, before transitions that a chart of the language would "
    "go on to: draw it last, or its action as a during action"
)


def is_dead_end(one: TransitionNode) -> bool:
    """Whether a transition leads to a junction that nothing leaves."""
    return isinstance(one.target, JunctionNode) and not one.target.history and not one.target.outgoing


__all__ = [
    "DEAD_END", "DrawnPath", "behind_border", "end_of", "ends_in_state", "is_dead_end", "paths_from",
    "refuse_dead_ends", "refuse_other_scopes",
]  # fmt: skip
