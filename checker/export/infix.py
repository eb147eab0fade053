"""Operators as SMV and Promela write them, in the manner of C: signs between values, choices with a colon."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.system.intervals import Interval
from rovercheck.spec_model.lang.operators import SIGNS, Op


@dataclass(frozen=True)
class Operand:
    """The text of an argument, one that can be repeated, and the interval of its value."""

    text: str
    again: Callable[[], str]
    within: Interval


Row = Callable[[Sequence[Operand]], str]


def between(sign: str) -> Row:
    return lambda args: f"({f' {sign} '.join(a.text for a in args)})"


def written(then: str, minus: str, remainder: str) -> Mapping[Op, Row]:
    """What a language writes like the others but for its signs: one after a condition, one before a negated
    number, one for the remainder of a division."""

    def choice(test: str, a: str, b: str) -> str:
        return f"({test} {then} {a} : {b})"

    def extreme(sign: str) -> Row:
        def row(args: Sequence[Operand]) -> str:
            a, b = (operand.again() for operand in args)
            return choice(f"{a} {sign} {b}", a, b)

        return row

    def absolute(args: Sequence[Operand]) -> str:
        a = args[0].again()
        return choice(f"{a} >= 0", a, f"{minus}{a}")

    return {
        **{op: between(sign) for op, sign in SIGNS.items()},
        Op.ITE: lambda args: choice(*(a.text for a in args)),
        Op.NEG: lambda args: f"({minus}{args[0].text})",
        Op.DIV: _quotient,
        Op.MOD: lambda args: f"({raised(*args)[0]} {remainder} {args[1].within.low})",
        Op.ABS: absolute,
        Op.MIN: extreme("<="),
        Op.MAX: extreme(">="),
    }


def _quotient(args: Sequence[Operand]) -> str:
    """Division rounds towards 0 elsewhere and down in ours: of numbers that are not negative, both do."""
    above, times = raised(*args)
    quotient = f"{above} / {args[1].within.low}"
    return f"({quotient} - {times})" if times else f"({quotient})"


def raised(number: Operand, divisor: Operand) -> tuple[str, int]:
    """The number plus so many times the divisor, a positive constant, that it is never negative; how many."""
    by = divisor.within.low
    times = -(min(number.within.low, 0) // by)
    return (f"({number.text} + {times * by})" if times else number.text), times


def whole(value: int) -> Operand:
    """A number that is not negative."""
    return Operand(str(value), lambda: str(value), Interval(value, value))
