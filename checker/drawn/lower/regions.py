"""Which regions need a variable each, as something may be done while only some of them are active.

Regions are entered and left one by one.  That shows only where something looks meanwhile: an action of
entering or leaving, or of a transition between regions, that asks ``in(S)`` or sends an event, which is
answered then.
"""

from collections.abc import Iterator

from rovercheck.checker.drawn.grammar.labels import SectionKind
from rovercheck.checker.drawn.grammar.syntax import Member, Name, parts
from rovercheck.checker.drawn.grammar.trees import expressions_of
from rovercheck.checker.drawn.parsed import JunctionNode, ParsedChart, StateNode


def sends(chart: ParsedChart) -> bool:
    """Whether a chart may send an event to itself."""
    return any(True for _ in _events(chart))


def seen_in_part(chart: ParsedChart, node: StateNode) -> bool:
    """Whether something may look while only some regions of a state are active."""
    if left_in_part(chart, node):
        return True
    looking = _looking(chart)
    return any(_named(one) & looking for one in _entering_and_leaving(chart, node))


def left_in_part(chart: ParsedChart, node: StateNode) -> bool:
    """Whether a transition may leave regions of a state, and not the state itself."""
    for one in chart.transitions:
        source, target = _child_around(node, one.source), _child_around(node, one.target)
        if one.holder is node or (source is not None and target is not None and source is not target):
            return True
    return False


def _entering_and_leaving(chart: ParsedChart, node: StateNode) -> Iterator[object]:
    """What is done while a state and all in it is entered or left."""
    inside = list(node.every())
    for one in inside:
        yield from (one.sections.get(kind, ()) for kind in (SectionKind.ENTRY, SectionKind.EXIT))
    for drawn in chart.transitions:
        if drawn.holder in inside and not isinstance(drawn.source, StateNode):
            yield drawn.label


def _child_around(node: StateNode, end: StateNode | JunctionNode | None) -> StateNode | None:
    """The child of a state that holds an end of a transition, if one does."""
    holder = end.holder if isinstance(end, JunctionNode) else end
    below = None
    for one in [] if holder is None else holder.lineage():
        if one is node:
            return below
        below = one
    return None


def _events(chart: ParsedChart) -> Iterator[str]:
    for node in chart.root.every():
        yield from (one.name for one in node.events.values() if one.scope == "local")


def _looking(chart: ParsedChart) -> set[str]:
    """The names with which a text asks for active states or sends an event, and those of such functions."""
    found = {"in", "send", *_events(chart)}
    functions = [one for node in chart.root.every() for one in node.functions.values()]
    while True:
        more = {one.signature.name for one in functions if one.flow is not None or _named(one.script) & found}
        if more <= found:
            return found
        found |= more


def _named(text: object) -> set[str]:
    """All names in a text."""
    every = (part for one in expressions_of(text) for part in parts(one))
    return {part.name for part in every if isinstance(part, Name | Member)}


__all__ = ["left_in_part", "seen_in_part", "sends"]
