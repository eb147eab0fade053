"""The SMV language of NuSMV and nuXmv: ranges, definitions for shared formulas, one INVARSPEC per bad state.

Roberto Cavada et al.: The nuXmv Symbolic Model Checker, CAV 2014.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from rovercheck.checker.export.infix import Operand, Row, between, raised, whole, written
from rovercheck.checker.export.machine import ExportMachine, machine, meaning
from rovercheck.checker.export.names import identifiers, one_line
from rovercheck.checker.export.problem import Problem
from rovercheck.checker.results.format import Format
from rovercheck.checker.system.intervals import intervals, postorder
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import children

FORMAT = Format("smv", "problem", ".smv", "SMV: ranges and definitions, for nuXmv and NuSMV")

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


def _bit(args: Sequence[Operand]) -> str:
    weight = 2 ** args[1].within.low
    return f"(({raised(args[0], whole(2 * weight))[0]} / {weight}) mod 2 = 1)"


OPERATIONS: Mapping[Op, Row] = {
    **written("?", "-", "mod"),
    Op.NOT: lambda args: f"!{args[0].text}",
    Op.AND: between("&"),
    Op.OR: between("|"),
    Op.EQ: between("="),
    Op.BIT: _bit,
}


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
                return OPERATIONS[op]([self._operand(a) for a in args])
        raise AssertionError(f"{node} speaks of the past")

    def _operand(self, expr: Expr) -> Operand:
        text = self._done[id(expr)]
        return Operand(text, lambda: text, self._range[id(expr)])


def _number(value: int) -> str:
    return str(value) if value >= 0 else f"({value})"
