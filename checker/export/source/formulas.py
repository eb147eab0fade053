"""Formulas and actions as they are written in Python, and which words they take."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from rovercheck.checker.export.source.layout import Call, Keyword, Source, call, listed, quoted
from rovercheck.spec_model.lang.action import Action, Assign, If, Send
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.domain import Bool, Enum, Num, show
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var, When
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.walk import plain, structure

LONGEST = 60
"""Letters of a conjunction that is written with signs between its parts."""
_COMPARED, _OR, _AND, _SUM, _PRODUCT, _SIGN, _ATOM = range(7)
"""How tightly Python binds, loosest first."""


@dataclass
class FormulaSource:
    """Writes formulas.

    ``names`` are those of variables, ``formulas`` of named formulas by name and structure, ``members`` of
    enumerations.  ``used`` are the words of rovercheck that were written.
    """

    names: Mapping[str, str]
    formulas: Mapping[object, str]
    members: Mapping[Enum, str]
    charts: Mapping[str, tuple[str, Chart, Path]] = field(default_factory=dict)
    """Of the variables that say which state is active the word of the chart, and the path of the level."""
    used: set[str] = field(default_factory=set)

    def word(self, name: str) -> str:
        """A word of rovercheck, which the module then imports."""
        self.used.add(name)
        return name

    def formula(self, expr: Expr) -> Source:
        """A formula; long conditions are written with ``all_of`` and ``any_of``."""
        match expr:
            case Const():
                return self._constant(expr)
            case Apply(Op.AND | Op.OR as op, args) if len(self.text(expr)) > LONGEST:
                return call(self.word("all_of" if op is Op.AND else "any_of"), *map(self.formula, args))
            case Apply(Op.ITE, args) if len(self.text(expr)) > LONGEST:
                return call(self.word("ite"), *map(self.formula, args[:1]), *self.branches(args[1:]))
            case Apply(Op.MIN | Op.MAX as op, args) if len(self.text(expr)) > LONGEST:
                word = self.word("minimum" if op is Op.MIN else "maximum")
                return call(word, *(self._plain(one) for one in args))
        return self.text(expr)

    def _plain(self, expr: Expr) -> Source:
        return self._value(expr) if isinstance(expr, Const) else self.formula(expr)

    def text(self, expr: Expr, above: int = _COMPARED) -> str:
        """The same in one line, in parentheses where what is around it binds as tightly."""
        match expr:
            case Const():
                return self._constant(expr)
            case Var(name):
                if name not in self.names:
                    raise ModelError(f"`{name}` says which states are active in a way that has no words")
                return self.names[name]
            case Named(name, body):
                known = self.formulas.get((name, structure(body)))
                return self.text(body, above) if known is None else known
            case Temporal():
                return self._temporal(expr, above)
            case Apply(op, args, _):
                return self._applied(op, args, above)
        raise AssertionError(expr.__class__)

    def _constant(self, expr: Const) -> str:
        """A constant that stands alone, where Python has to know that it is a formula."""
        match expr.sort:
            case Bool():
                return self.word("TRUE" if expr.value else "FALSE")
            case Enum() as enum:
                return f"{self.word('member')}({self.members[enum]}, {quoted(enum.member(expr.value))})"
        return f"{self.word('const')}({self._value(expr)})"

    def _value(self, expr: Const) -> str:
        """A constant beside a formula."""
        match expr.sort:
            case Bool():
                return "True" if expr.value else "False"
            case Enum() as enum:
                return quoted(enum.member(expr.value))
            case Num(resolution, _):
                return number_text(expr.value * resolution)

    def beside(self, expr: Expr, other: Expr, above: int) -> str:
        """A formula as an operand: a constant is plain beside what is none."""
        if isinstance(plain(expr), Const) and isinstance(plain(other), Const):
            return self.text(expr, above)
        if not isinstance(expr, Const):
            return self.text(expr, above)
        shown = self._value(expr)
        return f"({shown})" if shown.startswith("-") and above > _SUM else shown

    def _active(self, op: Op, args: Sequence[Expr]) -> str:
        """``chart.active("STATE")`` where a formula asks whether a state is active."""
        match op, *args:
            case ((Op.EQ | Op.NE), Var(name), Const(value, Enum() as enum)) if name in self.charts:
                word, chart, level = self.charts[name]
                first = chart.states[level].states[0].name
                path = (*level, first if name == chart.entered.name else enum.member(value))
                if path in chart.states and (name != chart.entered.name or value == 1):
                    shown = f"{word}.active({quoted('.'.join(path))})"
                    return shown if op is Op.EQ else f"~{shown}"
        return ""

    def _applied(self, op: Op, args: Sequence[Expr], above: int) -> str:
        if active := self._active(op, args):
            return _within(active, _SIGN if active.startswith("~") else _ATOM, above)
        return OPERATIONS[op](self, args, above)

    def branches(self, args: Sequence[Expr]) -> list[str]:
        """Both values of a choice; of two members the first must say its enumeration."""
        one, other = args
        if isinstance(one, Const) and isinstance(other, Const) and not isinstance(one.sort, Num):
            return [self.text(one), self._value(other)]
        return [self._value(arg) if isinstance(arg, Const) else self.text(arg) for arg in args]

    def _temporal(self, word: Temporal, above: int) -> str:
        span = "" if word.span is None else self.span(word.span)
        arg = "" if word.arg is None else self.text(word.arg)
        match word.when:
            case When.AFTER:
                return f"{self.word('after')}({span})"
            case When.DURATION:
                shown = f"{self.word('duration')}({arg}) {'>' if word.strict else '>='} {span}"
                return f"({shown})" if above else shown
            case When.HELD:
                return f"{self.word('held')}({arg}, {span})"
        return f"{self.word(word.when.value)}({arg})"

    def span(self, span: Span) -> str:
        """``3 * sec``, ``20 * ms``, ``2 * ticks``."""
        if span.unit == "ticks":
            return f"{number_text(span.amount)} * {self.word('ticks')}"
        if span.amount % 1000 == 0:
            return f"{number_text(span.amount / 1000)} * {self.word('sec')}"
        return f"{number_text(span.amount)} * {self.word('ms')}"

    # --- actions -------------------------------------------------------------------------------------------

    def actions(self, actions: Sequence[Action]) -> Call:
        """A list of actions."""
        return listed([self._action(one) for one in actions])

    def _action(self, action: Action) -> Source:
        match action:
            case Assign(var, Const() as value):
                return call(self.word("assign"), self.names[var.name], self._value(value))
            case Assign(var, value):
                return call(self.word("assign"), self.names[var.name], self.formula(value))
            case If(condition, then, otherwise):
                more = [Keyword("otherwise", self.actions(otherwise))] if otherwise else []
                return call(self.word("when"), self.formula(condition), self.actions(then), *more)
            case Send(event, receiver):
                return call(self.word("send"), quoted(event), quoted(receiver))


Row = Callable[[FormulaSource, Sequence[Expr], int], str]
"""Writes an operator with its arguments, in parentheses where what is around it binds as tightly."""


def _between(sign: str, level: int, first: int) -> Row:
    """A sign between two values, of which the left one binds at least as tightly as ``first``."""

    def row(source: FormulaSource, args: Sequence[Expr], above: int) -> str:
        one, other = args
        left, right = source.beside(one, other, first), source.beside(other, one, level + 1)
        return _within(f"{left} {sign} {right}", level, above)

    return row


def _joined(sign: str, level: int) -> Row:
    return lambda source, args, above: _within(
        sign.join(source.text(one, level + 1) for one in args), level, above
    )


def _before(sign: str) -> Row:
    return lambda source, args, above: _within(f"{sign}{source.text(args[0], _ATOM)}", _SIGN, above)


def _called(word: str) -> Row:
    def row(source: FormulaSource, args: Sequence[Expr], _: int) -> str:
        shown = [source.text(args[0])] if len(args) == 1 else [
            source.beside(args[0], args[1], _COMPARED), source.beside(args[1], args[0], _COMPARED)
        ]  # fmt: skip
        return f"{source.word(word)}({', '.join(shown)})"

    return row


def _quotient(source: FormulaSource, args: Sequence[Expr], above: int) -> str:
    if args[0].sort != Num():
        raise ModelError(
            f"`{Apply(Op.DIV, tuple(args), Num())}` rounds a fraction, for which a chart has no word: "
            "round it in a function block outside, or give its data a resolution that needs none"
        )
    return _called("quotient")(source, args, above)


def _choice(source: FormulaSource, args: Sequence[Expr], _: int) -> str:
    return f"{source.word('ite')}({source.text(args[0])}, {', '.join(source.branches(args[1:]))})"


OPERATIONS: Mapping[Op, Row] = {
    Op.OR: _joined(" | ", _OR),
    Op.AND: _joined(" & ", _AND),
    **{op: _between(op.value, _COMPARED, _COMPARED + 1) for op in COMPARISONS},
    Op.ADD: _between("+", _SUM, _SUM),
    Op.SUB: _between("-", _SUM, _SUM),
    Op.MUL: _between("*", _PRODUCT, _PRODUCT),
    Op.NOT: _before("~"),
    Op.NEG: _before("-"),
    Op.SCALE: lambda source, args, above: source.text(args[0], above),
    Op.ITE: _choice,
    Op.DIV: _quotient,
    Op.MOD: _called("modulo"),
    Op.ABS: _called("absolute"),
    Op.MIN: _called("minimum"),
    Op.MAX: _called("maximum"),
    Op.BIT: _called("bit"),
}
"""Every operator as it is written in Python."""


def _within(shown: str, level: int, above: int) -> str:
    return f"({shown})" if above > level else shown


def number_text(value: Fraction) -> str:
    """A number as Python has it; a fraction that no decimal is, as a text."""
    shown = show(value)
    return quoted(shown) if "/" in shown else shown


__all__ = ["FormulaSource", "number_text"]
