"""The forms of properties, in the words of their definition; a form knows no chart.

Conventions: a formula is read at the end of a tick, with the inputs of the tick.  "Within n ticks
of k" is some tick of k..k+n.  ``from_tick`` is the first tick at which a property is required
(2 where the specification says "for k >= 2").
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Union

from rovercheck.properties.pasttime import Bounded, Implication, Past, T, begins
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError, several
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.place import Place, here
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.words import held, previous


@dataclass(frozen=True)
class Always(Bounded):
    """``that`` is true in every tick."""

    that: Expr

    def monitor(self, past: Past[T]) -> tuple[T, T]:
        return past.armed, past.armed & ~past(self.that)

    def implication(self) -> Implication:
        return None, self.that


@dataclass(frozen=True)
class Never(Bounded):
    """``that`` is true in no tick."""

    that: Expr

    def monitor(self, past: Past[T]) -> tuple[T, T]:
        return past.armed, past.armed & past(self.that)

    def implication(self) -> Implication:
        return None, ~self.that


@dataclass(frozen=True)
class Responds(Bounded):
    """If ``trigger`` is true in tick k, ``response`` is true in some tick of k..k+within."""

    trigger: Expr
    response: Expr
    within: Span

    def monitor(self, past: Past[T]) -> tuple[T, T]:
        asked = past.armed & past(self.trigger)
        return asked, past.overdue(asked, past(self.response), self.within)

    def implication(self) -> Implication:
        return self.trigger, self.response


@dataclass(frozen=True)
class HoldsAfter(Bounded):
    """If ``premise`` is true in every tick of k..k+for_, ``then`` is true in tick k+for_."""

    premise: Expr
    for_: Span
    then: Expr

    def monitor(self, past: Past[T]) -> tuple[T, T]:
        long = past.held(past.armed & past(self.premise), self.for_)
        return long, long & ~past(self.then)

    def implication(self) -> Implication:
        return held(self.premise, self.for_), self.then


@dataclass(frozen=True)
class HoldsFor(Bounded):
    """If ``start`` becomes true in tick k, ``that`` is true in every tick of k..k+for_."""

    start: Expr
    that: Expr
    for_: Span

    def monitor(self, past: Past[T]) -> tuple[T, T]:
        start, that = past(self.start), past(self.that)
        started = past.armed & begins(past, start)
        return started, past.within(started, self.for_) & ~that

    def implication(self) -> Implication:
        return self.start, self.that


@dataclass(frozen=True)
class LeavesOnlyIf(Bounded):
    """If ``leaving`` was true in tick k-1 and is false in k, ``only_if`` is true in k."""

    leaving: Expr
    only_if: Expr

    def monitor(self, past: Past[T]) -> tuple[T, T]:
        now = past(self.leaving)
        left = past.armed & (past.previous(now) & ~now)
        return left, left & ~past(self.only_if)

    def implication(self) -> Implication:
        return previous(self.leaving) & ~self.leaving, self.only_if


@dataclass(frozen=True)
class EntersOnlyIf(Bounded):
    """If ``entering`` was false in tick k-1 (or k = 1) and is true in k, ``only_if`` is true in k."""

    entering: Expr
    only_if: Expr

    def monitor(self, past: Past[T]) -> tuple[T, T]:
        entered = past.armed & begins(past, past(self.entering))
        return entered, entered & ~past(self.only_if)

    def implication(self) -> Implication:
        return self.entering, self.only_if


@dataclass(frozen=True)
class Precedes(Bounded):
    """``then`` is true in tick k only if ``first`` is true in some tick of 1..k."""

    first: Expr
    then: Expr

    def monitor(self, past: Past[T]) -> tuple[T, T]:
        now = past.armed & past(self.then)
        seen = past.once(past(self.first))
        return now & (seen | ~seen), now & ~seen  # where it is known whether it was

    def implication(self) -> Implication:
        return self.then, self.first


@dataclass(frozen=True)
class Until(Bounded):
    """From a tick with ``start`` on, ``holds`` is true in every tick up to the first with ``release``.

    The tick of ``start`` is included, the tick of ``release`` is not; release need not come.
    """

    start: Expr
    holds: Expr
    release: Expr

    def monitor(self, past: Past[T]) -> tuple[T, T]:
        started, held = past.armed & past(self.start), past(self.holds)
        required = past.since(started, past(self.release))
        return required, required & ~held

    def implication(self) -> Implication:
        return self.start, self.holds


@dataclass(frozen=True)
class Reachable(Bounded):
    """``that`` is true in some tick of some run."""

    that: Expr

    def monitor(self, past: Past[T]) -> tuple[T, T]:
        reached = past.armed & past(self.that)
        return reached, reached

    def implication(self) -> Implication:
        return None, None


@dataclass(frozen=True)
class LeadsTo:
    """If ``trigger`` is true in tick k, ``response`` is true in k or some later tick; no bound is set.

    Required only of runs in which each of ``fair`` is true again and again.  If ``bound`` is given,
    it is tried first to prove that the response comes within it.
    """

    trigger: Expr
    response: Expr
    bound: Span | None = None
    fair: tuple[Expr, ...] = ()


@dataclass(frozen=True)
class Settles:
    """If from some tick on ``premise`` is true in every tick, so is ``then`` from some tick on.

    Required only of runs in which each of ``fair`` is true again and again.  If ``bound`` is given,
    it is tried first to prove that ``then`` is true once ``premise`` has been for as long.
    """

    premise: Expr
    then: Expr
    bound: Span | None = None
    fair: tuple[Expr, ...] = ()


@dataclass(frozen=True)
class Recoverable:
    """After every tick of every run, some continuation reaches a tick with ``to``, if that was none.

    If ``by``, a condition on inputs alone, is given, it is tried first to prove that inputs which
    meet it in every tick lead to ``to`` after ``within``, from wherever the run is.
    """

    to: Expr
    by: Expr | None = None
    within: Span | None = None


Form = Union[
    Always, Never, Responds, HoldsAfter, HoldsFor, LeavesOnlyIf, EntersOnlyIf, Precedes, Until, Reachable,
    LeadsTo, Settles, Recoverable,
]  # fmt: skip

Unbounded = LeadsTo | Settles | Recoverable
"""Forms that no finite run breaks: they are decided by a loop, or by what can no longer be reached."""


def formulas(form: Form) -> list[Expr]:
    """The formulas a form is made of, in the order in which it is written."""
    values = (getattr(form, f.name) for f in fields(form))
    parts = (part for value in values for part in (value if isinstance(value, tuple) else (value,)))
    return [part for part in parts if isinstance(part, Expr)]


@dataclass(frozen=True)
class Property:
    """A requirement made precise: id, sentence, form, the requirements it covers, the system it is about.

    ``interpretations`` names the ambiguous sentences on whose interpretation it depends.  ``costly``: it is
    decided only on request and in the full profile, not in the default one.  ``about`` is what was given
    for ``on``, if that was no name; ``place`` is where it is written.
    """

    id: str
    text: str
    form: Form
    covers: tuple[str, ...]
    on: str
    from_tick: int = 1
    interpretations: tuple[str, ...] = ()
    costly: bool = False
    area: str = field(default="", compare=False)
    about: Chart | System | None = field(default=None, compare=False, repr=False)
    place: Place | None = field(default_factory=lambda: here(__name__), compare=False, repr=False)


def costly(prop: Property) -> Property:
    """The same property, for the full profile only: it takes more than half a minute."""
    return replace(prop, costly=True)


On = str | Chart | System
"""What a property is about: a system or its name, or a chart that runs alone, under its own name."""


def _property(
    id: str,
    text: str,
    form: Form,
    covers: Sequence[str],
    on: On,
    from_tick: int,
    interpretations: Sequence[str],
) -> Property:
    about, name = (on, on.name) if isinstance(on, Chart | System) else (None, on)
    ids = several(id, "covers", covers)
    if not ids:
        raise ModelError(f"{id} covers no requirement; write covers=[...] with at least one requirement id.")
    return Property(
        id, text, form, ids, name, from_tick, several(id, "interpretations", interpretations), about=about
    )


def always(id: str, text: str, *, that: Expr, covers: Sequence[str], on: On,
           from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """``that`` is true in every tick."""
    return _property(id, text, Always(that), covers, on, from_tick, interpretations)


def never(id: str, text: str, *, that: Expr, covers: Sequence[str], on: On,
          from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """``that`` is true in no tick."""
    return _property(id, text, Never(that), covers, on, from_tick, interpretations)


def responds(id: str, text: str, *, trigger: Expr, response: Expr, within: Span, covers: Sequence[str],
             on: On, from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """After ``trigger``, ``response`` comes within a time: see ``Responds``."""
    return _property(id, text, Responds(trigger, response, within), covers, on, from_tick, interpretations)


def holds_after(id: str, text: str, *, premise: Expr, for_: Span, then: Expr, covers: Sequence[str],
                on: On, from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """Where ``premise`` has been true for a time, ``then`` is true: see ``HoldsAfter``."""
    return _property(id, text, HoldsAfter(premise, for_, then), covers, on, from_tick, interpretations)


def holds_for(id: str, text: str, *, start: Expr, that: Expr, for_: Span, covers: Sequence[str],
              on: On, from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """From ``start`` on, ``that`` is true for a time: see ``HoldsFor``."""
    return _property(id, text, HoldsFor(start, that, for_), covers, on, from_tick, interpretations)


def leaves_only_if(id: str, text: str, *, leaving: Expr, only_if: Expr, covers: Sequence[str], on: On,
                   from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """``leaving`` ends only in a tick with ``only_if``: see ``LeavesOnlyIf``."""
    return _property(id, text, LeavesOnlyIf(leaving, only_if), covers, on, from_tick, interpretations)


def enters_only_if(id: str, text: str, *, entering: Expr, only_if: Expr, covers: Sequence[str], on: On,
                   from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """``entering`` begins only in a tick with ``only_if``: see ``EntersOnlyIf``."""
    return _property(id, text, EntersOnlyIf(entering, only_if), covers, on, from_tick, interpretations)


def precedes(id: str, text: str, *, first: Expr, then: Expr, covers: Sequence[str], on: On,
             from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """``then`` is true only once ``first`` has been: see ``Precedes``."""
    return _property(id, text, Precedes(first, then), covers, on, from_tick, interpretations)


def until(id: str, text: str, *, start: Expr, holds: Expr, release: Expr, covers: Sequence[str], on: On,
          from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """From ``start`` on, ``holds`` is true until ``release``: see ``Until``."""
    return _property(id, text, Until(start, holds, release), covers, on, from_tick, interpretations)


def reachable(id: str, text: str, *, that: Expr, covers: Sequence[str], on: On,
              from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """Some run gets to ``that``."""
    return _property(id, text, Reachable(that), covers, on, from_tick, interpretations)


def leads_to(id: str, text: str, *, trigger: Expr, response: Expr, covers: Sequence[str], on: On,
             bound: Span | None = None, fair: Sequence[Expr] = (),
             from_tick: int = 1, interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """After ``trigger``, ``response`` comes some day: see ``LeadsTo``."""
    form = LeadsTo(trigger, response, bound, several(id, "fair", fair))
    return _property(id, text, form, covers, on, from_tick, interpretations)


def settles(id: str, text: str, *, premise: Expr, then: Expr, covers: Sequence[str], on: On,
            bound: Span | None = None, fair: Sequence[Expr] = (),
            interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """If ``premise`` is true from some tick on, so is ``then``: see ``Settles``."""
    form = Settles(premise, then, bound, several(id, "fair", fair))
    return _property(id, text, form, covers, on, 1, interpretations)


def recoverable(id: str, text: str, *, to: Expr, covers: Sequence[str], on: On,
                by: Expr | None = None, within: Span | None = None,
                interpretations: Sequence[str] = ()) -> Property:  # fmt: skip
    """From everywhere there is a way to ``to``: see ``Recoverable``."""
    if (by is None) != (within is None):
        raise ModelError(f"{id} gives only one of by= and within=; write both, or neither.")
    return _property(id, text, Recoverable(to, by, within), covers, on, 1, interpretations)
