"""A chart as a tree of states: who is in whom, and which transitions are tried in which order."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.drawn.grammar.actions import ActionStatement
from rovercheck.checker.drawn.grammar.functions import FunctionSignature, ScriptFunction
from rovercheck.checker.drawn.grammar.labels import SectionKind, TransitionLabel
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage, Expression
from rovercheck.checker.drawn.records import DrawnChart, DrawnData, DrawnEvent, DrawnState, DrawnTransition
from rovercheck.checker.drawn.refused import DrawingNote, label_of


@dataclass(eq=False)
class JunctionNode:
    """A junction with the transitions that leave it, in their order."""

    ssid: int
    holder: "StateNode"
    history: bool
    outgoing: list["TransitionNode"] = field(default_factory=list)


@dataclass(eq=False)
class TransitionNode:
    """A transition; ``holder`` is the state, or the chart, that it is drawn in."""

    drawn: DrawnTransition
    label: TransitionLabel
    holder: "StateNode"
    source: "StateNode | JunctionNode | None" = None
    target: "StateNode | JunctionNode | None" = None

    def __str__(self) -> str:
        return f"the transition `{label_of(self.drawn)}` (SSID {self.drawn.ssid}) in {self.holder.path}"


@dataclass(eq=False)
class StateNode:
    """A state, or the chart as a whole, which has no parent.

    ``children`` are its states, regions in their order; those in a box are of the level above.
    """

    ssid: int
    name: str
    path: str
    parent: "StateNode | None"
    parallel: bool = False
    order: int = 0
    children: list["StateNode"] = field(default_factory=list)
    sections: Mapping[SectionKind, Sequence[ActionStatement]] = field(default_factory=dict)
    on_events: Sequence[tuple[Expression, Sequence[ActionStatement]]] = ()
    outer: list[TransitionNode] = field(default_factory=list)
    inner: list[TransitionNode] = field(default_factory=list)
    defaults: list[TransitionNode] = field(default_factory=list)
    history: JunctionNode | None = None
    data: Mapping[str, DrawnData] = field(default_factory=dict)
    events: Mapping[str, DrawnEvent] = field(default_factory=dict)
    functions: dict[str, "FunctionNode"] = field(default_factory=dict)
    line: int = 0
    label: str = ""

    def lineage(self) -> Iterator["StateNode"]:
        """This state and those that it is in, up to the chart."""
        node: StateNode | None = self
        while node is not None:
            yield node
            node = node.parent

    def every(self) -> Iterator["StateNode"]:
        """This state and all in it, outer ones first."""
        yield self
        for child in self.children:
            yield from child.every()


def output_events(root: StateNode) -> list[DrawnEvent]:
    """The events of a chart to other blocks, in the order of their ports, which follow those of its data."""
    return [one for one in root.events.values() if one.scope == "output"]


@dataclass(eq=False)
class FunctionNode:
    """A function of a chart: its script, or its flow chart, the transitions that begin it."""

    drawn: DrawnState
    signature: FunctionSignature
    holder: StateNode
    script: tuple[ScriptFunction, ...] = ()
    flow: StateNode | None = None
    data: Mapping[str, DrawnData] = field(default_factory=dict)


@dataclass(eq=False)
class ParsedChart:
    """A chart with all of its texts parsed; ``notes`` tell of texts that cannot be."""

    drawn: DrawnChart
    language: ActionLanguage
    root: StateNode
    states: Mapping[int, StateNode]
    junctions: Mapping[int, JunctionNode]
    transitions: Sequence[TransitionNode]
    notes: Sequence[DrawingNote] = ()


__all__ = [
    "FunctionNode", "JunctionNode", "ParsedChart", "StateNode", "TransitionNode", "output_events",
]  # fmt: skip
