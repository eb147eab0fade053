"""Formulas in SMT-LIB 2: truth values as Bool, numbers and enumerations as signed bit-vectors (QF_BV).

A bit-vector is as wide as what it stands for needs, and operators work in a width that holds arguments
and result, so nothing can overflow (Barrett, Fontaine, Tinelli, *The SMT-LIB Standard 2.6*, 2017).
"""

import re
from collections.abc import Callable, Mapping, Sequence

from rovercheck.checker.certify.terms import TRUTH, Sort
from rovercheck.checker.system.intervals import Interval, interval, postorder
from rovercheck.spec_model.lang.domain import Bool, Domain
from rovercheck.spec_model.lang.domain import Sort as Kind
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op

_SPECIAL = re.compile(r"[%|\\@:]|[^ -~]")


def quoted(name: str, at: int | None = None) -> str:
    """The symbol of a variable, ``at`` a number of ticks after the first state; frozen ones have none.

    What has a meaning of its own in a symbol is written as % and its code point, as in ``%40``.
    """
    plain = _SPECIAL.sub(lambda found: f"%{ord(found[0]):02X}", name)
    return f"|{plain}|" if at is None else f"|{plain}@{at}|"


def own(word: str, at: int) -> str:
    """A symbol that is no variable of the system: the colon occurs in none of those."""
    return f"|:{word}@{at}|"


def sort(domain: Domain) -> str:
    """The sort of a variable."""
    return "Bool" if isinstance(domain.sort, Bool) else f"(_ BitVec {width(domain)})"


def sort_bits(domain: Domain) -> Sort:
    """The same as a number."""
    return TRUTH if isinstance(domain.sort, Bool) else width(domain)


def width(domain: Domain) -> int:
    """Bits of a variable that is no truth value."""
    return Interval(domain.low, domain.high).width


def literal(value: int, of: Kind, bits: int) -> str:
    """A constant; ``bits`` is ignored for a truth value."""
    if isinstance(of, Bool):
        return "true" if value else "false"
    return f"(_ bv{value % (1 << bits)} {bits})"


def within(symbol: str, domain: Domain) -> str:
    """The formula that the symbol of a variable has a value of its domain."""
    return among(symbol, domain, _stretches(domain.values))


def among(symbol: str, domain: Domain, intervals: Sequence[tuple[int, int]]) -> str:
    """The formula that the symbol of a variable lies in one of the intervals, ends included."""
    return joined("or", [_between(symbol, domain, low, high) for low, high in intervals])


def _between(symbol: str, domain: Domain, low: int, high: int) -> str:
    if isinstance(domain.sort, Bool):
        return "true" if low < high else symbol if low else f"(not {symbol})"
    bits = width(domain)
    first, last = literal(low, domain.sort, bits), literal(high, domain.sort, bits)
    if low == high:
        return f"(= {symbol} {first})"
    return f"(and (bvsle {first} {symbol}) (bvsle {symbol} {last}))"


def _stretches(values: Sequence[int]) -> list[tuple[int, int]]:
    """The values as intervals."""
    if isinstance(values, range) and values.step == 1:
        return [(values[0], values[-1])]
    found: list[tuple[int, int]] = []
    for value in values:
        if found and value == found[-1][1] + 1:
            found[-1] = (found[-1][0], value)
        else:
            found.append((value, value))
    return found


def joined(word: str, parts: Sequence[str]) -> str:
    """``and`` or ``or`` of any number of formulas."""
    if len(parts) < 2:
        return parts[0] if parts else "true" if word == "and" else "false"
    return f"({word} {' '.join(parts)})"


def define(symbol: str, of: str, body: str) -> str:
    return f"(define-fun {symbol} () {of} {body})"


