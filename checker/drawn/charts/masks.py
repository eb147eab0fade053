"""Sums of bits, as lowering writes operators on bits, in fewer words."""

from collections.abc import Sequence
from functools import reduce

from rovercheck.checker.drawn.lower.symbols import folded, least_and_greatest
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, const
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import structure

BitTerm = tuple[Expr, int]
"""A condition, and the number of the bit that is set where it holds."""


def mask_terms(expr: Expr) -> list[BitTerm]:
    """The bits of a sum of different ones; nothing where it is no such sum."""
    found: list[BitTerm] = []
    waiting = [expr]
    while waiting:
        one = waiting.pop()
        match one:
            case Apply(Op.ADD, args):
                waiting += reversed(args)
            case Apply(Op.ITE, (condition, Const(value, Num()), Const(0))) if _is_power(value):
                found.append((condition, value.bit_length() - 1))
            case Const(value, Num()) if _is_power(value):
                found.append((TRUE, value.bit_length() - 1))
            case _:
                return []
    places = [place for _, place in found]
    whole = isinstance(expr.sort, Num) and expr.sort.resolution == 1
    return found if whole and len(set(places)) == len(places) else []


def _is_power(value: int) -> bool:
    return value > 0 and value & (value - 1) == 0


def bit_of_sum(expr: Apply) -> Expr:
    """A bit of a sum of bits is one of them; one of a number that is shifted down is a higher one."""
    value, index = expr.args
    assert isinstance(index, Const)
    if isinstance(value, Apply) and value.op is Op.DIV and isinstance(value.args[1], Const):
        by = value.args[1].value
        if _is_power(by):
            place = Const(index.value + by.bit_length() - 1, Num())
            return Apply(Op.BIT, (value.args[0], place), expr.sort)
    terms = mask_terms(value)
    if terms:
        return next((condition for condition, place in terms if place == index.value), FALSE)
    return expr


def masked(expr: Expr) -> Expr:
    """A sum of the bits of some numbers, as these numbers where all of their bits are in it."""
    terms = mask_terms(expr)
    if len(terms) < 2:
        return expr
    groups: dict[object, list[tuple[int, int, Expr]]] = {}
    others: list[BitTerm] = []
    for condition, place in terms:
        match condition:
            case Apply(Op.BIT, (base, Const(number))):
                groups.setdefault((structure(base), number - place), []).append((number, place, base))
            case _:
                others.append((condition, place))
    parts: list[Expr] = []
    always = [place for condition, place in others if condition is TRUE]
    for group in groups.values():
        made, used = _whole(group, always)
        parts.append(made)
        always = [place for place in always if place not in used]
    parts += [_term(condition, place) for condition, place in others if condition is not TRUE]
    if always:
        parts.append(const(sum(2**place for place in always)))
    return reduce(lambda total, one: folded(total + one), parts)


def _term(condition: Expr, place: int) -> Expr:
    return Apply(Op.ITE, (condition, const(2**place), const(0)), Num())


def _whole(group: Sequence[tuple[int, int, Expr]], always: Sequence[int]) -> tuple[Expr, list[int]]:
    """Bits of one number as the number, if all others are ``always`` set; and which of these it uses."""
    first, _, base = group[0]
    shift = first - group[0][1]
    low, high = least_and_greatest(base)
    numbers = {number for number, _, _ in group}
    missing = [n for n in range(max(0, shift), int(high).bit_length()) if n not in numbers]
    if low < 0 or not set(missing) <= {place + shift for place in always} or len(group) < 2:
        if low >= 0 and shift == 0 and len(group) > 1 and numbers == set(range(len(numbers))):
            return Apply(Op.MOD, (base, const(2 ** len(numbers))), Num()), []
        bits = [
            _term(Apply(Op.BIT, (one, Const(number, Num())), Bool()), place) for number, place, one in group
        ]
        return reduce(lambda total, one: folded(total + one), bits), []
    moved = base
    if shift > 0:
        moved = Apply(Op.DIV, (base, const(2**shift)), Num())
    elif shift < 0:
        moved = folded(base * 2**-shift)
    for number in missing:
        unset = Apply(Op.BIT, (base, Const(number, Num())), Bool())
        moved = folded(moved + Apply(Op.ITE, (unset, const(0), const(2 ** (number - shift))), Num()))
    return moved, [number - shift for number in missing]


__all__ = ["bit_of_sum", "mask_terms", "masked"]
