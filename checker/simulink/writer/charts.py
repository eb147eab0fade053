"""Charts to be written into packages: what is drawn in them, before it is XML."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Literal, TypeAlias, TypeVar, Union

from rovercheck.checker.simulink.writer.elements import Values

if TYPE_CHECKING:
    from rovercheck.checker.simulink.writer.systems import WrittenSystem

SCOPES = {
    "input": "INPUT_DATA", "output": "OUTPUT_DATA", "local": "LOCAL_DATA", "constant": "CONSTANT_DATA",
    "parameter": "PARAMETER_DATA", "temporary": "TEMPORARY_DATA", "function input": "FUNCTION_INPUT_DATA",
    "function output": "FUNCTION_OUTPUT_DATA", "data store": "DATA_STORE_MEMORY_DATA",
}  # fmt: skip
NO_ORDER = 4294967295
"""The order of a piece of a wire that has none."""
Holder: TypeAlias = Union["WrittenChart", "WrittenState"]


@dataclass(eq=False)
class WrittenElement:
    """What every element has: ``more`` are further properties, ``inside`` further children with theirs."""

    ssid: int
    holder: Holder
    more: Values = field(default_factory=dict)
    inside: Mapping[str, Values] = field(default_factory=dict)


@dataclass(frozen=True)
class WrittenTable:
    """A truth table: a row for each condition, with its decisions; the last row names the actions."""

    conditions: Sequence[str]
    decisions: Sequence[str]
    """Of each decision a letter for each condition, a blank, and its actions: ``TF- 1``."""
    actions: Sequence[str]


@dataclass(eq=False)
class WrittenState(WrittenElement):
    """A state, a function, a box or a note."""

    type: str = "OR_STATE"
    label: str = ""
    order: int = 0
    parallel: bool = False
    subchart: bool = False
    script: str = ""
    table: "WrittenTable | None" = None
    children: "list[WrittenElement]" = field(default_factory=list)


@dataclass(eq=False)
class WrittenJunction(WrittenElement):
    """A connective junction, or one of history."""

    history: bool = False


Node: TypeAlias = WrittenState | WrittenJunction


@dataclass(eq=False)
class WrittenTransition(WrittenElement):
    """A transition; ``wire`` is SUPER or SUB where it crosses the border of a subchart."""

    source: Node | None = None
    target: Node | None = None
    label: str = ""
    order: int = 1
    inner: bool = False
    wire: Literal["", "SUPER", "SUB"] = ""
    first: int = 0
    link: str = ""


@dataclass(eq=False)
class WrittenData(WrittenElement):
    """A datum; without a ``type`` it has an inherited one."""

    name: str = ""
    scope: str = "LOCAL_DATA"
    type: str = ""
    initial: object = None
    size: str = "-1"
    low: object = None
    high: object = None


@dataclass(eq=False)
class WrittenEvent(WrittenElement):
    """An event."""

    name: str = ""
    scope: str = "LOCAL_EVENT"
    trigger: str = "FUNCTION_CALL_EVENT"


Kind = TypeVar("Kind", bound=WrittenElement)


@dataclass(eq=False)
class WrittenChart:
    """The chart of a block; ``more`` are further properties as they stand in the file."""

    path: str
    number: int
    kind: str = "Chart"
    language: Literal["MATLAB", "C", "C with bit operations"] = "MATLAB"
    parallel: bool = False
    explicit: bool = True
    saturates: bool = True
    script: str = ""
    more: Values = field(default_factory=dict)
    inside: Mapping[str, Values] = field(default_factory=dict)
    children: list[WrittenElement] = field(default_factory=list)
    functions: "dict[str, WrittenSystem]" = field(default_factory=dict)
    """The blocks of its Simulink functions, by their names."""
    last: int = 0
    frames: Mapping[int, tuple[float, float, float, float]] = field(default_factory=dict)
    """Where elements are drawn: left, top, width and height by SSID; others find a place."""

    def __post_init__(self) -> None:
        if self.is_function:
            self.function("eML_blk_kernel()", script=self.script)
            self.transition(None, self.junction(), "{eML_blk_kernel();}")

    @property
    def is_function(self) -> bool:
        """Whether it is a MATLAB function as a block."""
        return self.kind == "MATLAB Function"

    @property
    def function_name(self) -> str:
        """The name of the first function of the script."""
        return self.script.partition("(")[0].rpartition("=")[2].rpartition("function")[2].strip()

    # --- what is drawn -------------------------------------------------------------------------------------

    def state(
        self,
        label: str,
        holder: WrittenState | None = None,
        order: int = 0,
        *,
        parallel: bool = False,
        subchart: bool = False,
        box: bool = False,
        more: Values | None = None,
        inside: Mapping[str, Values] | None = None,
    ) -> WrittenState:
        """A state; an ``order`` makes it a region, ``parallel`` makes regions of its children."""
        kind = "GROUP_STATE" if box else "AND_STATE" if order else "OR_STATE"
        made = WrittenState(self._next(), holder or self, more or {}, inside or {}, kind, label, order)
        made.parallel, made.subchart = parallel, subchart
        return self._add(made)

    def function(
        self,
        label: str,
        holder: WrittenState | None = None,
        script: str = "",
        inside: Mapping[str, Values] | None = None,
    ) -> WrittenState:
        """A graphical function, or with a script one of MATLAB; its arguments are data in it."""
        made = WrittenState(self._next(), holder or self, {}, inside or {}, "FUNC_STATE", label)
        made.script, made.subchart = script, bool(script)
        return self._add(made)

    def truth_table(
        self, label: str, table: WrittenTable, holder: WrittenState | None = None
    ) -> WrittenState:
        """A truth table, without the script or flow chart that Stateflow makes of it."""
        made = self.function(label, holder)
        made.table = table
        return made

    def junction(self, holder: WrittenState | None = None, history: bool = False) -> WrittenJunction:
        """A junction."""
        return self._add(WrittenJunction(self._next(), holder or self, history=history))

    def transition(
        self,
        source: Node | None,
        target: Node | None,
        label: str = "",
        order: int = 1,
        holder: Holder | None = None,
        inner: bool = False,
        more: Values | None = None,
    ) -> WrittenTransition:
        """A transition; a default one has no source, one that dangles no target."""
        if holder is None and inner and isinstance(source, WrittenState):
            holder = source
        made = WrittenTransition(self._next(), holder or self._common(source, target), more or {})
        made.source, made.target, made.label, made.order, made.inner = source, target, label, order, inner
        return self._add(made)

    def crossing(self, source: Node, target: Node, label: str, order: int, *stops: Node) -> None:
        """A transition across borders of subcharts: one SUPER wire, and pieces that repeat it."""
        wire = self.transition(source, target, label, order)
        wire.wire = "SUPER"
        ends = [source, *stops, target]
        pieces = [self.transition(a, b, label, NO_ORDER, wire.holder) for a, b in pairwise(ends)]
        pieces[0].order, wire.first = order, pieces[0].ssid
        numbers = [piece.ssid for piece in pieces]
        for piece, before, after in zip(pieces, [0, *numbers[:-1]], [*numbers[1:], 0], strict=True):
            piece.wire, piece.link = "SUB", f"[{wire.ssid} {before} {after}]"

    def data(
        self,
        name: str,
        scope: str,
        type_: str = "",
        initial: object = None,
        size: str = "-1",
        holder: WrittenState | None = None,
        low: object = None,
        high: object = None,
        more: Values | None = None,
        inside: Mapping[str, Values] | None = None,
    ) -> WrittenData:
        """A datum."""
        made = WrittenData(self._next(), holder or self, more or {}, inside or {}, name, SCOPES[scope], type_)
        made.initial, made.size, made.low, made.high = initial, size, low, high
        return self._add(made)

    def event(
        self,
        name: str,
        scope: str = "LOCAL_EVENT",
        trigger: str = "FUNCTION_CALL_EVENT",
        holder: WrittenState | None = None,
    ) -> WrittenEvent:
        """An event."""
        return self._add(WrittenEvent(self._next(), holder or self, {}, {}, name, scope, trigger))

    def of(self, kind: type[Kind]) -> Iterator[Kind]:
        """The elements of one kind at the top of the chart."""
        return (one for one in self.children if isinstance(one, kind))

    # --- numbers and holders -------------------------------------------------------------------------------

    def _next(self) -> int:
        self.last += 1
        return self.last

    def _add(self, made: Kind) -> Kind:
        made.holder.children.append(made)
        return made

    def _common(self, source: Node | None, target: Node | None) -> Holder:
        """The innermost level that holds both ends."""
        if source is None or target is None:
            end = source or target
            return self if end is None else end.holder
        above = list(_above(target))
        return next(one for one in _above(source) if one in above)


def _above(one: Node) -> Iterator[Holder]:
    holder = one.holder
    yield holder
    if isinstance(holder, WrittenState):
        yield from _above(holder)


__all__ = [
    "Holder", "Node", "WrittenChart", "WrittenData", "WrittenElement", "WrittenEvent", "WrittenJunction",
    "WrittenState", "WrittenTable", "WrittenTransition",
]  # fmt: skip
