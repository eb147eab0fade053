"""Formulas in MATLAB's action language: numbers are doubles, truth values logical, members enumerated."""

from collections.abc import Callable, Mapping, Sequence

from rovercheck.checker.export.slx.names import SlxNames
from rovercheck.spec_model.lang.chart import NOWHERE, Chart, Path
from rovercheck.spec_model.lang.domain import Bool, Domain, Enum, Num, boolean, show
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op

CHOICE = "chooseOne"
"""The function that is ``ite`` for numbers."""
CHOICE_SCRIPT = f"""function y = {CHOICE}(c, a, b)
if c
    y = a;
else
    y = b;
end
end"""
Word = Callable[[Temporal], str]
"""What is written for a temporal word."""


def no_words(word: Temporal) -> str:
    """Where none has a meaning."""
    raise ModelError(f"`{word}` stands where Stateflow has no such word; write it in a guard.")


class FormulaWriter:
    """Formulas of a system.

    ``states`` are the names of states in the chart that is written, by chart and path; those of a chart
    itself have the empty path.  ``read`` are the variables that were read since ``begin``; among them are
    signals that say whether states of other charts of Simulink are active, which are ``asked`` for.
    """

    def __init__(
        self, charts: Sequence[Chart], states: Mapping[tuple[str, Path], str], prefix: str = ""
    ) -> None:
        self.names, self.enumerations = SlxNames(prefix), dict[str, Mapping[str, int]]()
        self.states, self.chooses = states, False
        self.read: dict[str, Var] = {}
        self.asked: dict[str, tuple[str, Path]] = {}
        self._own = {chart.name for chart in charts}
        self._types = SlxNames()
        self._sorts: dict[Enum, str] = {}
        self._levels = {
            chart.location(path).name: (chart, path)
            for chart in charts
            for path, state in chart.states.items()
            if state.states and not state.parallel
        }
        self._entered = {chart.entered.name: chart for chart in charts}

    def begin(self, charts: Sequence[Chart]) -> None:
        """From now on write what stands in one chart of Simulink, in which these are."""
        self.read, self.asked, self.chooses = {}, {}, False
        self._own = {chart.name for chart in charts}

    def __call__(self, expr: Expr, word: Word = no_words) -> str:
        """The formula, without parentheses around it."""
        match expr:
            case Const(value, sort):
                return self.constant(value, sort)
            case Var(name):
                self.read[name] = expr
                return self.names(name)
            case Named(_, body):
                return self(body, word)
            case Temporal():
                return word(expr)
            case Apply(op, args, _):
                return self._applied(op, args, word)
        raise AssertionError(expr.__class__)

    def constant(self, value: int, sort: Bool | Enum | Num) -> str:
        """A raw value."""
        match sort:
            case Bool():
                return "true" if value else "false"
            case Enum() as enum:
                return f"{self.enumeration(enum)}.{self._member(enum, value)}"
            case Num(resolution, _):
                return show(value * resolution)

    def type_of(self, domain: Domain) -> str:
        """The type of data with these values."""
        match domain.sort:
            case Bool():
                return "boolean"
            case Enum() as enum:
                return f"Enum: {self.enumeration(enum)}"
            case _:
                return "double"

    def enumeration(self, enum: Enum) -> str:
        """The name of an enumeration, which is written into the dictionary."""
        if enum not in self._sorts:
            alike = sum(one.name == enum.name for one in self._sorts)
            name = self._types(f"{enum.name}_{alike + 1}" if alike else enum.name)
            self._sorts[enum] = name
            self.enumerations[name] = {self._member(enum, number): number for _, number in enum.members}
        return self._sorts[enum]

    def _member(self, enum: Enum, raw: int) -> str:
        names = SlxNames()
        return {number: names(member) for member, number in enum.members}[raw]

    def _inner(self, expr: Expr, word: Word) -> str:
        """As an operand: in parentheses, unless it is a name, a number or a call."""
        shown = self(expr, word)
        while isinstance(expr, Named) or (isinstance(expr, Apply) and expr.op is Op.SCALE):
            expr = expr.body if isinstance(expr, Named) else expr.args[0]
        plain = isinstance(expr, Var) or (isinstance(expr, Const) and not set("-/") & set(shown))
        called = isinstance(expr, Apply) and expr.op in CALLS
        return shown if plain or called else f"({shown})"

    def _applied(self, op: Op, args: Sequence[Expr], word: Word) -> str:
        if op in (Op.EQ, Op.NE):
            place = self._place(op, args)
            if place:
                return place
        if op is Op.ITE:
            return self._choice(args, word)
        if op in COMPARISONS and isinstance(args[0].sort, Enum):
            for at, arg in enumerate(args):
                body = arg.body if isinstance(arg, Named) else arg
                if isinstance(body, Apply) and body.op is Op.ITE:
                    test, *some = body.args
                    parts = [Apply(op, (*args[:at], one, *args[at + 1 :]), Bool()) for one in some]
                    return self._choice((test, *parts), word)
        shown = [self(one, word) if op in CALLS else self._inner(one, word) for one in args]
        return OPERATIONS[op](shown)

    def _choice(self, args: Sequence[Expr], word: Word) -> str:
        test, then, other = args
        if isinstance(then.sort, Num):
            self.chooses = True
            return OPERATIONS[Op.ITE]([self(one, word) for one in (test, then, other)])
        if isinstance(then.sort, Enum):
            raise ModelError(
                f"`{Apply(Op.ITE, tuple(args), then.sort)}` chooses a member within a formula; assign it."
            )
        inner = self._inner(test, word)
        return f"({inner} && {self._inner(then, word)}) || (~{inner} && {self._inner(other, word)})"

    def _place(self, op: Op, args: Sequence[Expr]) -> str:
        """Whether a state is active, where a formula asks for it."""
        found = {type(one): one for one in args}
        var, const = found.get(Var), found.get(Const)
        if not isinstance(var, Var) or not isinstance(const, Const):
            return ""
        if var.name in self._entered:
            own = self._active(self._entered[var.name], ())
            return own if (const.value == 1) == (op is Op.EQ) else f"~{own}"
        if var.name not in self._levels:
            return ""
        chart, path = self._levels[var.name]
        member = var.domain.show(const.value)
        if member == NOWHERE:
            some = (self._active(chart, (*path, one.name)) for one in chart.states[path].states)
            inside = " || ".join(some)
            return inside if op is Op.NE else f"~({inside})"
        own = self._active(chart, (*path, member))
        return own if op is Op.EQ else f"~{own}"

    def _active(self, chart: Chart, path: Path) -> str:
        if chart.name in self._own:
            return f"in({self.states[chart.name, path]})"
        signal = f"{'.'.join((chart.name, *path))} is active"
        self.read[signal] = Var(signal, boolean)
        self.asked[signal] = chart.name, path
        return self.names(signal)


