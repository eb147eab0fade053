"""Programs of a step as text in the manner of C: the statements of the charts, one by one."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import count

from rovercheck.checker.export.flow import INT, ExportFlow, ExportReach
from rovercheck.checker.system.intervals import Interval, postorder
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op

SIGNS = {
    Op.AND: "&&", Op.OR: "||", Op.EQ: "==", Op.NE: "!=", Op.LT: "<", Op.LE: "<=", Op.GT: ">", Op.GE: ">=",
    Op.ADD: "+", Op.SUB: "-", Op.MUL: "*", Op.SCALE: "*",
}  # fmt: skip


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
                return self._apply(op, [done[id(a)] for a in args], [known[id(a)] for a in args], before)
        raise AssertionError(f"{node} speaks of the past")

    def _apply(self, op: Op, args: Sequence[str], ranges: Sequence[Interval], before: list[str]) -> str:
        if op in SIGNS:
            return f"({f' {SIGNS[op]} '.join(args)})"
        match op:
            case Op.NOT:
                return f"(!{args[0]})"  # `!!` is a word of its own
            case Op.NEG:
                return f"(0 - {args[0]})"
            case Op.ITE:
                return f"({args[0]} -> {args[1]} : {args[2]})"
            case Op.BIT:
                return f"(({args[0]} >> {args[1]}) & 1)"
            case Op.DIV | Op.MOD:
                return self._quotient(op, args, ranges)
        return self._twice(op, [self._kept(a, before) for a in args])

    @staticmethod
    def _quotient(op: Op, args: Sequence[str], ranges: Sequence[Interval]) -> str:
        """Division rounds towards 0 in C and down in ours: of numbers that are not negative, both do."""
        by = ranges[1].low
        up = -(min(ranges[0].low, 0) // by)
        if ranges[0].high + up * by not in INT:
            raise ModelError(f"{args[0]} divided by {by} needs more than 32 bits; export to btor2 or aiger.")
        above = f"({args[0]} + {up * by})" if up else args[0]
        if op is Op.MOD:
            return f"({above} % {by})"
        return f"({above} / {by} - {up})" if up else f"({above} / {by})"

    @staticmethod
    def _twice(op: Op, args: Sequence[str]) -> str:
        match op:
            case Op.ABS:
                return f"({args[0]} >= 0 -> {args[0]} : 0 - {args[0]})"
            case Op.MIN:
                return f"({args[0]} <= {args[1]} -> {args[0]} : {args[1]})"
            case Op.MAX:
                return f"({args[0]} >= {args[1]} -> {args[0]} : {args[1]})"
        raise AssertionError(op)

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
