"""Reading the formulas of a certificate: definitions in SMT-LIB that speak of one valuation only.

A certificate comes from outside, and its text becomes part of what a solver is asked.  So it is read token
by token: no command, no symbol of a tick and no second definition can hide in it.
"""

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Union

Term = Union[str, tuple["Term", ...]]
"""An atom, or a list of terms."""

Value = Union[bool, tuple[int, int]]
"""A truth value, or the unsigned number in a bit-vector and its width."""

_TOKEN = re.compile(r"\s*(?:([()])|(\|[^|\\]*\|)|([^\s()|;\"]+))")
_OWN = re.compile(r"\|:c\d+@0\|")


class Malformed(Exception):
    """A certificate says something that has no meaning; the message says what."""


def read(text: str) -> Term:
    """The one term that the text consists of.  Raises ``Malformed``."""
    stack: list[list[Term]] = [[]]
    position, text = 0, text.strip()
    while position < len(text):
        token = _TOKEN.match(text, position)
        if token is None or (token[0].strip() == ")" and len(stack) == 1):
            raise Malformed(f"{text[position : position + 20]!r} does not belong into a formula")
        position = token.end()
        if token[1] == "(":
            stack.append([])
        elif token[1] == ")":
            last = tuple(stack.pop())
            stack[-1].append(last)
        else:
            stack[-1].append(token[0].strip())
    if len(stack) != 1 or len(stack[0]) != 1:
        raise Malformed(f"{text[:40]!r} is not one complete term")
    return stack[0][0]


def definitions(lines: Sequence[str], known: Collection[str]) -> dict[str, Term]:
    """The bodies of definitions, by symbol: each of a new one, over ``known`` symbols and earlier ones.

    Raises ``Malformed``.
    """
    found: dict[str, Term] = {}
    for line in lines:
        match read(line):
            case ("define-fun", str(symbol), (), _, body) if _OWN.fullmatch(symbol) and symbol not in found:
                _checked(body, {*known, *found})
                found[symbol] = body
            case _:
                raise Malformed(f"{line[:60]!r} does not define a new symbol like |:c0@0|")
    return found


def _checked(term: Term, known: Collection[str]) -> None:
    """Raises ``Malformed`` unless every token is an operator, a literal or a known symbol."""
    match term:
        case "true" | "false":
            return
        case str(symbol) if symbol in known or re.fullmatch("#b[01]+", symbol):
            return
        case ("_", str(number), str(bits)) if re.fullmatch(r"bv\d+", number) and bits.isdecimal():
            return
        case (("_", "sign_extend", str(n)), arg) if n.isdecimal():
            return _checked(arg, known)
        case (("_", "extract", str(high), str(low)), arg) if high.isdecimal() and low.isdecimal():
            return _checked(arg, known)
        case (str(operator), *args) if operator in _MEANING and args:
            for arg in args:
                _checked(arg, known)
            return
    raise Malformed(f"{str(term)[:60]} is no formula over the valuation; only {sorted(_MEANING)} may be used")


# --- meaning -------------------------------------------------------------------------------------


def evaluate(term: Term, values: Mapping[str, Value]) -> Value:
    """The value of a term that was read by ``definitions`` (SMT-LIB 2.6, FixedSizeBitVectors).

    Raises ``Malformed`` where the sorts do not fit.
    """
    match term:
        case "true" | "false":
            return term == "true"
        case str(symbol):
            return values[symbol] if symbol in values else (int(symbol[2:], 2), len(symbol) - 2)
        case ("_", str(number), str(bits)):
            return int(number[2:]) % (1 << int(bits)), int(bits)
        case (("_", "sign_extend", str(more)), arg):
            number_, bits_ = _vector(evaluate(arg, values))
            return _signed((number_, bits_)) % (1 << bits_ + int(more)), bits_ + int(more)
        case (("_", "extract", str(high), str(low)), arg):
            size = int(high) - int(low) + 1
            return _vector(evaluate(arg, values))[0] >> int(low) & (1 << size) - 1, size
        case (str(operator), *args):
            return _MEANING[operator]([evaluate(arg, values) for arg in args])
    raise Malformed(f"{term} is no formula")


def _vector(value: Value) -> tuple[int, int]:
    if isinstance(value, bool):
        raise Malformed("a truth value stands where a bit-vector is needed")
    return value


def _truth(value: Value) -> bool:
    if not isinstance(value, bool):
        raise Malformed("a bit-vector stands where a truth value is needed")
    return value


def _signed(value: Value) -> int:
    number, bits = _vector(value)
    return number - (number >> bits - 1 << bits)


def _number(of: Callable[..., int]) -> Callable[[Sequence[Value]], Value]:
    """An operator on signed numbers of one width, the result in the same."""

    def applied(args: Sequence[Value]) -> Value:
        widths = {_vector(a)[1] for a in args}
        if len(widths) != 1:
            raise Malformed(f"bit-vectors of {sorted(widths)} bits meet in one operator")
        bits = widths.pop()
        return of(*map(_signed, args)) % (1 << bits), bits

    return applied


def _order(of: Callable[[int, int], bool]) -> Callable[[Sequence[Value]], Value]:
    return lambda args: of(*map(_signed, args))


def _quotient(a: int, b: int) -> int:
    """Rounded towards zero."""
    return (abs(a) // abs(b)) * (1 if (a < 0) == (b < 0) else -1) if b else (1 if a < 0 else -1)


_MEANING: dict[str, Callable[[Sequence[Value]], Value]] = {
    "and": lambda args: all(map(_truth, args)),
    "or": lambda args: any(map(_truth, args)),
    "not": lambda args: not _truth(args[0]),
    "=": lambda args: args[0] == args[1],
    "distinct": lambda args: args[0] != args[1],
    "ite": lambda args: args[1] if _truth(args[0]) else args[2],
    "bvadd": _number(lambda a, b: a + b),
    "bvsub": _number(lambda a, b: a - b),
    "bvneg": _number(lambda a: -a),
    "bvmul": _number(lambda a, b: a * b),
    "bvsdiv": _number(_quotient),
    "bvsmod": _number(lambda a, b: a % b if b else a),
    "bvslt": _order(lambda a, b: a < b),
    "bvsle": _order(lambda a, b: a <= b),
    "bvsgt": _order(lambda a, b: a > b),
    "bvsge": _order(lambda a, b: a >= b),
}