def _call(name: str) -> Callable[[Sequence[str]], str]:
    return lambda args: f"{name}({', '.join(args)})"


def _between(sign: str) -> Callable[[Sequence[str]], str]:
    return sign.join


CALLS: Mapping[Op, str] = {Op.ABS: "abs", Op.MIN: "min", Op.MAX: "max", Op.MOD: "mod"}
OPERATIONS: Mapping[Op, Callable[[Sequence[str]], str]] = {
    Op.NOT: lambda args: f"~{args[0]}",
    Op.AND: _between(" && "),
    Op.OR: _between(" || "),
    Op.EQ: _between(" == "),
    Op.NE: _between(" ~= "),
    Op.LT: _between(" < "),
    Op.LE: _between(" <= "),
    Op.GT: _between(" > "),
    Op.GE: _between(" >= "),
    Op.ADD: _between(" + "),
    Op.SUB: _between(" - "),
    Op.NEG: lambda args: f"-{args[0]}",
    Op.MUL: _between("*"),
    Op.SCALE: lambda args: args[0],
    Op.DIV: lambda args: f"floor({args[0]} / {args[1]})",
    Op.BIT: lambda args: f"mod(floor({args[0]} / {2 ** int(args[1])}), 2) == 1",
    Op.ITE: _call(CHOICE),
    **{op: _call(name) for op, name in CALLS.items()},
}

__all__ = ["CHOICE", "CHOICE_SCRIPT", "FormulaWriter", "Word", "no_words"]
