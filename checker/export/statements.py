"""Programs of a step as text in the manner of C: the statements of the charts, one by one."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import count

from rovercheck.checker.export.flow import INT, ExportFlow, ExportReach
from rovercheck.checker.export.infix import Operand, Row, between, raised, written
from rovercheck.checker.system.intervals import Interval, postorder
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op


def _in_32_bits(row: Row) -> Row:
    """A division, unless what is divided may leave the numbers of Promela."""

    def checked(args: Sequence[Operand]) -> str:
        by = args[1].within.low
        if args[0].within.high + raised(*args)[1] * by not in INT:
            raise ModelError(
                f"{args[0].text} divided by {by} needs more than 32 bits; export to btor2 or aiger."
            )
        return row(args)

    return checked


_ALIKE = written("->", "0 - ", "%")
OPERATIONS: Mapping[Op, Row] = {
    **_ALIKE,
    Op.NOT: lambda args: f"(!{args[0].text})",  # `!!` is a word of its own
    Op.AND: between("&&"),
    Op.OR: between("||"),
    Op.DIV: _in_32_bits(_ALIKE[Op.DIV]),
    Op.MOD: _in_32_bits(_ALIKE[Op.MOD]),
    Op.BIT: lambda args: f"(({args[0].text} >> {args[1].text}) & 1)",
}


class Text:
    """Writes formulas and programs.

    Where an operator needs an argument twice, the argument is computed before the statement, into a
    variable of ``scratch``: formulas are total, so that this changes nothing.  Statements share these.
    """

    def __init__(self, names: Mapping[str, str], reach: ExportReach) -> None:
        self._names, self._reach = names, reach
        self._taken = frozenset(names.values())
        self.scratch: list[str] = []

    def program(self, program: Sequence[Action], flow: ExportFlow) -> Iterator[str]:
        """The statements, a line each; ``flow`` is brought to where the program ends."""
        for statement in program:
            if isinstance(statement, Assign):
                known = self._reach.intervals(statement.value, flow)
                before, value = self._value(statement.value, known)
                yield from before
                yield f"{self._names[statement.var.name]} = {value};"
                self._reach.assign(statement.var, known[id(statement.value)], flow)
            elif isinstance(statement, If):
                yield from self._branch(statement, flow)
            else:
                raise ModelError(f"`{statement}` is left in the step; lower the chart first.")

    def _branch(self, statement: If, flow: ExportFlow) -> Iterator[str]:
        before, test = self.value(statement.condition, flow)
        then, other = flow.copy(), flow.copy()
        yield from before
        yield from ("if", f":: {test} ->")
        yield from (f"    {line}" for line in [*self.program(statement.then, then)] or ["skip"])
        yield ":: else" + (" ->" if statement.otherwise else "")
        yield from (f"    {line}" for line in self.program(statement.otherwise, other))
        yield "fi;"
        flow.join(then, other)

    def value(self, expr: Expr, flow: ExportFlow) -> tuple[list[str], str]:
        """Statements to run first, and the text of a formula."""
        return self._value(expr, self._reach.intervals(expr, flow))

    def _value(self, expr: Expr, known: Mapping[int, Interval]) -> tuple[list[str], str]:
        before: list[str] = []
        done: dict[int, str] = {}
        for node in postorder(expr):
            done[id(node)] = self._node(node, done, known, before)
        return before, done[id(expr)]

    def _node(
        self, node: Expr, done: Mapping[int, str], known: Mapping[int, Interval], before: list[str]
    ) -> str:
        match node:
            case Const(value, _):
                return str(value) if value >= 0 else f"({value})"
            case Var(name):
                return self._names[name]
            case Named(_, body):
                return done[id(body)]
            case Apply(op, args, _):
                return OPERATIONS[op]([self._operand(done[id(a)], known[id(a)], before) for a in args])
        raise AssertionError(f"{node} speaks of the past")

    def _operand(self, text: str, within: Interval, before: list[str]) -> Operand:
        return Operand(text, lambda: self._kept(text, before), within)

    def _kept(self, text: str, before: list[str]) -> str:
        """A text that can be repeated."""
        if text.isidentifier() or text.strip("(-)").isdigit():
            return text
        if len(before) == len(self.scratch):
            fresh = (f"t{i}" for i in count(len(self.scratch)))
            self.scratch.append(next(n for n in fresh if n not in self._taken | {*self.scratch}))
        name = self.scratch[len(before)]
        before.append(f"{name} = {text};")
        return name
