"""Where the branches of a flow chart come together again, so that what follows is written once.

Without that a loop of n turns with two branches in it has 2 ** n paths.
"""

from collections.abc import Mapping

from rovercheck.checker.drawn.parsed import JunctionNode, StateNode, TransitionNode

_Node = JunctionNode | None
"""A junction, or the end of the search, whether it found something or not."""


def joints_of(flow: StateNode) -> Mapping[JunctionNode, JunctionNode]:
    """By junction of a flow chart the next one that each path from it goes through.

    A junction from which a search may go back to an earlier one has none.
    """
    reached = _reached(flow)
    sure = _never_left_back(reached)
    next_ = {one: _following(one, sure) for one in reached}
    through = _post_dominators(next_)
    found = {}
    for one, every in through.items():
        later = [other for other in every if other is not one and other is not None]
        if later and one is not None and None in every:
            found[one] = max(later, key=lambda other: len(through[other]))
    return found


def _reached(flow: StateNode) -> list[JunctionNode]:
    found: list[JunctionNode] = []
    waiting = [one.target for one in flow.defaults]
    while waiting:
        one = waiting.pop()
        if isinstance(one, JunctionNode) and one not in found:
            found.append(one)
            waiting += [transition.target for transition in one.outgoing]
    return found


def _is_plain(one: TransitionNode) -> bool:
    return one.label.guard is None and not one.label.events and one.target is not None


def _never_left_back(reached: list[JunctionNode]) -> set[JunctionNode]:
    """The junctions from which a search finds a way on, or ends, in any case."""
    sure = set(reached)
    while True:
        lost = {
            one
            for one in sure
            if one.outgoing
            and not any(
                _is_plain(way) and (not isinstance(way.target, JunctionNode) or way.target in sure)
                for way in one.outgoing
            )
        }
        if not lost:
            return sure
        sure -= lost


def _following(one: JunctionNode, sure: set[JunctionNode]) -> set[_Node]:
    found: set[_Node] = set() if one in sure and one.outgoing else {None}
    for way in one.outgoing:
        if way.target is not None:
            found.add(way.target if isinstance(way.target, JunctionNode) else None)
    return found


def _post_dominators(next_: Mapping[JunctionNode, set[_Node]]) -> dict[_Node, set[_Node]]:
    """By node all that each path from it to the end goes through."""
    every: set[_Node] = {*next_, None}
    through: dict[_Node, set[_Node]] = {one: set(every) for one in next_}
    through[None] = {None}
    changed = True
    while changed:
        changed = False
        for one, following in next_.items():
            made = {one} | set.intersection(*(through[other] for other in following))
            if made != through[one]:
                through[one], changed = made, True
    return through


__all__ = ["joints_of"]
