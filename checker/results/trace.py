"""A trace: the replayed run, tick by tick, with what fired and what the property says."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rovercheck.checker.results.board_test import BoardTest
    from rovercheck.spec_model.lang.chart import Chart, Component
    from rovercheck.spec_model.lang.expr import Expr, Var
    from rovercheck.spec_model.lang.place import Place
    from rovercheck.spec_model.lang.system import TransitionSystem


def counted_ticks(count: int) -> str:
    """``1 tick``, ``8 ticks``."""
    return f"{count} tick{'s' * (count != 1)}"


@dataclass(frozen=True)
class TakenTransition:
    """A transition that fired: its chart, where it starts and ends, and its label as drawn.

    ``order`` is its position among the transitions leaving ``source`` (1 is tested first; 0 for a
    default transition).  ``event`` is the local event during whose processing it fired, if any.
    ``place`` is where it is written.
    """

    chart: str
    source: str
    target: str
    label: str
    order: int
    event: str | None = None
    place: "Place | None" = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        start = f"{self.source} -> {self.target}" if self.order else f"default -> {self.target}"
        number = f" (transition {self.order})" if self.order else ""
        return f"{self.chart}: {start}{number}{' ' + self.label if self.label else ''}"


@dataclass(frozen=True)
class Tick:
    """One tick: its number from 1, its inputs, the state after it and the transitions fired in it."""

    number: int
    inputs: Mapping[str, int]
    after: Mapping[str, int]
    transitions: tuple[TakenTransition, ...] = ()


@dataclass(frozen=True)
class Needed:
    """An input that had to be so: in tick ``number``, ``name`` is one of ``values`` (raw).

    All the needed inputs of a run together force its end, whatever the other inputs are.
    """

    number: int
    name: str
    values: frozenset[int]


@dataclass(frozen=True)
class NecessaryInputs:
    """Inputs that force the end of a run of this length with these frozen values; others may be any.

    ``minimal``: none of them can be left out; otherwise the search was cut short, and some may not matter.
    ``smallest``: no set with fewer inputs of the run forces its end.
    """

    needed: tuple[Needed, ...]
    minimal: bool
    smallest: bool = False


@dataclass(frozen=True)
class TracedSystem:
    """What a reader needs of the system that a run is of.

    ``variables`` are all by name, inputs and frozen ones too; ``frozen`` names the choices that are fixed for
    the whole run.  ``statecharts`` are the charts that executed, by name, as drawn, and ``components`` all
    that executes in a tick, in order.
    """

    name: str
    tick_ms: int
    variables: Mapping[str, "Var"]
    inputs: tuple[str, ...] = ()
    frozen: tuple[str, ...] = ()
    statecharts: Mapping[str, "Chart"] = field(default_factory=dict, compare=False, repr=False)
    components: tuple["Component", ...] = field(default=(), compare=False, repr=False)

    @staticmethod
    def of(system: "TransitionSystem") -> "TracedSystem":
        """Of a lowered system, with the charts from which it was lowered."""
        source = system.source
        return TracedSystem(
            system.name,
            system.tick_ms,
            {v.name: v for v in (*system.variables, *system.inputs, *system.frozen)},
            tuple(v.name for v in system.inputs),
            tuple(v.name for v in system.frozen),
            {c.name: c for c in source.charts} if source else {},
            source.components if source else (),
        )


@dataclass(frozen=True)
class TracedProperty:
    """What a run says of a property: its ``id`` and sentence, stated at ``place``, blank for a run of none.

    ``relevant`` and ``charts`` name the variables and the charts it depends on.  ``parts`` are all its
    conjuncts, and ``truths`` has for each of them whether it is true after each tick; ``false_parts`` are
    those that are false after the last (for a witness, none).  ``because`` is why it is so, as it is written
    beside the expected verdict.  ``violated`` tells whether the run breaks it;
    None for a run of no property, and for one of which only the parts that it makes false are known.
    """

    id: str = ""
    text: str = ""
    relevant: frozenset[str] = frozenset()
    charts: frozenset[str] = frozenset()
    false_parts: tuple["Expr", ...] = ()
    parts: tuple["Expr", ...] = ()
    truths: tuple[tuple[bool, ...], ...] = ()
    violated: bool | None = None
    place: "Place | None" = field(default=None, compare=False, repr=False)
    because: str = ""


NO_PROPERTY = TracedProperty()


@dataclass(frozen=True)
class Trace:
    """A run of a system, and what it says of a property.

    ``before`` is the state before the first tick (frozen variables included).  ``ends`` has the ms at the end
    of each tick, where ticks last unlike times.  ``shortest``: no shorter run ends so.

    ``loop`` is set for a run without end: after the last tick all that the property depends on is as
    after that tick (0: as before the first), and the ticks in between repeat for ever.  ``trapped``
    is set for a run after which something is out of reach: it counts the states still reached.

    ``necessary`` are the inputs that force its end; None for a run whose inputs were not examined.
    ``concrete`` is the run as the boards see it, where it was asked for; ``again`` is the command that shows
    the run, where it is known.
    """

    system: TracedSystem
    before: Mapping[str, int]
    ticks: tuple[Tick, ...]
    property: TracedProperty = NO_PROPERTY
    ends: tuple[int, ...] = ()
    loop: int | None = None
    trapped: int | None = None
    shortest: bool = False
    necessary: NecessaryInputs | None = None
    concrete: tuple["BoardTest", ...] = field(default=(), compare=False, repr=False)
    again: str = field(default="", compare=False, repr=False)

    def with_reason(self, because: str) -> "Trace":
        """The same run with why its property is violated, or true."""
        return replace(self, property=replace(self.property, because=because))

    def needed(self) -> tuple[Needed, ...]:
        """The inputs that force its end, as far as they were examined."""
        return () if self.necessary is None else self.necessary.needed

    def clock(self) -> int | tuple[int, ...]:
        """The length of each tick in ms; where they differ, the time at the end of each, from tick 0 on."""
        return (0, *self.ends) if self.ends else self.system.tick_ms

    def ms(self, tick: int) -> int:
        """The time in ms at the end of a tick, from the start of the run; 0 of tick 0."""
        return self.ends[tick - 1] if tick and self.ends else tick * self.system.tick_ms

    def __len__(self) -> int:
        return len(self.ticks)

    def breaks(self) -> bool:
        """Whether it is a counterexample, not a witness nor a run of no property."""
        if self.property.violated is not None:
            return self.property.violated
        return bool(self.property.false_parts) or self.loop is not None or self.trapped is not None

    def since(self, part: "Expr") -> int:
        """The tick since which a conjunct of the property has been as it is after the last one.

        Without ``truths``, the last tick.
        """
        if not self.property.truths:
            return len(self)
        values = next(v for p, v in zip(self.property.parts, self.property.truths, strict=True) if p is part)
        return next((k + 1 for k in range(len(values) - 1, 0, -1) if values[k - 1] != values[-1]), 1)

    def focused(self) -> "Trace":
        """The same run with only what the property depends on, bookkeeping left out."""
        shown = {
            n
            for n in self.property.relevant
            if n in self.system.variables and not self.system.variables[n].hidden
        }
        ticks = (
            Tick(
                t.number,
                {n: v for n, v in t.inputs.items() if n in shown},
                {n: v for n, v in t.after.items() if n in shown},
                tuple(a for a in t.transitions if a.chart in self.property.charts),
            )
            for t in self.ticks
        )
        return replace(
            self,
            system=replace(self.system, inputs=tuple(n for n in self.system.inputs if n in shown)),
            before={n: v for n, v in self.before.items() if n in shown},
            ticks=tuple(ticks),
        )

    def show(self, name: str, raw: int) -> str:
        """A value as a person writes it."""
        return self.system.variables[name].domain.show(raw)

    def changes(self) -> Iterator[tuple[Tick, dict[str, int]]]:
        """Each tick with the variables and inputs whose value differs from the tick before."""
        last: Mapping[str, int] = self.before
        for tick in self.ticks:
            now = {**tick.after, **tick.inputs}
            yield tick, {n: v for n, v in now.items() if last.get(n) != v}
            last = now
