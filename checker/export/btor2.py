"""The BTOR2 format: signed bit-vectors, each as wide as the values of its formula need.

Aina Niemetz, Mathias Preiner, Clifford Wolf, Armin Biere: BTOR2, BtorMC and Boolector 3.0, CAV 2018.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.export.machine import ExportMachine, machine, meaning
from rovercheck.checker.export.names import one_line, symbols
from rovercheck.checker.export.problem import Problem
from rovercheck.checker.results.format import Format
from rovercheck.checker.system.intervals import Interval, interval, postorder
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op

FORMAT = Format(
    "btor2", "problem", ".btor2", "BTOR2: words, for AVR, Pono, BtorMC and other word-level model checkers"
)


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

    def value(self, constant: Word) -> int:
        return self._value[constant.id]

    def fitted(self, a: Word, bits: int) -> Word:
        """The word in another width that holds its value."""
        if a.bits == bits:
            return a
        if a.id in self._value:
            return self.const(self._value[a.id], bits)
        if a.bits < bits:
            return self.node("sext", bits, a, bits - a.bits)
        return self.node("slice", bits, a, bits - 1, 0)

    def several(self, op: str, args: Sequence[Word]) -> Word:
        """Truth values joined by ``and`` or ``or``."""
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
            return [self.several("or", same)]
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
            case Apply(op, args, _):
                words = [self._done[id(a)] for a in args]
                return OPERATIONS[op](self, words, self._range[id(node)].width)
        raise AssertionError(f"{node} speaks of the past")

    def aligned(self, words: Sequence[Word]) -> list[Word]:
        """The words in one width that holds each of them."""
        bits = max(w.bits for w in words)
        return [self.fitted(w, bits) for w in words]


Row = Callable[[_Writer, Sequence[Word], int], Word]
"""An operator on words; a number has that many bits."""


def _junction(op: str) -> Row:
    return lambda writer, words, bits: writer.several(op, words)


def _compared(op: str) -> Row:
    return lambda writer, words, bits: writer.node(op, 1, *writer.aligned(words))


def _chosen(writer: _Writer, words: Sequence[Word], bits: int) -> Word:
    then, other = writer.aligned(words[1:])
    return writer.node("ite", then.bits, words[0], then, other)


def _bit(writer: _Writer, words: Sequence[Word], bits: int) -> Word:
    index = writer.value(words[1])
    return writer.node("slice", 1, writer.fitted(words[0], max(words[0].bits, index + 1)), index, index)


def _computed(compute: Callable[..., Word]) -> Row:
    """In a width that holds arguments and result."""

    def row(writer: _Writer, words: Sequence[Word], bits: int) -> Word:
        inner = max(bits, *(w.bits for w in words))
        return writer.fitted(compute(writer, *(writer.fitted(w, inner) for w in words)), bits)

    return row


def _plain(op: str) -> Row:
    return _computed(lambda writer, *args: writer.node(op, args[0].bits, *args))


def _divided(writer: _Writer, a: Word, b: Word) -> Word:
    """Rounded down; the divisor is positive.  One more bit holds the multiple below the least value."""
    bits = a.bits + 1
    a, b = writer.fitted(a, bits), writer.fitted(b, bits)
    multiple = writer.node("sub", bits, a, writer.node("smod", bits, a, b))
    return writer.node("sdiv", bits, multiple, b)


def _absolute(writer: _Writer, a: Word) -> Word:
    negative = writer.node("slt", 1, a, writer.const(0, a.bits))
    return writer.node("ite", a.bits, negative, writer.node("neg", a.bits, a), a)


def _least(writer: _Writer, a: Word, b: Word) -> Word:
    return writer.node("ite", a.bits, writer.node("slte", 1, a, b), a, b)


def _greatest(writer: _Writer, a: Word, b: Word) -> Word:
    return writer.node("ite", a.bits, writer.node("slte", 1, a, b), b, a)


OPERATIONS: Mapping[Op, Row] = {
    Op.NOT: lambda writer, words, bits: writer.node("not", 1, words[0]),
    Op.AND: _junction("and"),
    Op.OR: _junction("or"),
    Op.ITE: _chosen,
    Op.EQ: _compared("eq"),
    Op.NE: _compared("neq"),
    Op.LT: _compared("slt"),
    Op.LE: _compared("slte"),
    Op.GT: _compared("sgt"),
    Op.GE: _compared("sgte"),
    Op.ADD: _plain("add"),
    Op.SUB: _plain("sub"),
    Op.NEG: _plain("neg"),
    Op.MUL: _plain("mul"),
    Op.SCALE: _plain("mul"),
    Op.DIV: _computed(_divided),
    Op.MOD: _plain("smod"),  # the sign of the divisor, as in Python
    Op.ABS: _computed(_absolute),
    Op.MIN: _computed(_least),
    Op.MAX: _computed(_greatest),
    Op.BIT: _bit,
}
