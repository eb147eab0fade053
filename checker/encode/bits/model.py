"""A transition system as a sequential circuit: latches, inputs, and what is asked of them.

The circuit is cut to the cone of influence of the goals, and variables that never change are
constants in it.  It has the same runs as the system, tick by tick: what is true of latches and
inputs at time ``t`` (the first is 0) speaks of tick ``t + 1``.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.encode.bits.aig import Aig, Literal, bits_of
from rovercheck.checker.encode.bits.blast import Blaster, Value, as_word, bits_needed
from rovercheck.checker.encode.cone import Slice, as_written, cone, folded, straying
from rovercheck.checker.encode.symbolic import SymbolicTransition, transition
from rovercheck.checker.results.verdict import Run
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables


@dataclass(frozen=True)
class Bit:
    """A bit of a variable and the input of the graph that stands for it."""

    var: Var
    number: int
    literal: Literal


@dataclass(frozen=True)
class Latch:
    """A bit of a state: its value before the first tick (None: any) and its next one."""

    bit: Bit
    init: int | None
    next: Literal

    @property
    def literal(self) -> Literal:
        return self.bit.literal


@dataclass(frozen=True)
class Circuit:
    """A sequential circuit.

    assume   over latches and inputs: what the environment may do, inputs within their domains
    start    over latches: the frozen variables, which are latches that keep their value, within theirs
    within   over latches: variables within their domains; implied in every run if ``leaves`` never holds
    leaves   over latches and inputs: the tick takes some variable out of its domain
    goals    over latches and inputs: the goal is true after the tick
    others   bits of inputs outside the cone, and ``loose``, what the assumption says of them alone
    """

    system: TransitionSystem
    aig: Aig
    latches: tuple[Latch, ...]
    inputs: tuple[Bit, ...]
    assume: Literal
    start: Literal
    within: Literal
    leaves: Literal
    goals: Mapping[str, Literal]
    others: tuple[Bit, ...]
    loose: Literal

    def run(self, frozen: Mapping[Literal, int], ticks: Sequence[Mapping[Literal, int]]) -> Run:
        """The run of the whole system in which inputs of the graph have these values: ``frozen`` at the
        start, one mapping (of inputs and others) per tick.  What no mapping mentions is as at the start."""
        held = {v.name for v in self.system.frozen}
        latched = [latch.bit for latch in self.latches if latch.bit.var.name in held]
        still = {v.name: v.init for v in self.system.frozen} | _values(latched, frozen)
        moving = {v.name: v.init for v in self.system.inputs}
        bits = (*self.inputs, *self.others)
        return Run(still, tuple(moving | _values(bits, tick) for tick in ticks))


def circuit(system: TransitionSystem, goals: Sequence[str]) -> Circuit:
    """The circuit of a system, cut for these goals.  Raises ``ModelError`` on a temporal word."""
    return cut(folded(transition(system)), goals)


def cut(whole: SymbolicTransition, goals: Sequence[str]) -> Circuit:
    """The circuit of what these goals depend on, of a transition without constants."""
    escapes = straying(whole, as_written(whole.system, goals))
    part = cone(whole, [*goals, *escapes])
    state = _state(part, [*goals, *escapes])
    aig = Aig()
    held = {v.name for v in part.frozen}
    latched = [v for v in (*part.frozen, *part.variables) if v.name in state or v.name in held]
    bits = {v.name: [Bit(v, i, aig.input()) for i in range(bits_needed(v))] for v in (*latched, *part.inputs)}
    inside = {v.name for v in part.inputs}
    rest = [v for v in whole.system.inputs if v.name not in inside]
    bits |= {v.name: [Bit(v, i, aig.input()) for i in range(bits_needed(v))] for v in rest}
    blast = Blaster(aig, {n: as_word(b[0].var, [x.literal for x in b]) for n, b in bits.items()})

    def within(chosen: Iterable[Var]) -> Literal:
        return aig.all(blast.inside(blast(whole.terms.var(v)), v.domain) for v in chosen)

    def holds(conditions: Iterable[Expr]) -> Iterator[Literal]:
        return (blast.truth(c) for c in conditions)

    following = {v.name: blast(part.next[v.name]) for v in part.variables}
    outside = list(holds(escapes.values()))
    outside += [blast.inside(following[v.name], v.domain) ^ 1 for v in latched if _sparse(v, held)]
    return Circuit(
        whole.system,
        aig,
        tuple(latch for v in latched for latch in _latches(v, bits[v.name], following, held)),
        tuple(bit for v in part.inputs for bit in bits[v.name]),
        aig.all([*holds(part.assume), within(part.inputs)]),
        within(part.frozen),
        within(latched),
        aig.any(outside),
        {g: following[g][0] for g in goals},
        tuple(bit for v in rest for bit in bits[v.name]),
        aig.all([*holds(part.loose), within(rest)]),
    )


def _sparse(var: Var, held: Iterable[str]) -> bool:
    """Whether a variable's domain has gaps, so that being within its hull is not enough."""
    return not var.domain.dense and var.name not in held


def _state(part: Slice, goals: Sequence[str]) -> set[str]:
    """The variables that make up a state: those read by what the goals depend on."""
    own = {v.name for v in part.variables}
    read = set(variables(*part.assume)) & own
    todo = [*goals, *read]
    while todo:
        found = set(variables(part.next[todo.pop()])) & own
        todo += found - read
        read |= found
    return read


def _latches(
    var: Var, bits: Sequence[Bit], following: Mapping[str, Value], held: Iterable[str]
) -> Iterator[Latch]:
    if var.name in held:
        yield from (Latch(bit, None, bit.literal) for bit in bits)
        return
    word = following[var.name]
    for bit, init in zip(bits, bits_of(var.init, len(bits)), strict=True):
        yield Latch(bit, init, word[min(bit.number, len(word) - 1)])


def _values(bits: Sequence[Bit], given: Mapping[Literal, int]) -> dict[str, int]:
    """The raw values of the variables whose bits are given."""
    found: dict[str, list[tuple[Bit, int]]] = {}
    for bit in bits:
        if bit.literal in given:
            found.setdefault(bit.var.name, []).append((bit, given[bit.literal]))
    return {name: _value(own) for name, own in found.items()}


def _value(own: Sequence[tuple[Bit, int]]) -> int:
    var = own[0][0].var
    raw = sum(value << bit.number for bit, value in own)
    negative = var.domain.low < 0 and raw >> bits_needed(var) - 1 & 1
    return raw - (1 << bits_needed(var)) if negative else raw
