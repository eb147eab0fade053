"""What Moore and Mealy charts may have, as far as it is certain what they do with it.

In each step a Moore chart first computes its outputs, by the actions of all active states, and then takes
its transitions; a Mealy chart acts in condition actions alone.
"""

from collections.abc import Iterable, Iterator

from rovercheck.checker.drawn.grammar.actions import Assignment
from rovercheck.checker.drawn.grammar.labels import SectionKind
from rovercheck.checker.drawn.grammar.syntax import Name, parts
from rovercheck.checker.drawn.grammar.trees import assigned_names, expressions_of
from rovercheck.checker.drawn.refused import DrawingNote
from rovercheck.checker.drawn.tree import ParsedChart, StateNode

TIMES = (
    "after", "before", "at", "every", "temporalCount", "elapsed", "count", "duration", "hasChanged",
    "hasChangedTo", "hasChangedFrom", "rising", "falling", "crossing", "in",
)  # fmt: skip
"""What depends on more than the active states."""


def machine_notes(chart: ParsedChart) -> list[DrawingNote]:
    """Why a Moore or a Mealy chart has no meaning here."""
    if chart.drawn.machine == "classic":
        return []
    rules = _moore(chart) if chart.drawn.machine == "Moore" else _mealy(chart)
    return [
        DrawingNote("refused", where, what, f"{text}.", chart.drawn.part, ssid, line)
        for where, what, text, ssid, line in rules
    ]


Broken = tuple[str, str, str, int | None, int]
"""Where a rule is broken, by what, why, and the number and the line of that."""


def _mealy(chart: ParsedChart) -> Iterator[Broken]:
    for node in chart.root.every():
        if node.sections or node.on_events:
            yield _of_state(node, "a state of a Mealy chart has no actions. Act on its transitions")
    for one in chart.transitions:
        if one.label.transition_actions and isinstance(one.source, StateNode | None):
            text = "a Mealy chart acts in condition actions, {...}, alone. Write it as one"
            yield one.holder.path, str(one).partition(" (SSID")[0], text, one.drawn.ssid, one.drawn.line


def _moore(chart: ParsedChart) -> Iterator[Broken]:
    drawn, root = chart.drawn, chart.root
    if not drawn.at_initialization:
        yield _of_chart(
            chart,
            "it is a Moore chart that is entered in its first step, and whether it gives the outputs of its "
            "first state then is not known here. Let it be entered at initialization",
        )
    if any(node.functions for node in root.every()):
        yield _of_chart(chart, "a Moore chart has no functions. Write what they do into its states")
    if any(node.events for node in root.every()):
        yield _of_chart(chart, "a Moore chart has no events here. Make them data")
    if any(one.activity_of is not None for one in root.data.values()):
        yield _of_chart(
            chart, "it is not known here whether a Moore chart tells which state is active before or after "
            "its transitions. Write an output in each state",
        )  # fmt: skip
    for one in chart.transitions:
        label = one.label
        if label.condition_actions or label.transition_actions:
            text = "a transition of a Moore chart has no actions. Write them into its states"
            yield one.holder.path, str(one).partition(" (SSID")[0], text, one.drawn.ssid, one.drawn.line
    yield from (broken for node in root.every() for broken in _moore_state(node))
    missing = {n for n, one in root.data.items() if one.scope == "output"} - _always_written(root)
    if missing and not drawn.initializes_outputs:
        yield _of_chart(
            chart,
            f"not every state writes the output {min(missing)}, which a Moore chart computes of its active "
            "states alone. Write it in each, or let outputs begin anew whenever the chart wakes up",
        )


def _moore_state(node: StateNode) -> Iterator[Broken]:
    if node.on_events or node.sections.keys() - {SectionKind.STATE}:
        yield _of_state(node, "the actions of a Moore chart have no keyword, as entry. Write them without")
    actions = node.sections.get(SectionKind.STATE, ())
    used = set(_names(actions))
    inputs = sorted(used & {name for name, scope in _scopes(node).items() if scope == "input"})
    if inputs:
        yield _of_state(node, f"it reads the input {inputs[0]}. Its transitions may")
    timed = sorted(used & {*TIMES})
    if timed:
        yield _of_state(node, f"it asks for {timed[0]}, in an action of a Moore chart. Ask in a transition")
    own = _touched(node)
    for other in [one for one in node.every() if one is not node] + _beside(node):
        shared = sorted(own & _touched(other) & _changed([node, other]))
        if shared:
            yield _of_state(
                node,
                f"it and {other.path} use {shared[0]}, which one of them writes, and both may be active. "
                "Give each data of its own",
            )


def _beside(node: StateNode) -> list[StateNode]:
    """What is in the regions after one beside which it is."""
    if node.parent is None or not node.parent.parallel:
        return []
    later = node.parent.children[node.parent.children.index(node) + 1 :]
    return [one for region in later for one in region.every()]


def _always_written(node: StateNode) -> set[str]:
    """The data that are written whenever a state is active, by it or by what is active in it."""
    own = set[str]()
    for one in node.sections.get(SectionKind.STATE, ()):
        if isinstance(one, Assignment) and one.operator is None:
            own |= {target.name for target in one.targets if isinstance(target, Name)}
    inside = [_always_written(child) for child in node.children]
    if not inside:
        return own
    return own | (set.union(*inside) if node.parallel else set.intersection(*inside))


def _changed(nodes: Iterable[StateNode]) -> set[str]:
    return {name for node in nodes for name in assigned_names(node.sections.get(SectionKind.STATE, ()))}


def _touched(node: StateNode) -> set[str]:
    """The data that the actions of a state read or write."""
    actions = node.sections.get(SectionKind.STATE, ())
    return ({*_names(actions)} | {*assigned_names(actions)}) & {*_scopes(node)}


def _names(actions: object) -> Iterator[str]:
    for expression in expressions_of(actions):
        for part in parts(expression):
            if isinstance(part, Name):
                yield part.name


def _scopes(node: StateNode) -> dict[str, str]:
    """The data that a state sees by name, with their scopes."""
    return {name: one.scope for around in [*node.lineage()][::-1] for name, one in around.data.items()}


def _of_state(node: StateNode, text: str) -> Broken:
    where = "" if node.parent is None else node.parent.path
    return where, f"the state {node.name}", text, node.ssid, node.line


def _of_chart(chart: ParsedChart, text: str) -> Broken:
    return chart.drawn.path, "the chart", text, None, 0


__all__ = ["machine_notes"]
