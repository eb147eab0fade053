"""The BTOR2 format: signed bit-vectors, each as wide as the values of its formula need.

Aina Niemetz, Mathias Preiner, Clifford Wolf, Armin Biere: BTOR2, BtorMC and Boolector 3.0, CAV 2018.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.export.machine import ExportMachine, machine, meaning
from rovercheck.checker.export.names import one_line, symbols
from rovercheck.checker.export.problem import Problem
from rovercheck.checker.system.intervals import Interval, interval, postorder
from rovercheck.spec_model.lang.domain import Bool, Sort
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op

NAME = "btor2"
SUFFIX = "btor2"
SUMMARY = "BTOR2: words, for AVR, Pono, BtorMC and other word-level model checkers"


def export(problem: Problem) -> str:
    """The problem as text: states, inputs, their domains and assumptions as constraints, bad states."""
    made = machine(problem)
    writer = _Writer(made)
    writer.machine(made)
    header = "".join(f"; {line}\n" for line in problem.header)
    return header + "".join(f"{line}\n" for line in writer.lines)


@dataclass(frozen=True)
class Word:
    """The number of a node and its width; a truth value is one bit wide."""

    id: int
    bits: int


def bits_of(var: Var) -> int:
    """The width of a variable: one bit for a truth value, or the narrowest signed word."""
    return 1 if isinstance(var.sort, Bool) else Interval(var.domain.low, var.domain.high).width


class _Writer:
    """Lines of a file; equal nodes are written once."""

    def __init__(self, made: ExportMachine) -> None:
        self.lines: list[str] = []
        self._known: dict[str, int] = {}
        self._value: dict[int, int] = {}
        self._last = 0
        self._variables: dict[str, Word] = {}
        self._range: dict[int, Interval] = {}
        self._done: dict[int, Word] = {}
        every = (*made.frozen, *made.states, *made.inputs)
        self._symbols = symbols([*(v.name for v in every), *(f"bad {name}" for name, _ in made.bad)])

    # --- lines -------------------------------------------------------------------------------------

    def _line(self, text: str, after: str = "") -> int:
        self._last += 1
        self.lines.append(f"{self._last} {text}{after}")
        return self._last

    def _once(self, text: str) -> int:
        if text not in self._known:
            self._known[text] = self._line(text)
        return self._known[text]

    def _sort(self, bits: int) -> int:
        return self._once(f"sort bitvec {bits}")

    def node(self, op: str, bits: int, *args: Word | int) -> Word:
        """An operator applied to nodes (and plain numbers), with a result of that width."""
        operands = " ".join(str(a.id if isinstance(a, Word) else a) for a in args)
        return Word(self._once(f"{op} {self._sort(bits)} {operands}"), bits)

    def const(self, value: int, bits: int) -> Word:
        word = self.node("constd", bits, value)
        self._value[word.id] = value
        return word

    def fitted(self, a: Word, bits: int) -> Word:
        """The word in another width that holds its value."""
        if a.bits == bits:
            return a
        if a.id in self._value:
            return self.const(self._value[a.id], bits)
        if a.bits < bits:
            return self.node("sext", bits, a, bits - a.bits)
        return self.node("slice", bits, a, bits - 1, 0)

    def _several(self, op: str, args: Sequence[Word]) -> Word:
        first, *others = args
        for other in others:
            first = self.node(op, 1, first, other)
        return first

    # --- the machine -------------------------------------------------------------------------------

    def machine(self, made: ExportMachine) -> None:
        """Write everything; a frozen variable is a state that starts anywhere and keeps its value."""
        for var in made.states:  # readers want the value of an init before its state
            self.const(var.init, bits_of(var))
        for var in (*made.frozen, *made.states):
            self._declare("state", var)
        for var in made.inputs:
            self._declare("input", var)
        for var in (*made.frozen, *made.inputs):
            for condition in self._domain(var):
                self._line(f"constraint {condition.id}")
        for formula in made.assume:
            self._line(f"constraint {self(formula).id}")
        for var in made.frozen:
            word = self._variables[var.name]
            self._line(f"next {self._sort(word.bits)} {word.id} {word.id}")
        for var in made.states:
            self._state(var, made.next[var.name])
        for name, formula in made.bad:
            self._line(f"bad {self(formula).id} {self._symbols[f'bad {name}']}")

    def _declare(self, kind: str, var: Var) -> None:
        bits = bits_of(var)
        said = one_line(meaning(var))
        line = f"{kind} {self._sort(bits)} {self._symbols[var.name]}"
        self._variables[var.name] = Word(self._line(line, f" ; {said}" if said else ""), bits)

    def _state(self, var: Var, following: Expr) -> None:
        word = self._variables[var.name]
        start = self.const(var.init, word.bits)
        self._line(f"init {self._sort(word.bits)} {word.id} {start.id}")
        after = self.fitted(self(following), word.bits)
        self._line(f"next {self._sort(word.bits)} {word.id} {after.id}")

    def _domain(self, var: Var) -> list[Word]:
        """Conditions that confine a variable to its domain."""
        word, domain = self._variables[var.name], var.domain
        if isinstance(domain.sort, Bool) and len(domain) == 2:
            return []
        if not domain.dense or isinstance(domain.sort, Bool):
            same = [self.node("eq", 1, word, self.const(v, word.bits)) for v in domain.values]
            return [self._several("or", same)]
        least, most = self.const(domain.low, word.bits), self.const(domain.high, word.bits)
        return [self.node("slte", 1, least, word), self.node("slte", 1, word, most)]

    # --- formulas ----------------------------------------------------------------------------------

    def __call__(self, expr: Expr) -> Word:
        """The node of a formula."""
        for node in postorder(expr):
            if id(node) not in self._done:
                self._range[id(node)] = interval(node, self._range)
                self._done[id(node)] = self._formula(node)
        return self._done[id(expr)]

    def _formula(self, node: Expr) -> Word:
        match node:
            case Const(value, sort):
                return self.const(value, 1 if isinstance(sort, Bool) else self._range[id(node)].width)
            case Var(name):
                return self._variables[name]
            case Named(_, body):
                return self._done[id(body)]
            case Apply(op, args, sort):
                return self._apply(op, args, sort, self._range[id(node)])
        raise AssertionError(f"{node} speaks of the past")

    def _apply(self, op: Op, args: Sequence[Expr], sort: Sort, result: Interval) -> Word:
        words = [self._done[id(a)] for a in args]
        if op in _LOGIC:
            return self._several(_LOGIC[op], words)
        if op is Op.NOT:
            return self.node("not", 1, words[0])
        if op is Op.ITE:
            a, b = self._aligned(words[1:])
            return self.node("ite", a.bits, words[0], a, b)
        if op in _COMPARE:
            return self.node(_COMPARE[op], 1, *self._aligned(words))
        if op is Op.BIT:
            index = self._range[id(args[1])].low
            return self.node("slice", 1, self.fitted(words[0], max(words[0].bits, index + 1)), index, index)
        bits = max([result.width, *(w.bits for w in words)])
        found = _ARITHMETIC[op](self, *(self.fitted(w, bits) for w in words))
        return self.fitted(found, result.width)

    def _aligned(self, words: Sequence[Word]) -> list[Word]:
        bits = max(w.bits for w in words)
        return [self.fitted(w, bits) for w in words]


def _plain(op: str) -> Callable[..., Word]:
    return lambda writer, *args: writer.node(op, args[0].bits, *args)


def _divided(writer: _Writer, a: Word, b: Word) -> Word:
    """Rounded down; the divisor is positive.  One more bit holds the multiple below the least value."""
    bits = a.bits + 1
    a, b = writer.fitted(a, bits), writer.fitted(b, bits)
    multiple = writer.node("sub", bits, a, writer.node("smod", bits, a, b))
    return writer.node("sdiv", bits, multiple, b)


def _chosen(test: str, first_if_so: bool) -> Callable[..., Word]:
    def choose(writer: _Writer, a: Word, b: Word) -> Word:
        then, other = (a, b) if first_if_so else (b, a)
        return writer.node("ite", a.bits, writer.node(test, 1, a, b), then, other)

    return choose


def _absolute(writer: _Writer, a: Word) -> Word:
    negative = writer.node("slt", 1, a, writer.const(0, a.bits))
    return writer.node("ite", a.bits, negative, writer.node("neg", a.bits, a), a)


_LOGIC = {Op.AND: "and", Op.OR: "or"}
_COMPARE = {Op.EQ: "eq", Op.NE: "neq", Op.LT: "slt", Op.LE: "slte", Op.GT: "sgt", Op.GE: "sgte"}
_ARITHMETIC: Mapping[Op, Callable[..., Word]] = {
    Op.ADD: _plain("add"),
    Op.SUB: _plain("sub"),
    Op.NEG: _plain("neg"),
    Op.MUL: _plain("mul"),
    Op.SCALE: _plain("mul"),
    Op.DIV: _divided,
    Op.MOD: _plain("smod"),  # the sign of the divisor, as in Python
    Op.ABS: _absolute,
    Op.MIN: _chosen("slte", True),
    Op.MAX: _chosen("slte", False),
}
