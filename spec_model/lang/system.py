"""Systems: the charts executed in order in one tick, and the transition system they lower to.

``System`` is what people write: components in execution order, what is frozen, what is assumed.
``TransitionSystem`` is what engines read: finite variables and a ``step``, a structured program
that maps the state before a tick and the inputs of the tick to the state after it.
All nondeterminism is an input or a frozen variable.
"""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, parts
from rovercheck.spec_model.lang.errors import ModelError, several
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, all_of
from rovercheck.spec_model.lang.place import Place, here
from rovercheck.spec_model.lang.walk import variables

Valuation = Mapping[str, int]
"""A raw value for every variable, by name."""

Statement = Assign | If
"""A statement of a step: no sends, no temporal words."""

Program = tuple[Statement, ...]

TICK_MS = 20


class Note(str):
    """A note on a system of which ``brief`` is said beside every proof about it, ``of_runs`` beside a run.

    >>> Note("An update carries the time of the step that sees it.", brief="stamps on the steps").brief
    'stamps on the steps'
    """

    brief: str
    of_runs: str

    def __new__(cls, text: str, brief: str, of_runs: str = "") -> "Note":
        note = super().__new__(cls, text)
        note.brief, note.of_runs = brief, of_runs
        return note

    def __reduce__(self) -> tuple[type["Note"], tuple[str, str, str]]:
        return Note, (str(self), self.brief, self.of_runs)


@dataclass(frozen=True)
class Assumption:
    """What a system takes for granted of its environment: an id, in words, and as a formula.

    The formula restricts the inputs of a tick and may read the state before the tick.
    """

    id: str
    text: str
    formula: Expr


FREE = "~free"
"""What the name of a system ends with whose timers may expire at any time."""


@dataclass(frozen=True)
class System:
    """Components executed in order in every tick.

    ``assume`` restricts the inputs of a tick (it may read the state before the tick), and so do the
    ``assumptions``, which have names and can be dropped one by one; ``notes``
    say in words what the system abstracts and assumes; ``over`` and ``under`` say whether it has
    more or fewer behaviours than the specification.  ``concrete`` names the system that a violation
    found on an over-approximation must be reproduced on.  A tick is ``tick_ms`` long; the temporal words
    of charts count executed steps of ``step_ms``, by default a tick: it is longer where the charts execute
    in few of the ticks.  ``elapsed`` is the input that says how many ms have passed since the tick
    before, where ticks last unlike times: ``tick_ms`` is then what one should last.  Only ``held``, and the
    lengths of time of properties, are measured by it; the timers of states count executed steps, as Stateflow
    does.  ``place`` is where it is written.
    """

    name: str
    components: tuple[Component, ...]
    text: str = ""
    frozen: tuple[Var, ...] = ()
    assume: Expr = TRUE
    notes: tuple[str, ...] = ()
    tick_ms: int = TICK_MS
    step_ms: int = 0
    over: bool = False
    under: bool = False
    concrete: str = ""
    assumptions: tuple[Assumption, ...] = ()
    elapsed: Var | None = None
    place: Place | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        if self.place is None:
            object.__setattr__(self, "place", here())
        if not self.step_ms:
            object.__setattr__(self, "step_ms", self.tick_ms)

    @property
    def limited_to(self) -> str:
        """What is to be said beside every proof about the system, in a few words; often nothing."""
        return ", ".join(note.brief for note in self.notes if isinstance(note, Note))

    @property
    def doubted_for(self) -> str:
        """What is to be said beside every run of the system: why it may be none of what is modelled."""
        return ", ".join(note.of_runs for note in self.notes if isinstance(note, Note) and note.of_runs)

    @property
    def assumed(self) -> Expr:
        """Everything that restricts the inputs of a tick."""
        return all_of(self.assume, *(a.formula for a in self.assumptions))

    def without(self, dropped: Collection[str]) -> "System":
        """The system without the assumptions of these ids, which has more runs; itself if it has none."""
        kept = tuple(a for a in self.assumptions if a.id not in dropped)
        return self if len(kept) == len(self.assumptions) else replace(self, assumptions=kept)

    @property
    def charts(self) -> tuple[Chart, ...]:
        return tuple(p for p in parts(self.components) if isinstance(p, Chart))

    @property
    def blocks(self) -> tuple[Block, ...]:
        return tuple(p for p in parts(self.components) if isinstance(p, Block))

    @property
    def written(self) -> dict[str, Var]:
        """Data written by some component, by name."""
        found: dict[str, Var] = {}
        for part in parts(self.components):
            found |= part.written
        return found

    @property
    def inputs(self) -> dict[str, Var]:
        """Data read by some component and written by none, except frozen data, by name."""
        found = variables(self.assumed)
        for part in parts(self.components):
            found |= part.read
        for enabled in enabled_in(self.components):
            found |= variables(enabled.by)
        if self.elapsed is not None:
            found |= variables(self.elapsed)
        own = {v.name for c in self.charts for v in (*c.locations, c.entered)}
        hidden = {v.name for v in self.frozen} | set(self.written) | own
        return {name: v for name, v in found.items() if name not in hidden}


