"""A trace: the replayed run, tick by tick, with what fired and what the property says."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rovercheck.checker.results.board_steps import BoardRun
    from rovercheck.spec_model.lang.chart import Chart, Component
    from rovercheck.spec_model.lang.expr import Expr, Var
    from rovercheck.spec_model.lang.place import Place


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
class Trace:
    """A run with everything a reader needs.

    ``before`` is the state before the first tick (frozen variables included); ``false_parts``
    are the conjuncts of the property that are false after the last tick (for a witness, empty).
    ``relevant`` and ``charts`` name the variables and the charts the property depends on.

    ``loop`` is set for a run without end: after the last tick all that the property depends on is as
    after that tick (0: as before the first), and the ticks in between repeat for ever.  ``trapped``
    is set for a run after which something is out of reach: it counts the states still reached.

    ``property`` and ``text`` are the id and the sentence of the property, which is written at ``place``;
    ``statecharts`` are the charts that executed, by name, as drawn, and ``components`` all that executes in a
    tick, in order.  ``concrete`` is the run as the boards see it, where it was asked for.  ``parts`` are all
    conjuncts of the property, and ``truths`` has for each of them whether it is true after each tick.

    ``needed`` are the inputs that force the end of the run, in any run of its length with its frozen values:
    the others may be anything that is admissible.  It is None for a run whose inputs were not examined.
    ``minimal``: none of those needed can be left out; otherwise the search for such a set was cut short.
    ``smallest``: no set with fewer of the run's inputs forces its end.

    ``violated`` tells whether the run breaks the property; it is None for a run of no property, and for one
    of which only the parts that it makes false are known.  ``shortest``: no shorter run ends so.
    ``again`` is the command that shows the run, where it is known.  ``frozen`` names the choices that are
    fixed for the whole run.  ``ends`` has the ms at the end of each tick, where ticks last unlike times.
    """

    system: str
    tick_ms: int
    variables: Mapping[str, "Var"]
    inputs: tuple[str, ...]
    before: Mapping[str, int]
    ticks: tuple[Tick, ...]
    false_parts: tuple["Expr", ...] = ()
    relevant: frozenset[str] = frozenset()
    charts: frozenset[str] = frozenset()
    loop: int | None = None
    trapped: int | None = None
    property: str = ""
    text: str = ""
    statecharts: Mapping[str, "Chart"] = field(default_factory=dict, compare=False, repr=False)
    components: tuple["Component", ...] = field(default=(), compare=False, repr=False)
    parts: tuple["Expr", ...] = ()
    truths: tuple[tuple[bool, ...], ...] = ()
    needed: tuple[Needed, ...] | None = None
    minimal: bool = False
    smallest: bool = False
    place: "Place | None" = field(default=None, compare=False, repr=False)
    concrete: tuple["BoardRun", ...] = field(default=(), compare=False, repr=False)
    violated: bool | None = None
    shortest: bool = False
    again: str = field(default="", compare=False, repr=False)
    frozen: tuple[str, ...] = ()
    ends: tuple[int, ...] = ()

    def clock(self) -> int | tuple[int, ...]:
        """The length of each tick in ms; where they differ, the time at the end of each, from tick 0 on."""
        return (0, *self.ends) if self.ends else self.tick_ms

    def ms(self, tick: int) -> int:
        """The time in ms at the end of a tick, from the start of the run; 0 of tick 0."""
        return self.ends[tick - 1] if tick and self.ends else tick * self.tick_ms

    def __len__(self) -> int:
        return len(self.ticks)

    def breaks(self) -> bool:
        """Whether it is a counterexample, not a witness nor a run of no property."""
        if self.violated is not None:
            return self.violated
        return bool(self.false_parts) or self.loop is not None or self.trapped is not None

    def since(self, part: "Expr") -> int:
        """The tick since which a conjunct of the property has been as it is after the last one.

        Without ``truths``, the last tick.
        """
        if not self.truths:
            return len(self)
        values = next(v for p, v in zip(self.parts, self.truths, strict=True) if p is part)
        return next((k + 1 for k in range(len(values) - 1, 0, -1) if values[k - 1] != values[-1]), 1)

    def focused(self) -> "Trace":
        """The same run with only what the property depends on, bookkeeping left out."""
        shown = {n for n in self.relevant if n in self.variables and not self.variables[n].hidden}
        ticks = (
            Tick(
                t.number,
                {n: v for n, v in t.inputs.items() if n in shown},
                {n: v for n, v in t.after.items() if n in shown},
                tuple(a for a in t.transitions if a.chart in self.charts),
            )
            for t in self.ticks
        )
        return replace(
            self,
            inputs=tuple(n for n in self.inputs if n in shown),
            before={n: v for n, v in self.before.items() if n in shown},
            ticks=tuple(ticks),
        )

    def show(self, name: str, raw: int) -> str:
        """A value as a person writes it."""
        return self.variables[name].domain.show(raw)

    def changes(self) -> Iterator[tuple[Tick, dict[str, int]]]:
        """Each tick with the variables and inputs whose value differs from the tick before."""
        last: Mapping[str, int] = self.before
        for tick in self.ticks:
            now = {**tick.after, **tick.inputs}
            yield tick, {n: v for n, v in now.items() if last.get(n) != v}
            last = now
