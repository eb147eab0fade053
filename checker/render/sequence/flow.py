"""Who talks to whom: which part of a system computes a variable, and which other part reads it.

A *lifeline* is a board where subsystems have names, else a chart.  Blocks outside them (links, sensors)
carry values: what they hand on comes from where its content comes from.  Inputs come from the environment.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.walk import variables

ENVIRONMENT = "Environment"
Names = frozenset[str]


@dataclass(frozen=True)
class FlowPiece:
    """A chart or block, in execution order, and the lifeline it belongs to (none: it carries values)."""

    part: Chart | Block
    owner: str
    enabled: Names = frozenset()

    @property
    def reads(self) -> Names:
        """What the part reads, and what decides whether it executes."""
        return frozenset(self.part.read) | self.enabled

    @property
    def writes(self) -> Names:
        locations = {v.name for v in self.part.locations} if isinstance(self.part, Chart) else set()
        return frozenset(self.part.written) | locations


@dataclass(frozen=True)
class FlowSource:
    """Where a carrier takes a variable from: what is assigned, and the conditions of the assignment."""

    content: Names
    conditions: Names


@dataclass(frozen=True)
class SequenceFlow:
    """The parts of a system, and the inputs of its ticks."""

    pieces: tuple[FlowPiece, ...]
    inputs: Names

    @cached_property
    def lifelines(self) -> tuple[str, ...]:
        """The environment, then the owners in execution order."""
        return tuple(dict.fromkeys((ENVIRONMENT, *(p.owner for p in self.pieces if p.owner))))

    @cached_property
    def writers(self) -> Mapping[str, tuple[FlowPiece, ...]]:
        """By variable, the parts that write it."""
        found: dict[str, tuple[FlowPiece, ...]] = {}
        for piece in self.pieces:
            for name in piece.writes:
                found[name] = (*found.get(name, ()), piece)
        return found

    @cached_property
    def sources(self) -> tuple[str, ...]:
        """The carriers that hand on inputs: sensors, the operator; ``IMU.age`` is part of ``IMU``."""
        own = (p for p in self.pieces if not p.owner)
        return tuple(dict.fromkeys(_top(p) for p in own if any(map(self._external, p.writes))))

    def source(self, name: str) -> str:
        """The carrier that hands on an input, or the environment."""
        carriers = [_top(p) for p in self.writers.get(name, ()) if not p.owner]
        return carriers[0] if carriers else ENVIRONMENT

    def _external(self, name: str) -> bool:
        return self.origins(name) == {ENVIRONMENT}

    def place(self, name: str) -> int:
        """When in a tick the variable is written: the index of the first part that writes it, -1 for none."""
        return self.pieces.index(self.writers[name][0]) if name in self.writers else -1

    def readers(self, name: str) -> Names:
        """The lifelines that read the variable."""
        return frozenset(p.owner for p in self.pieces if p.owner and name in p.reads)

    @cached_property
    def _sources(self) -> dict[str, list[FlowSource]]:
        """By variable, what the carriers assign to it."""
        found: dict[str, list[FlowSource]] = {}
        for piece in self.pieces:
            if not piece.owner and isinstance(piece.part, Block):
                for name, source in _assigned(piece.part.do, frozenset()):
                    found.setdefault(name, []).append(source)
        return found

    def counts(self, name: str) -> bool:
        """Whether a carrier makes the next value of the variable of its own: the age of something."""
        return any(name in source.content for source in self._sources.get(name, []))

    @cached_property
    def _origins(self) -> dict[str, Names]:
        return {}

    def origins(self, name: str, seen: Names = frozenset()) -> Names:
        """The lifelines that a value of the variable comes from; none if it is made of constants."""
        if name in self._origins or name in seen:
            return self._origins.get(name, frozenset())
        found = self._traced(name, seen | {name})
        if not seen:
            self._origins[name] = found
        return found

    def _traced(self, name: str, seen: Names) -> Names:
        owners = frozenset(p.owner for p in self.writers.get(name, ()) if p.owner)
        if owners or name not in self.writers:
            return owners or (frozenset({ENVIRONMENT}) if name in self.inputs else frozenset())
        sources = self._sources.get(name, [])
        content = self._of(sources, "content", seen)
        theirs = content - {ENVIRONMENT} or self._beside(name, seen)
        return theirs or content or self._of(sources, "conditions", seen)

    def _of(self, sources: Sequence[FlowSource], what: str, seen: Names) -> Names:
        names = {n for source in sources for n in getattr(source, what)}
        return frozenset(o for n in sorted(names) for o in self.origins(n, seen))

    def _beside(self, name: str, seen: Names) -> Names:
        """Whose content the carriers of a flag hand on along with it."""
        beside = {n for piece in self.writers[name] for n in piece.writes} - seen
        sources = [s for n in sorted(beside) for s in self._sources.get(n, [])]
        return self._of(sources, "content", seen | beside) - {ENVIRONMENT}


def _top(piece: FlowPiece) -> str:
    return piece.part.name.partition(".")[0]


def flow(trace: Trace, *, everything: bool = False) -> SequenceFlow:
    """The flow between the parts that the property depends on, where that is known, or between all."""
    components = trace.system.components or tuple(trace.system.statecharts.values())
    boards = any(isinstance(c, Enabled) and c.name for c in _nested(components))
    pieces = list(_pieces(components, "", boards, frozenset()))
    if trace.property.relevant and not everything:
        pieces = [
            p for p in pieces if p.part.name in trace.property.charts or p.writes & trace.property.relevant
        ]
    return SequenceFlow(tuple(_with_devices(pieces)), frozenset(trace.system.inputs))


def _nested(components: Sequence[Component]) -> Iterator[Component]:
    for component in components:
        yield component
        if isinstance(component, Enabled):
            yield from _nested(component.components)


def _pieces(components: Sequence[Component], owner: str, boards: bool, by: Names) -> Iterator[FlowPiece]:
    for component in components:
        match component:
            case Enabled():
                inside = by | frozenset(variables(component.by))
                yield from _pieces(component.components, owner or component.name, boards, inside)
            case Chart():
                yield FlowPiece(component, owner if boards else component.name, by)
            case Block():
                yield FlowPiece(component, owner, by)


def _with_devices(pieces: Sequence[FlowPiece]) -> Iterator[FlowPiece]:
    """A block that takes values from lifelines and hands nothing on is a lifeline of its own."""
    made = {name for piece in pieces if piece.owner for name in piece.writes}
    for piece in pieces:
        others = {n for p in pieces if p.part is not piece.part for n in p.reads}
        last = not piece.owner and piece.reads & made and not piece.writes & others
        yield FlowPiece(piece.part, piece.part.name, piece.enabled) if last else piece


def _assigned(actions: Sequence[Action], under: Names) -> Iterator[tuple[str, FlowSource]]:
    for action in actions:
        if isinstance(action, Assign):
            content = frozenset(variables(action.value))
            yield action.var.name, FlowSource(content, under)
        elif isinstance(action, If):
            inside = under | frozenset(variables(action.condition))
            yield from _assigned(action.then, inside)
            yield from _assigned(action.otherwise, inside)
