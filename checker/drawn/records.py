"""What stands in a file of charts, before anything is said of its meaning.

Texts are those of the file: labels, scripts, types, sizes and values are parsed elsewhere.  An ``ssid`` is
the number of an element, unique in its chart; points and rectangles are those of the drawing, y downwards.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal

Point = tuple[float, float]
Rectangle = tuple[float, float, float, float]
"""Left, top, width and height."""

ChartLanguage = Literal["MATLAB", "C", "C with bit operations"]
DrawnChartKind = Literal["chart", "MATLAB function", "truth table", "state transition table"]
DrawnStateKind = Literal["exclusive", "parallel", "function", "box", "note"]
DrawnFunctionKind = Literal["", "graphical", "MATLAB", "truth table", "Simulink"]
DrawnScope = Literal[
    "input", "output", "local", "constant", "parameter", "temporary", "function input", "function output",
    "data store",
]  # fmt: skip
DrawnActivity = Literal["self", "child", "leaf"]
DrawnTrigger = Literal["", "function call", "rising", "falling", "either"]


@dataclass(frozen=True)
class DrawnData:
    """A datum of a chart, a state or a function."""

    ssid: int
    name: str
    scope: DrawnScope
    type: str
    """As written: ``uint8``, ``Enum: Gear``, ``Bus: Cockpit``, ``Inherit: Same as Simulink``."""
    size: str = ""
    """As written; empty or ``-1``: inherited."""
    initial: str = ""
    minimum: str = ""
    maximum: str = ""
    first_index: str = ""
    from_workspace: bool = False
    """Whether its value is that of a name in the workspace, the dictionary or a script."""
    message: bool = False
    """Whether it is a message with a queue."""
    activity_of: int | None = None
    """The state whose activity this output holds; 0 is the chart."""
    activity: DrawnActivity = "self"
    """Whether it is active, which child of it is, or which leaf state in it."""
    line: int = 0


@dataclass(frozen=True)
class DrawnEvent:
    """An event of a chart or a state."""

    ssid: int
    name: str
    scope: Literal["local", "input", "output"]
    trigger: DrawnTrigger = ""
    line: int = 0


@dataclass(frozen=True)
class DrawnJunction:
    """A connective junction, or one that keeps the history of the level it is in."""

    ssid: int
    history: bool = False
    at: Point = (0.0, 0.0)
    line: int = 0


@dataclass(frozen=True)
class DrawnTransition:
    """A transition: ``source`` and ``target`` are states or junctions; a default transition has no source.

    ``inner``: it is drawn inside the state that it leaves.  ``order`` is the number in which it is tested
    among those of its source and kind.
    """

    ssid: int
    source: int | None
    target: int | None
    label: str = ""
    order: int = 0
    inner: bool = False
    points: tuple[Point, ...] = ()
    label_at: Point | None = None
    """The upper left corner of its label."""
    line: int = 0


@dataclass(frozen=True)
class DrawnContent:
    """What is drawn in a chart, a state or a function."""

    states: tuple["DrawnState", ...] = ()
    transitions: tuple[DrawnTransition, ...] = ()
    junctions: tuple[DrawnJunction, ...] = ()
    data: tuple[DrawnData, ...] = ()
    events: tuple[DrawnEvent, ...] = ()

    def every_state(self) -> Iterator["DrawnState"]:
        """The states here and in them, at any depth, functions and boxes too."""
        for state in self.states:
            yield state
            yield from state.content.every_state()

    def every_level(self) -> Iterator["DrawnContent"]:
        """This level and those of the states in it."""
        yield self
        for state in self.every_state():
            yield state.content


@dataclass(frozen=True)
class DrawnTruthTable:
    """A truth table, as written: a row for each of ``conditions``, a column for each of ``decisions``.

    A decision has ``T``, ``F`` or ``-`` for each condition; of ``chosen`` each names the actions of one.
    """

    conditions: tuple[str, ...]
    decisions: tuple[tuple[str, ...], ...]
    chosen: tuple[str, ...]
    actions: tuple[str, ...]


@dataclass(frozen=True)
class DrawnState:
    """A state, a function, a box or a note; ``parallel``: its children are regions.

    ``name`` is the first line of its label.
    """

    ssid: int
    kind: DrawnStateKind
    name: str
    label: str
    content: DrawnContent = DrawnContent()
    parallel: bool = False
    order: int = 0
    subchart: bool = False
    function: DrawnFunctionKind = ""
    script: str = ""
    """Of a MATLAB function its text; of a truth table the one that was made of it."""
    table: DrawnTruthTable | None = None
    """Of a truth table its grid, if the file has it."""
    block: str = ""
    """Of a Simulink function, or an atomic subchart, its block in the block of the chart."""
    atomic: bool = False
    """An atomic subchart: what is in it stands elsewhere."""
    binding: str = ""
    """Of an atomic subchart what its data stand for, as written: lines of an SSID and a name or a value."""
    names: Mapping[str, str] = field(default_factory=dict)
    """The names in it that stand for others around it, as those of an atomic subchart do."""
    action_subsystem: bool = False
    """A state of which a Simulink subsystem is the action."""
    rectangle: Rectangle = (0.0, 0.0, 0.0, 0.0)
    requirement: str = ""
    """A link to a requirement, as written."""
    line: int = 0


@dataclass(frozen=True)
class DrawnChart:
    """A chart, or a MATLAB function as a block.  ``path`` is that of its block below the model."""

    path: str
    kind: DrawnChartKind
    language: ChartLanguage
    content: DrawnContent
    part: str
    """The part of the file that it stands in."""
    id: int = 0
    parallel: bool = False
    explicit_order: bool = False
    saturates: bool = False
    """Whether integers stop at their ends; else they wrap."""
    at_initialization: bool = False
    """Whether it is entered before the first step."""
    initializes_outputs: bool = False
    """Whether its outputs are set to their initial values whenever it wakes up."""
    super_step: bool = False
    update: Literal["inherited", "discrete", "continuous"] = "inherited"
    sample_time: str = ""
    machine: Literal["classic", "Mealy", "Moore"] = "classic"
    exports_functions: bool = False
    activity_output: str = ""
    """The output that holds which child is active."""
    function: str = ""
    """Of a MATLAB function as a block its name."""

    @property
    def name(self) -> str:
        """The last name of its path."""
        return names_of(self.path)[-1]

    @property
    def shown_path(self) -> str:
        """Its path in one line, for messages."""
        return " ".join(self.path.split())

    @property
    def is_function(self) -> bool:
        """Whether it is one function, a MATLAB function or a truth table, without states."""
        return self.kind in ("MATLAB function", "truth table")


@dataclass(frozen=True)
class DrawnLine:
    """A signal from an output of a block to a port of another one, by their ids.

    ``from_port`` is the number of an output, or 0: the state port.  ``to_port`` is the number of an input, or
    ``enable``, ``trigger``, ``ifaction``, ``state``, ``reset`` or ``event``.
    """

    source: str
    from_port: int
    target: str
    to_port: str


@dataclass(frozen=True)
class DrawnBlock:
    """A block of a diagram, with its parameters as written; what has the default value is not written.

    ``signals`` are the names of its outputs, by number.  ``chart``: it is the chart of that path.
    """

    id: str
    kind: str
    name: str
    path: str
    parameters: Mapping[str, str] = field(default_factory=dict)
    signals: Mapping[str, str] = field(default_factory=dict)
    system: "DrawnSystem | None" = None
    chart: str = ""
    rectangle: Rectangle = (0.0, 0.0, 0.0, 0.0)
    line: int = 0

    def systems(self) -> Iterator["DrawnSystem"]:
        """What is in it: of a subsystem its system, of a chart those of its Simulink functions."""
        if self.system is None:
            return
        if not self.chart:
            yield self.system
            return
        for one in self.system.blocks:
            if one.kind == "SubSystem" and one.system is not None and not one.chart:
                yield one.system

    @property
    def shown(self) -> str:
        """Its name in one line."""
        return " ".join(part for line in self.name.splitlines() if (part := line.strip()))

    @property
    def shown_path(self) -> str:
        """Its path in one line, for messages."""
        return " ".join(self.path.split())


@dataclass(frozen=True)
class DrawnSystem:
    """Blocks and the signals between them."""

    blocks: tuple[DrawnBlock, ...] = ()
    lines: tuple[DrawnLine, ...] = ()
    part: str = ""

    def every_block(self) -> Iterator[DrawnBlock]:
        """The blocks here and in subsystems, at any depth; of those in a chart those of its functions."""
        for block in self.blocks:
            yield block
            for system in block.systems():
                yield from system.every_block()


@dataclass(frozen=True)
class DrawnEnumeration:
    """A type with named values; ``file`` says where it stands."""

    name: str
    members: Mapping[str, int]
    default: str
    storage: str = ""
    file: str = ""


@dataclass(frozen=True)
class DrawnElement:
    """An element of a bus; ``dimensions`` as written."""

    name: str
    type: str
    dimensions: str = "1"


@dataclass(frozen=True)
class DrawnBus:
    """A type with named elements."""

    name: str
    elements: tuple[DrawnElement, ...]
    file: str = ""


@dataclass(frozen=True)
class DrawnParameter:
    """A named value, as written."""

    name: str
    value: str
    type: str = ""
    file: str = ""


@dataclass(frozen=True)
class DrawnModel:
    """A model: its diagram, its charts by their paths, and the types and values that they use."""

    name: str
    format: Literal["simulink"]
    release: str = ""
    step: str = ""
    """Seconds, as written; ``auto`` and an empty text do not say it."""
    solver: str = ""
    system: DrawnSystem = DrawnSystem()
    charts: tuple[DrawnChart, ...] = ()
    enumerations: tuple[DrawnEnumeration, ...] = ()
    buses: tuple[DrawnBus, ...] = ()
    parameters: tuple[DrawnParameter, ...] = ()
    data: tuple[DrawnData, ...] = ()
    """Data of all charts together."""
    free: Mapping[str, str] = field(default_factory=dict)
    """Functions and expressions whose values a person lets be free, with the names that they have there."""
    files: tuple[str, ...] = ()
    """What was read, the model first."""


def names_of(path: str) -> tuple[str, ...]:
    """The names of a path: ``/`` separates them, and is doubled in one.

    >>> names_of("Upper/Door//window")
    ('Upper', 'Door/window')
    """
    return tuple(name.replace("\0", "/") for name in path.replace("//", "\0").split("/"))


def path_of(*names: str) -> str:
    """The path of names, without the empty ones."""
    return "/".join(name.replace("/", "//") for name in names if name)


__all__ = [
    "ChartLanguage", "DrawnActivity", "DrawnBlock", "DrawnBus", "DrawnChart", "DrawnChartKind",
    "DrawnContent", "DrawnData",
    "DrawnElement", "DrawnEnumeration", "DrawnEvent", "DrawnFunctionKind", "DrawnJunction", "DrawnLine",
    "DrawnModel", "DrawnParameter", "DrawnScope", "DrawnState", "DrawnStateKind", "DrawnSystem",
    "DrawnTransition", "DrawnTrigger", "DrawnTruthTable", "Point", "Rectangle", "names_of", "path_of",
]  # fmt: skip