class Printer:
    """Names nodes once each; ``lines`` are the definitions so far, of which each uses earlier ones only.

    ``symbols`` gives the symbol of each variable, by name, ``at`` the suffix of the nodes' own names.
    """

    def __init__(self, symbols: Mapping[str, str], at: int, word: str = "t") -> None:
        self.lines: list[str] = []
        self._symbols, self._at, self._word = symbols, at, word
        self._text: dict[int, str] = {}
        self._range: dict[int, Interval] = {}

    def boolean(self, expr: Expr) -> str:
        """A formula that is a truth value."""
        self._print(expr)
        return self._text[id(expr)]

    def value(self, expr: Expr, domain: Domain) -> str:
        """A formula in the sort of a variable of that domain, cut to its width."""
        self._print(expr)
        text = self._text[id(expr)]
        return text if isinstance(domain.sort, Bool) else self.fitted(expr, width(domain))

    def fits(self, expr: Expr, domain: Domain) -> str:
        """The formula that the value, before it is cut to its width, belongs to the domain."""
        self._print(expr)
        if isinstance(domain.sort, Bool):
            return within(self._text[id(expr)], domain)
        own = self._range[id(expr)] | Interval(domain.low, domain.high)
        wide = Domain(domain.sort, range(own.low, own.high + 1))
        return among(self.fitted(expr, own.width), wide, _stretches(domain.values))

    def _print(self, root: Expr) -> None:
        for node in postorder(root):
            if id(node) not in self._text:
                self._range[id(node)] = interval(node, self._range)
                self._text[id(node)] = self._node(node)

    def _node(self, node: Expr) -> str:
        match node:
            case Const(value, of):
                return literal(value, of, self._range[id(node)].width)
            case Var(name):
                return self._symbols[name]
            case Named(_, body):
                return self._text[id(body)]
            case Apply(op, args, of):
                name = own(f"{self._word}{len(self.lines)}", self._at)
                bits = self._range[id(node)].width
                sort = "Bool" if isinstance(of, Bool) else f"(_ BitVec {bits})"
                self.lines.append(define(name, sort, OPERATIONS[op](self, args, bits)))
                return name
        raise ModelError(f"`{node}` speaks of the past; lower the chart or reduce the property first.")

    def texts(self, args: Sequence[Expr]) -> list[str]:
        return [self._text[id(a)] for a in args]

    def range(self, expr: Expr) -> Interval:
        return self._range[id(expr)]

    def fitted(self, arg: Expr, bits: int) -> str:
        """A number in another width that holds its value."""
        return _resized(self._text[id(arg)], self._range[id(arg)].width, bits)


def _resized(text: str, bits: int, to: int) -> str:
    """A signed bit-vector in another width that holds its value."""
    if to == bits:
        return text
    return f"((_ sign_extend {to - bits}) {text})" if to > bits else f"((_ extract {to - 1} 0) {text})"


Row = Callable[[Printer, Sequence[Expr], int], str]
"""The text of an operator on printed formulas; a number has that many bits."""


def _junction(word: str) -> Row:
    return lambda printer, args, bits: joined(word, printer.texts(args))


def _compared(word: str) -> Row:
    def row(printer: Printer, args: Sequence[Expr], bits: int) -> str:
        if isinstance(args[0].sort, Bool):
            return f"({word} {' '.join(printer.texts(args))})"
        common = max(printer.range(a).width for a in args)
        return f"({word} {' '.join(printer.fitted(a, common) for a in args)})"

    return row


def _chosen(printer: Printer, args: Sequence[Expr], bits: int) -> str:
    test, *branches = args
    truths = isinstance(branches[0].sort, Bool)
    texts = printer.texts(branches) if truths else [printer.fitted(a, bits) for a in branches]
    return f"(ite {' '.join(printer.texts([test]) + texts)})"


def _computed(compute: Callable[..., str], more: int = 0) -> Row:
    """In a width that holds arguments and result, and so many bits ``more``."""

    def row(printer: Printer, args: Sequence[Expr], bits: int) -> str:
        inner = max(bits, *(printer.range(a).width for a in args)) + more
        return _resized(compute(*(printer.fitted(a, inner) for a in args)), inner, bits)

    return row


def _bit(printer: Printer, args: Sequence[Expr], bits: int) -> str:
    index = printer.range(args[1]).low
    wide = max(printer.range(args[0]).width, index + 1)
    return f"(= #b1 ((_ extract {index} {index}) {printer.fitted(args[0], wide)}))"


OPERATIONS: Mapping[Op, Row] = {
    Op.NOT: lambda printer, args, bits: f"(not {printer.texts(args)[0]})",
    Op.AND: _junction("and"),
    Op.OR: _junction("or"),
    Op.ITE: _chosen,
    Op.EQ: _compared("="),
    Op.NE: _compared("distinct"),
    Op.LT: _compared("bvslt"),
    Op.LE: _compared("bvsle"),
    Op.GT: _compared("bvsgt"),
    Op.GE: _compared("bvsge"),
    Op.ADD: _computed(lambda a, b: f"(bvadd {a} {b})"),
    Op.SUB: _computed(lambda a, b: f"(bvsub {a} {b})"),
    Op.NEG: _computed(lambda a: f"(bvneg {a})"),
    Op.MUL: _computed(lambda a, b: f"(bvmul {a} {b})"),
    Op.SCALE: _computed(lambda a, b: f"(bvmul {a} {b})"),
    # Rounded down; the divisor is positive, and one more bit holds the multiple below the least value.
    Op.DIV: _computed(lambda a, b: f"(bvsdiv (bvsub {a} (bvsmod {a} {b})) {b})", more=1),
    Op.MOD: _computed(lambda a, b: f"(bvsmod {a} {b})"),  # the sign of the divisor: never negative
    Op.ABS: _computed(lambda a: f"(ite (bvslt {a} (bvneg {a})) (bvneg {a}) {a})"),
    Op.MIN: _computed(lambda a, b: f"(ite (bvsle {a} {b}) {a} {b})"),
    Op.MAX: _computed(lambda a, b: f"(ite (bvsle {a} {b}) {b} {a})"),
    Op.BIT: _bit,
}
"""Every operator in SMT-LIB, written apart from what the engines make of it."""
