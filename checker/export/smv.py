"""The SMV language of NuSMV and nuXmv: ranges, definitions for shared formulas, one INVARSPEC per bad state.

Roberto Cavada et al.: The nuXmv Symbolic Model Checker, CAV 2014.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from checker.export.machine import ExportMachine, machine, meaning
from checker.export.names import identifiers, one_line
from checker.export.problem import Problem
from checker.system.intervals import intervals, postorder
from spec_model.lang.domain import Bool
from spec_model.lang.expr import Apply, Const, Expr, Named, Var
from spec_model.lang.operators import Op
from spec_model.lang.walk import children

NAME = "smv"
SUFFIX = "smv"
SUMMARY = "SMV: ranges and definitions, for nuXmv and NuSMV"

LONG = 60
"""Formulas of more characters get a name, also when they occur once."""

_WORDS = """
MODULE DEFINE MDEFINE CONSTANTS VAR IVAR FROZENVAR INIT TRANS INVAR SPEC CTLSPEC LTLSPEC PSLSPEC COMPUTE NAME
INVARSPEC FAIRNESS JUSTICE COMPASSION ISA ASSIGN CONSTRAINT SIMPWFF CTLWFF LTLWFF PSLWFF COMPWFF IN MIN MAX
MIRROR PRED PREDICATES process array of boolean integer real word word1 bool signed unsigned extend resize
sizeof uwconst swconst EX AX EF AF EG AG E F O G H X Y Z A U S V T BU EBF ABF EBG ABG case esac mod next init
union in xor xnor self TRUE FALSE count abs max min time clock noncontinuous urgent READ WRITE CONSTARRAY
floor pi sin cos tan exp ln pow main itype typeof toint
"""
KEYWORDS = frozenset(_WORDS.split())
"""Words that a model cannot use as names."""

SIGNS = {
    Op.AND: "&", Op.OR: "|", Op.EQ: "=", Op.NE: "!=", Op.LT: "<", Op.LE: "<=", Op.GT: ">", Op.GE: ">=",
    Op.ADD: "+", Op.SUB: "-", Op.MUL: "*", Op.SCALE: "*",
}  # fmt: skip


def export(problem: Problem) -> str:
    """The problem as a module: inputs are variables that change at will, within the assumption.

    A bad state is one whose inputs lead to it in the tick that comes.  Where a variable would leave its
    domain, the run ends.
    """
    made = machine(problem)
    header = "".join(f"-- {line}\n" for line in problem.header)
    return header + "".join(f"{line}\n" for line in _Module(made).lines())


class _Module:
    """The sections of the file."""

    def __init__(self, made: ExportMachine) -> None:
        self._made = made
        names = [v.name for v in (*made.frozen, *made.states, *made.inputs)]
        bad = [f"bad {name}" for name, _ in made.bad]
        self._names = identifiers([*names, *bad], KEYWORDS)
        self._text = _Text(self._names, made.formulas)

    def lines(self) -> Iterator[str]:
        """Every line of the file."""
        made, text = self._made, self._text
        values = {name: text(formula) for name, formula in made.next.items()}
        assumed = [text(formula) for formula in made.assume]
        bad = [(self._names[f"bad {name}"], text(formula)) for name, formula in made.bad]
        yield "MODULE main"
        sections = (
            ("FROZENVAR", "chosen once", made.frozen),
            ("VAR", "state before a tick", made.states),
            ("VAR", "inputs of the tick", made.inputs),
        )
        for word, title, variables in sections:
            if variables:
                yield f"{word} -- {title}"
                yield from map(self._declaration, variables)
        yield "DEFINE"
        yield from (f"  {name} := {formula};" for name, formula in (*text.defined, *bad))
        yield from (f"INIT {self._at_first(v)};" for v in made.states)
        for var in (*made.frozen, *made.inputs):
            if isinstance(var.sort, Bool) and len(var.domain) == 1:
                yield f"INVAR {self._at_first(var)};"
        yield from (f"INVAR {condition};" for condition in assumed)
        yield from (f"TRANS {self._follows(v, values[v.name])};" for v in made.states)
        yield from (f"INVARSPEC !{name};" for name, _ in bad)

    def _declaration(self, var: Var) -> str:
        name, domain = self._names[var.name], var.domain
        if isinstance(var.sort, Bool):
            kind = "boolean"
        else:
            listed = ", ".join(map(str, domain.values)) if not domain.dense else ""
            kind = f"{{{listed}}}" if listed else f"{domain.low}..{domain.high}"
        said = one_line(": ".join(filter(None, (var.name if var.name != name else "", meaning(var)))))
        return f"  {name} : {kind};{f' -- {said}' if said else ''}"

    def _at_first(self, var: Var) -> str:
        name = self._names[var.name]
        return f"{'' if var.init else '!'}{name}" if isinstance(var.sort, Bool) else f"{name} = {var.init}"

    def _follows(self, var: Var, value: str) -> str:
        sign = "<->" if isinstance(var.sort, Bool) else "="
        return f"next({self._names[var.name]}) {sign} {value}"


class _Text:
    """Formulas as text; what is shared or long is defined once, in ``defined``."""

    def __init__(self, names: Mapping[str, str], formulas: Sequence[Expr]) -> None:
        self._names, self._taken = names, frozenset(names.values())
        self._range = intervals(*formulas)
        uses = Counter(id(child) for node in postorder(*formulas) for child in children(node))
        self._shared = {node for node, count in uses.items() if count > 1}
        self._done: dict[int, str] = {}
        self.defined: list[tuple[str, str]] = []

    def __call__(self, expr: Expr) -> str:
        """The text of a formula, or its name."""
        for node in postorder(expr):
            if id(node) not in self._done:
                text = self._node(node)
                apart = isinstance(node, Apply) and (id(node) in self._shared or len(text) > LONG)
                self._done[id(node)] = self._define(text) if apart else text
        return self._done[id(expr)]

    def _define(self, text: str) -> str:
        name = f"d{len(self.defined)}"
        while name in self._taken:
            name = f"d_{name}"
        self.defined.append((name, text))
        return name

    def _node(self, node: Expr) -> str:
        match node:
            case Const(value, sort):
                return ("TRUE" if value else "FALSE") if isinstance(sort, Bool) else _number(value)
            case Var(name):
                return self._names[name]
            case Named(_, body):
                return self._done[id(body)]
            case Apply(op, args, _):
                if op in (Op.ABS, Op.MIN, Op.MAX):
                    return self._twice(op, args)
                if op is Op.BIT:
                    return self._bit(*args)
                if op in (Op.DIV, Op.MOD):
                    return self._quotient(op, args)
                return _apply(op, [self._done[id(a)] for a in args])
        raise AssertionError(f"{node} speaks of the past")

    def _twice(self, op: Op, args: Sequence[Expr]) -> str:
        a, b = self._done[id(args[0])], self._done[id(args[-1])]
        match op:
            case Op.ABS:
                return f"({a} >= 0 ? {a} : -{a})"
            case Op.MIN:
                return f"({a} <= {b} ? {a} : {b})"
            case Op.MAX:
                return f"({a} >= {b} ? {a} : {b})"
        raise AssertionError(op)

    def _bit(self, of: Expr, index: Expr) -> str:
        weight = 2 ** self._range[id(index)].low
        return f"(({self._above(of, 2 * weight)[0]} / {weight}) mod 2 = 1)"

    def _quotient(self, op: Op, args: Sequence[Expr]) -> str:
        by = self._range[id(args[1])].low
        above, times = self._above(args[0], by)
        if op is Op.MOD:
            return f"({above} mod {by})"
        return f"({above} / {by} - {times})" if times else f"({above} / {by})"

    def _above(self, expr: Expr, step: int) -> tuple[str, int]:
        """The formula plus so many steps that it is never negative: how others round does not matter then."""
        times = -(min(self._range[id(expr)].low, 0) // step)
        text = self._done[id(expr)]
        return (f"({text} + {times * step})" if times else text), times


def _number(value: int) -> str:
    return str(value) if value >= 0 else f"({value})"


def _apply(op: Op, args: Sequence[str]) -> str:
    if op is Op.NOT:
        return f"!{args[0]}"
    if op is Op.NEG:
        return f"(-{args[0]})"
    if op is Op.ITE:
        return f"({args[0]} ? {args[1]} : {args[2]})"
    return f"({f' {SIGNS[op]} '.join(args)})"
