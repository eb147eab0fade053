"""Reading the formulas of a certificate: definitions in SMT-LIB that speak of one state only.

A certificate comes from outside, and its text becomes part of what a solver is asked.  So it is read token
by token: no command, no symbol of a tick and no second definition can hide in it, and every term has a sort.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Union

Term = Union[str, tuple["Term", ...]]
"""An atom, or a list of terms."""

Value = Union[bool, tuple[int, int]]
"""A truth value, or the unsigned number in a bit-vector and its width."""

Sort = int
"""The bits of a bit-vector, or ``TRUTH``."""

TRUTH: Sort = 0
"""The sort of truth values."""

DEEPEST = 100
"""Parentheses that may be open at once: engines write a definition for every operator, so that few are."""
WIDEST = 99_999
"""Bits of the widest bit-vector that is read."""

_BLANK = " \t\r\n"
_TOKEN = re.compile(rf"[{_BLANK}]*(?:([()])|(\|[^|\\]*\|)|([^{_BLANK}()|;\"]+))")
_OWN = re.compile(r"\|:c[0-9]+@0\|")
_BITS = re.compile(r"[0-9]{1,5}")
_VALUE = re.compile(r"bv[0-9]{1,4000}")


class Malformed(Exception):
    """A certificate says something that has no meaning; the message says what."""


def read(text: str) -> Term:
    """The one term that the text consists of.  Raises ``Malformed``."""
    stack: list[list[Term]] = [[]]
    position, text = 0, text.strip(_BLANK)
    while position < len(text):
        token = _TOKEN.match(text, position)
        if token is None or (token[1] == ")" and len(stack) == 1):
            raise Malformed(f"{text[position : position + 20]!r} does not belong into a formula")
        if len(stack) > DEEPEST:
            raise Malformed(f"{text[:40]!r} opens more than {DEEPEST} parentheses at once")
        position = token.end()
        if token[1] == "(":
            stack.append([])
        elif token[1] == ")":
            last = tuple(stack.pop())
            stack[-1].append(last)
        else:
            stack[-1].append(token[2] or token[3])
    if len(stack) != 1 or len(stack[0]) != 1:
        raise Malformed(f"{text[:40]!r} is not one complete term")
    return stack[0][0]


def definitions(lines: Sequence[str], known: Mapping[str, Sort]) -> tuple[dict[str, Term], dict[str, Sort]]:
    """The bodies of definitions, by symbol, and the sorts of all symbols.

    Each defines a new one, over the ``known`` symbols and earlier ones.  Raises ``Malformed``.
    """
    found, sorts = dict[str, Term](), dict(known)
    for line in lines:
        match read(line):
            case ("define-fun", str(symbol), (), of, body) if _OWN.fullmatch(symbol) and symbol not in found:
                sorts[symbol] = sort_of(body, sorts)
                if _named(sorts[symbol]) != of:
                    raise Malformed(f"{line[:60]!r} gives {symbol} another sort than its formula has")
                found[symbol] = body
            case _:
                raise Malformed(f"{line[:60]!r} does not define a new symbol like |:c0@0|")
    return found, sorts


def _named(sort: Sort) -> Term:
    return "Bool" if sort == TRUTH else ("_", "BitVec", str(sort))


def sort_of(term: Term, known: Mapping[str, Sort]) -> Sort:
    """The sort of a term whose symbols have the ``known`` ones (SMT-LIB 2.6, FixedSizeBitVectors).

    Raises ``Malformed`` unless every token is an operator, a literal or a known symbol, and the sorts fit.
    """
    found: Sort | None = None
    match term:
        case "true" | "false":
            found = TRUTH
        case str(symbol):
            found = known.get(symbol) if not re.fullmatch("#b[01]+", symbol) else len(symbol) - 2
        case ("_", str(number), str(bits)) if _VALUE.fullmatch(number) and _BITS.fullmatch(bits):
            found = int(bits) or None
        case (("_", "sign_extend", str(more)), arg) if _BITS.fullmatch(more):
            found = _vector(arg, known) + int(more)
        case (("_", "extract", str(high), str(low)), arg) if _BITS.fullmatch(high) and _BITS.fullmatch(low):
            found = int(high) - int(low) + 1 if int(low) <= int(high) < _vector(arg, known) else None
        case (str(operator), *args) if operator in _MEANING:
            found = _applied(operator, [sort_of(arg, known) for arg in args])
    if found is None or found > WIDEST:
        raise Malformed(f"{str(term)[:60]} is no formula over the state; only {sorted(_MEANING)} may be used")
    return found


def _vector(term: Term, known: Mapping[str, Sort]) -> Sort:
    found = sort_of(term, known)
    if found == TRUTH:
        raise Malformed(f"{str(term)[:60]} is a truth value where a bit-vector is needed")
    return found


def _applied(operator: str, args: Sequence[Sort]) -> Sort | None:
    """The sort of an operator's result; None where it does not take arguments of these sorts."""
    alike, truths = len(set(args)) == 1, set(args) == {TRUTH}
    match operator, args:
        case "not", [_] if truths:
            return TRUTH
        case (("and" | "or"), [_, _, *_]) if truths:
            return TRUTH
        case (("=" | "distinct"), [_, _]) if alike:
            return TRUTH
        case "ite", [test, then, other] if test == TRUTH and then == other:
            return then
        case "bvneg", [bits] if not truths:
            return bits
        case (("bvslt" | "bvsle" | "bvsgt" | "bvsge"), [_, _]) if alike and not truths:
            return TRUTH
        case (("bvadd" | "bvsub" | "bvmul" | "bvsdiv" | "bvsmod"), [bits, _]) if alike and not truths:
            return bits
    return None


