"""Lemmas over bits as formulas over the variables of the system, for certificates and people."""

from collections.abc import Iterable, Mapping, Sequence

from checker.encode.bits import Bit
from checker.encode.bits.blast import bits_needed
from checker.engines.pdr.cubes import Cube
from spec_model.lang.domain import Bool, Num
from spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, Var, any_of
from spec_model.lang.operators import Op

_LISTED = 1 << 12
"""Values of a domain that are looked at one by one to find a readable formula."""


def conjuncts(cubes: Iterable[Cube], latches: Sequence[Bit]) -> tuple[Expr, ...]:
    """The negation of each cube; variables are taken to be within their domains."""
    found = (_negated(excluded, latches) for excluded in cubes)
    return tuple(formula for formula in found if formula is not TRUE)


def equal(var: Var, value: int) -> Expr:
    """The variable has a value."""
    if isinstance(var.sort, Bool):
        return var if value else ~var
    return _compared(Op.EQ, var, value)


def _negated(excluded: Cube, latches: Sequence[Bit]) -> Expr:
    """Some variable does not have the bits that the cube demands of it; ``TRUE`` if none ever has."""
    wanted: dict[str, dict[int, bool]] = {}
    known: dict[str, Var] = {}
    for literal in excluded.literals:
        bit = latches[abs(literal) - 1]
        known[bit.var.name] = bit.var
        wanted.setdefault(bit.var.name, {})[bit.number] = literal > 0
    parts = [_different(known[name], bits) for name, bits in wanted.items()]
    if any(part is TRUE for part in parts):
        return TRUE
    return any_of(*(part for part in parts if part is not FALSE))


def _different(var: Var, bits: Mapping[int, bool]) -> Expr:
    """The variable differs in at least one of these bits."""
    if isinstance(var.sort, Bool):
        allowed = [value for value in var.domain.values if value != bits[0]]
    elif len(var.domain) <= _LISTED:
        allowed = [v for v in var.domain.values if any((v >> n & 1) != bit for n, bit in bits.items())]
    else:
        return any_of(*(_bit(var, n) if not bit else ~_bit(var, n) for n, bit in bits.items()))
    return _among(var, allowed, bits)


def _among(var: Var, allowed: Sequence[int], bits: Mapping[int, bool]) -> Expr:
    """The variable has one of the allowed values: as a comparison where there is a short one."""
    values = list(var.domain.values)
    if len(allowed) in (0, len(values)):
        return TRUE if allowed else FALSE
    if isinstance(var.sort, Bool):
        return var if allowed[0] else ~var
    excluded = sorted(set(values) - set(allowed))
    if len(excluded) == 1:
        return _compared(Op.NE, var, excluded[0])
    if len(allowed) == 1:
        return _compared(Op.EQ, var, allowed[0])
    if excluded == values[: len(excluded)]:
        return _compared(Op.GE, var, allowed[0])
    if excluded == values[-len(excluded) :]:
        return _compared(Op.LE, var, allowed[-1])
    if not isinstance(var.sort, Num):
        return any_of(*(_compared(Op.EQ, var, value) for value in allowed))
    return any_of(*(~_bit(var, n) if bit else _bit(var, n) for n, bit in bits.items()))


def _compared(op: Op, var: Var, value: int) -> Expr:
    return Apply(op, (var, Const(value, var.sort)), Bool())


def _bit(var: Var, number: int) -> Expr:
    """A bit of the two's complement, by an offset that makes the number non-negative."""
    base: Expr = var
    if var.domain.low < 0:
        base = Apply(Op.ADD, (var, Const(1 << bits_needed(var), var.sort)), var.sort)
    return Apply(Op.BIT, (base, Const(number, Num())), Bool())