def charts_of(by_name: Mapping[str, System]) -> dict[str, Chart]:
    """The charts of systems by name: of charts with one name in several systems, the first listed."""
    found: dict[str, Chart] = {}
    for system in by_name.values():
        for chart in system.charts:
            found.setdefault(chart.name, chart)
    return found


def chart_alone(chart: Chart, by_name: Mapping[str, System], notes: Sequence[str] = ()) -> System:
    """A chart as a system of its own, with ticks and steps as in the first system that has it."""
    home = next((one for one in by_name.values() if chart in one.charts), None)
    alone = in_order(chart.name, chart, text=chart.text, notes=notes)
    return alone if home is None else replace(alone, tick_ms=home.tick_ms, step_ms=home.step_ms)


def enabled_in(components: Sequence[Component]) -> Iterator[Enabled]:
    """The enabled subsystems, nested ones too."""
    for component in components:
        if isinstance(component, Enabled):
            yield component
            yield from enabled_in(component.components)


def in_order(
    name: str,
    *components: Component,
    text: str = "",
    frozen: Sequence[Var] = (),
    assume: Expr = TRUE,
    notes: Sequence[str] = (),
    over: bool = False,
    under: bool = False,
    concrete: str = "",
    tick_ms: int = TICK_MS,
    assumptions: Sequence[Assumption] = (),
    step_ms: int = 0,
    elapsed: Var | None = None,
) -> System:
    """A system whose components run in the order given, once per tick, by default of 20 ms.

    Times in charts are counted in executed steps of ``step_ms``, by default those of a tick; ``elapsed`` is
    the input that says how long each tick lasts, where that varies.  Raises ``ModelError`` where
    something else stands for a list.
    """
    return System(
        name,
        tuple(components),
        text,
        frozen=several(name, "frozen", frozen),
        assume=assume,
        notes=several(name, "notes", notes),
        tick_ms=tick_ms,
        step_ms=step_ms,
        over=over,
        under=under,
        concrete=concrete,
        assumptions=several(name, "assumptions", assumptions),
        elapsed=elapsed,
    )


@dataclass(frozen=True)
class TransitionSystem:
    """A finite transition system.

    inputs     free in every tick, each within its domain and all together within ``assume``
    frozen     free once, before the first tick, then constant
    variables  everything ``step`` writes (temporaries excluded); ``init`` of each is its value
               before the first tick
    temps      written before being read in every tick; they are no part of a state
    step       the program of one tick
    assume     condition on the inputs of a tick, read before ``step`` runs
    elapsed    the input that says how many ms a tick lasts, where that varies
    checks     conditions that must hold after every tick for the model to have a meaning: each is a
               boolean variable of the system that is 1 when broken, and the sentence to show
    """

    name: str
    inputs: tuple[Var, ...]
    frozen: tuple[Var, ...]
    variables: tuple[Var, ...]
    temps: tuple[Var, ...]
    step: Program
    assume: Expr = TRUE
    checks: tuple[tuple[Var, str], ...] = ()
    tick_ms: int = TICK_MS
    notes: tuple[str, ...] = ()
    elapsed: Var | None = None
    source: System | None = field(default=None, compare=False)

    def __post_init__(self) -> None:
        names = [v.name for of in (self.inputs, self.frozen, self.variables, self.temps) for v in of]
        if len(set(names)) < len(names):
            twice = next(name for name, count in Counter(names).items() if count > 1)
            raise ModelError(
                f"{self.name}: two variables would be named {twice}, one of them made by rovercheck; "
                "rename the one in the model."
            )

    @property
    def init(self) -> dict[str, int]:
        """The state before the first tick, frozen variables left out."""
        return {v.name: v.init for v in self.variables}

    def var(self, name: str) -> Var:
        """The variable, input or frozen variable of that name.  Raises ``KeyError``."""
        for v in (*self.variables, *self.inputs, *self.frozen):
            if v.name == name:
                return v
        raise KeyError(name)