# --- meaning -------------------------------------------------------------------------------------


def evaluate(term: Term, values: Mapping[str, Value]) -> Value:
    """The value of a term that was read by ``definitions`` (SMT-LIB 2.6, FixedSizeBitVectors)."""
    match term:
        case "true" | "false":
            return term == "true"
        case str(symbol):
            return values[symbol] if symbol in values else (int(symbol[2:], 2), len(symbol) - 2)
        case ("_", str(number), str(bits)):
            return int(number[2:]) % (1 << int(bits)), int(bits)
        case (("_", "sign_extend", str(more)), arg):
            value = evaluate(arg, values)
            bits_ = _pair(value)[1] + int(more)
            return _signed(value) % (1 << bits_), bits_
        case (("_", "extract", str(high), str(low)), arg):
            size = int(high) - int(low) + 1
            return _pair(evaluate(arg, values))[0] >> int(low) & (1 << size) - 1, size
        case (str(operator), *args):
            return _MEANING[operator]([evaluate(arg, values) for arg in args])
    raise AssertionError(f"{term} was not read")


def _pair(value: Value) -> tuple[int, int]:
    assert not isinstance(value, bool), "sorts fit in what was read"
    return value


def _signed(value: Value) -> int:
    number, bits = _pair(value)
    return number - (number >> bits - 1 << bits)


def _number(of: Callable[..., int]) -> Callable[[Sequence[Value]], Value]:
    """An operator on signed numbers of one width, the result in the same."""

    def applied(args: Sequence[Value]) -> Value:
        bits = _pair(args[0])[1]
        return of(*map(_signed, args)) % (1 << bits), bits

    return applied


def _order(of: Callable[[int, int], bool]) -> Callable[[Sequence[Value]], Value]:
    return lambda args: of(*map(_signed, args))


def _quotient(a: int, b: int) -> int:
    """Rounded towards zero."""
    return (abs(a) // abs(b)) * (1 if (a < 0) == (b < 0) else -1) if b else (1 if a < 0 else -1)


_MEANING: dict[str, Callable[[Sequence[Value]], Value]] = {
    "and": all,
    "or": any,
    "not": lambda args: not args[0],
    "=": lambda args: args[0] == args[1],
    "distinct": lambda args: args[0] != args[1],
    "ite": lambda args: args[1] if args[0] else args[2],
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
