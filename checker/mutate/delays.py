"""Changes of when values pass from part to part: a step late, of the step before, held, never renewed."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from rovercheck.checker.mutate.memory import with_memory
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, parts
from rovercheck.spec_model.lang.domain import Bool, boolean
from rovercheck.spec_model.lang.edit import in_block, in_expressions, instead
from rovercheck.spec_model.lang.expr import Const, Expr, Var
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True)
class Delay:
    """A signal that a part gives or takes at another time than it should."""

    kind: str
    part: str
    signal: str
    old: str
    new: str
    make: Callable[[], System]


def delays(system: System) -> Iterator[Delay]:
    """Every signal of every part late, old or held."""
    for part in parts(system.components):
        for name, v in part.written.items():
            change = partial(late, system, part, v)
            yield Delay("late", part.name, name, "in its step", "a step later", change)
        for name, v in part.read.items():
            if name in part.written:
                continue
            change = partial(stale, system, part, v)
            yield Delay("stale", part.name, name, "of the step", "of the step before", change)
            yield Delay(
                "frozen", part.name, name, "renewed", "of the first step, ever after",
                partial(frozen, system, part, v),
            )  # fmt: skip
            yield Delay(
                "unread", part.name, name, "renewed", f"always {v.domain.show(v.init)}",
                partial(unread, system, part, v),
            )  # fmt: skip
        flags = [v for n, v in part.read.items() if isinstance(v.sort, Bool) and n not in part.written]
        for name, v in part.written.items():
            for flag in flags:
                for value in (1, 0):
                    word = f"held while {'' if value else 'not '}{flag.name}"
                    yield Delay(
                        "held", part.name, name, "renewed", word, partial(held, system, part, v, flag, value)
                    )


def late(system: System, part: Chart | Block, v: Var) -> System:
    """What the part writes is seen by all others a step later."""
    own = replace(v, name=f"{v.name} (computed)")
    kept = replace(v, name=f"{v.name} (waiting)")
    after = Block(f"{part.name} late", [Assign(v, kept), Assign(kept, own)], place=part.place)
    return _instead_of(system, part, (with_memory(part, {v.name: own}), after))


def held(system: System, part: Chart | Block, v: Var, flag: Var, value: int) -> System:
    """What the part writes stays while a flag has a value."""
    own = replace(v, name=f"{v.name} (computed)")
    stays = flag == Const(value, flag.sort)
    after = Block(f"{part.name} held", [If(stays, (), (Assign(v, own),))], place=part.place)
    return _instead_of(system, part, (with_memory(part, {v.name: own}), after))


def stale(system: System, part: Chart | Block, v: Var) -> System:
    """The part reads a signal as it was in the step before."""
    old = replace(v, name=f"{v.name} (before)")
    after = Block(f"{v.name} remembered", [Assign(old, v)], place=part.place)
    return _instead_of(system, part, (_read(part, v, old), after))


def frozen(system: System, part: Chart | Block, v: Var) -> System:
    """The part reads a signal once."""
    old = replace(v, name=f"{v.name} (first)")
    known = Var(f"{v.name} known", boolean, 0)
    first = If(known, (), (Assign(old, v), Assign(known, Const(1, Bool()))))
    before = Block(f"{v.name} read once", [first], place=part.place)
    return _instead_of(system, part, (before, _read(part, v, old)))


def unread(system: System, part: Chart | Block, v: Var) -> System:
    """The part reads the initial value, whatever the signal is."""
    return _instead_of(system, part, (_read(part, v, Const(v.init, v.sort)),))


def _read(part: Chart | Block, v: Var, new: Expr) -> Chart | Block:
    change = instead(v.name, lambda _: new)
    return in_block(part, change) if isinstance(part, Block) else in_expressions(part, change)


def _instead_of(system: System, part: Chart | Block, new: Sequence[Component]) -> System:
    """The system with some parts in place of one."""

    def walk(components: Sequence[Component]) -> tuple[Component, ...]:
        found: list[Component] = []
        for one in components:
            if isinstance(one, Enabled):
                found.append(Enabled(one.by, *walk(one.components), name=one.name, place=one.place))
            elif one.name == part.name:
                found += new
            else:
                found.append(one)
        return tuple(found)

    return replace(system, components=walk(system.components))


__all__ = ["Delay", "delays", "frozen", "held", "late", "stale", "unread"]
