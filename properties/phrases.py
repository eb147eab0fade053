"""Formulas in words: every operator and temporal word has one phrase, and brackets where two could be meant.

A truth becomes a clause ("rx_age is at most 120 ms"), a number or a member of an enumeration a term.
A formula with a name is quoted by it: “a link is critical” holds.  Conventions:

* "and", "or" and "if" of different kinds are bracketed; a comma or a colon binds weaker than all of them;
* milliseconds run from the end of the first step that is meant to the end of the last;
* before the first step nothing is true: what is true in the first step becomes true in it.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from rovercheck.spec_model.lang.domain import Bool, Enum, Num
from rovercheck.spec_model.lang.expr import FALSE, Apply, Const, Expr, Named, Temporal, Var, When
from rovercheck.spec_model.lang.label import constant
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.walk import structure

_SUMS = (Op.ADD, Op.SUB)


@dataclass(frozen=True)
class Voice:
    """How formulas are spoken of: the length of a step, and whether a step before is meant.

    ``measured``: steps last unlike times, so that a length in ms is no number of steps.
    """

    tick_ms: int
    past: bool = False
    measured: bool = False

    @property
    def be(self) -> str:
        return "was" if self.past else "is"

    def steps(self, span: Span) -> int:
        """The number of steps of a span.  Raises ``ModelError`` unless it is whole."""
        return span.ticks(self.tick_ms)

    def in_ms(self, span: Span) -> bool:
        """Whether the span is a length of time that is no number of steps."""
        return span.measured(self.measured or None) and span.ticks(1) > 0

    def ms(self, steps: int) -> str:
        return f"{'nominally ' * self.measured}{steps * self.tick_ms} ms"


Row = Callable[[Sequence[Expr], Voice, bool], str]
"""Says an operator with its arguments, or with false, where it makes a truth value, its negation."""


def quoted(name: str) -> str:
    return f"“{name}”"


def clause(expr: Expr, voice: Voice, yes: bool = True) -> str:
    """The formula, or with ``yes`` false its negation, as a clause with a verb."""
    match expr:
        case Named(name):
            return f"{quoted(name)} {_holds(voice, yes)}"
        case Const(value):
            return "true" if bool(value) is yes else "false"
        case Temporal():
            return _temporal(expr, voice, yes)
        case Apply(op, args, _):
            return OPERATIONS[op](args, voice, yes)
        case _:
            return f"{term(expr, voice)} {voice.be} {'true' if yes else 'false'}"


def part(expr: Expr, voice: Voice, yes: bool = True) -> str:
    """The clause as a part of a larger one: in brackets if it has parts itself."""
    said = clause(expr, voice, yes)
    return f"({said})" if _has_parts(expr, yes) else said


def final(expr: Expr, voice: Voice) -> str:
    """The clause as the last part of a sentence: after a colon if it has parts itself."""
    return f"{':' if _has_parts(expr, True) else ''} {clause(expr, voice)}"


def _has_parts(expr: Expr, yes: bool) -> bool:
    match expr:
        case Apply(Op.NOT, (arg,), _):
            return _has_parts(arg, not yes)
        case Apply(Op.AND | Op.OR, args, _):
            kept = _possible(args)
            # A negation brings its own brackets.
            return yes if len(kept) > 1 else _has_parts(kept[0], yes)
        case Apply(Op.EQ | Op.NE, (left, right), _):
            return isinstance(left.sort, Bool) and not _is_previous_of(right, left)
        case Apply(Op.ITE, _, _):
            return True
        case Temporal(When.PREVIOUS, _, _, _):
            return False
        case Temporal():
            return True
        case _:
            return False


def _holds(voice: Voice, yes: bool) -> str:
    if yes:
        return "held" if voice.past else "holds"
    return "did not hold" if voice.past else "does not hold"


# --- and, or, not, comparisons -------------------------------------------------------------------


def _all(args: Sequence[Expr], voice: Voice, yes: bool) -> str:
    said = " and ".join(part(a, voice) for a in args)
    return said if yes else f"not ({said})"


def _any(args: Sequence[Expr], voice: Voice, yes: bool) -> str:
    kept = _possible(args)
    if len(kept) == 1:
        return clause(kept[0], voice, yes)
    return _either(kept, voice) if yes else f"not ({_either(kept, voice)})"


def _either(args: Sequence[Expr], voice: Voice) -> str:
    if implication := as_implication(args):
        premise, conclusions = implication
        return f"if {part(premise, voice)} then {' or '.join(part(c, voice) for c in conclusions)}"
    return " or ".join(part(a, voice) for a in args)


def _possible(args: Sequence[Expr]) -> list[Expr]:
    """The parts of a disjunction that are not the constant false."""
    return [a for a in args if a is not FALSE] or [FALSE]


def as_implication(args: Sequence[Expr]) -> tuple[Expr, Sequence[Expr]] | None:
    """The premise and the alternatives of a disjunction that starts with a negation."""
    match _possible(args):
        case [Apply(Op.NOT, (premise,), _), *conclusions] if conclusions:
            return premise, conclusions
        case _:
            return None


def _equal(same: bool) -> Row:
    def row(args: Sequence[Expr], voice: Voice, yes: bool) -> str:
        left, right = args
        so = same is yes
        no = "" if so else "not "
        if _is_previous_of(right, left):
            before = f"the same as in the step before{' that' * voice.past}"
            return f"{_subject(left, voice)} {voice.be} {no}{before}"
        if isinstance(left.sort, Bool):
            return f"{part(left, voice)} exactly when {part(right, voice, so)}"
        where = "in " if _is_place(left) else ""
        return f"{term(left, voice)} {voice.be} {no}{where}{term(right, voice)}"

    return row


def _ordered(words: str) -> Row:
    def row(args: Sequence[Expr], voice: Voice, yes: bool) -> str:
        left, right = (term(a, voice) for a in args)
        return f"{left} {voice.be} {'' if yes else 'not '}{words} {right}"

    return row


def _bit(args: Sequence[Expr], voice: Voice, yes: bool) -> str:
    mask, index = (term(a, voice) for a in args)
    return f"bit {index} of {mask} {voice.be} {int(yes)}"


def _subject(expr: Expr, voice: Voice) -> str:
    """What a statement is about: a name, or a formula in brackets."""
    if isinstance(expr.sort, Bool) and not isinstance(expr, Var):
        return f"({clause(expr, voice)})"
    return term(expr, voice)


def _is_previous_of(later: Expr, expr: Expr) -> bool:
    match later:
        case Temporal(When.PREVIOUS, arg, _, _) if arg is not None:
            return structure(arg) == structure(expr)
        case _:
            return False


def _is_place(expr: Expr) -> bool:
    return isinstance(expr.sort, Enum) and expr.sort.name.startswith("states of ")


# --- the past ------------------------------------------------------------------------------------


def _temporal(expr: Temporal, voice: Voice, yes: bool) -> str:
    if expr.when is When.PREVIOUS and expr.arg is not None:
        return _previous(expr.arg, voice, yes)
    match expr:
        case Temporal(When.HELD, Expr() as arg, Span() as span, _):
            return f"{_last(span, voice, yes)} {part(arg, voice, yes)}"
        case Temporal(When.ONCE, Expr() as arg, _, _):
            some = "in this step or some step before" if yes else "in this step and every step before"
            return f"{some} {part(arg, voice, yes)}"
        case _:
            said = _of_a_state(expr, voice)
            return said if yes else f"not ({said})"


def _previous(arg: Expr, voice: Voice, yes: bool) -> str:
    steps, inner = 1, arg
    while isinstance(inner, Temporal) and inner.when is When.PREVIOUS and inner.arg is not None:
        steps, inner = steps + 1, inner.arg
    when = "in the step before" if steps == 1 else f"{steps} steps before"
    return f"{part(inner, replace(voice, past=True), yes)} {when}{' that' * voice.past}"


def _last(span: Span, voice: Voice, each: bool) -> str:
    """The stretch of ``held``, this step and as many before it; its negation is true in one of them."""
    quantity = "each" if each else "some"
    if voice.in_ms(span):
        return f"in {quantity} step of the last {span}, from one as long ago or longer on,"
    steps = voice.steps(span)
    if steps == 0:
        return "in this step"
    return f"in {quantity} of the last {steps + 1} steps ({voice.ms(steps)}, ends included)"


def _of_a_state(expr: Temporal, voice: Voice) -> str:
    match expr:
        case Temporal(When.RISING, Expr() as arg, _, _):
            return f"{begins(arg, voice)}, not in the first step"
        case Temporal(When.DURATION, Expr() as arg, span, strict):
            return f"for {'more than' if strict else 'at least'} {span} {part(arg, voice)}"
        case _:
            return f"{expr.span} have passed since the state was entered"


def begins(expr: Expr, voice: Voice) -> str:
    """The formula becomes true."""
    match expr:
        case Var(name):
            return f"{name} becomes true"
        case Named(name):
            return f"{quoted(name)} begins to hold"
        case Apply(Op.EQ, (left, right), _) if not isinstance(left.sort, Bool):
            verb = "enters" if _is_place(left) else "becomes"
            return f"{term(left, voice)} {verb} {term(right, voice)}"
        case _:
            return f"it becomes true that {part(expr, voice)}"


def ends(expr: Expr, voice: Voice) -> str:
    """The formula was true and is no longer."""
    match expr:
        case Var(name):
            return f"{name} becomes false"
        case Named(name):
            return f"{quoted(name)} ceases to hold"
        case Apply(Op.EQ, (left, right), _) if not isinstance(left.sort, Bool):
            verb = "leaves" if _is_place(left) else "ceases to be"
            return f"{term(left, voice)} {verb} {term(right, voice)}"
        case _:
            return f"it ceases to be true that {part(expr, voice)}"


# --- numbers and members -------------------------------------------------------------------------


def term(expr: Expr, voice: Voice) -> str:
    """The value as a noun, a constant with its unit."""
    match expr:
        case Const(value, sort):
            unit = str(sort.unit) if isinstance(sort, Num) else ""
            return f"{constant(value, sort)}{'' if unit == '°' else ' '}{unit}".rstrip()
        case Var(name):
            return name
        case Named(name):
            return quoted(name)
        case Temporal(When.PREVIOUS, arg, _, _) if arg is not None:
            return f"{_operand(arg, voice)} of the step before{' that' * voice.past}"
        case Apply(op, args, sort) if not isinstance(sort, Bool):
            return OPERATIONS[op](args, voice, True)
        case _:
            return f"({clause(expr, voice)})"


def _chosen(args: Sequence[Expr], voice: Voice, yes: bool) -> str:
    test, then, otherwise = args
    if isinstance(then.sort, Bool):
        first, second = clause(then, voice, yes), clause(otherwise, voice, yes)
        return f"if {part(test, voice)} then ({first}), otherwise ({second})"
    return f"({term(then, voice)} if {part(test, voice)}, otherwise {term(otherwise, voice)})"


def _sum(sign: str) -> Row:
    return lambda args, voice, yes: sign.join(
        term(a, voice) if at == 0 and _is_sum(a) else _operand(a, voice) for at, a in enumerate(args)
    )


def _addition(args: Sequence[Expr], voice: Voice, yes: bool) -> str:
    if counted := _counted(args):
        return f"the number of true ones among ({'; '.join(clause(c, voice) for c in counted)})"
    return _sum(" + ")(args, voice, yes)


def _sign(sign: str) -> Row:
    return lambda args, voice, yes: sign.join(_operand(a, voice) for a in args)


def _extreme(which: str) -> Row:
    return lambda args, voice, yes: f"the {which} of {' and '.join(_operand(a, voice) for a in args)}"


def _counted(summands: Sequence[Expr]) -> list[Expr]:
    """The conditions of a sum that adds 1 for each that is true; none of any other sum."""
    conditions: list[Expr] = []
    for summand in summands:
        match summand:
            case Const(0, _):
                continue
            case Apply(Op.ITE, (condition, Const(1, Num(1, _)), Const(0, _)), _):
                conditions.append(condition)
            case Apply(Op.ADD, inner, _) if counted := _counted(inner):
                conditions += counted
            case _:
                return []
    return conditions


def _is_sum(expr: Expr) -> bool:
    return isinstance(expr, Apply) and (expr.op in _SUMS or (expr.op is Op.SCALE and _is_sum(expr.args[0])))


def _operand(expr: Expr, voice: Voice) -> str:
    """A term beside a sign: in brackets if it is computed itself."""
    inner = expr
    while isinstance(inner, Apply) and inner.op is Op.SCALE:
        inner = inner.args[0]
    closed = not isinstance(inner, Apply) or isinstance(inner.sort, Bool) or inner.op in (Op.ABS, Op.ITE)
    return term(inner, voice) if closed else f"({term(inner, voice)})"


OPERATIONS: Mapping[Op, Row] = {
    Op.NOT: lambda args, voice, yes: clause(args[0], voice, not yes),
    Op.AND: _all,
    Op.OR: _any,
    Op.ITE: _chosen,
    Op.EQ: _equal(True),
    Op.NE: _equal(False),
    Op.LT: _ordered("below"),
    Op.LE: _ordered("at most"),
    Op.GT: _ordered("above"),
    Op.GE: _ordered("at least"),
    Op.BIT: _bit,
    Op.ADD: _addition,
    Op.SUB: _sum(" - "),
    Op.NEG: lambda args, voice, yes: f"-{_operand(args[0], voice)}",
    Op.MUL: _sign(" × "),
    Op.SCALE: lambda args, voice, yes: term(args[0], voice),  # the same number, counted in finer steps
    Op.DIV: _sign(" div "),
    Op.MOD: _sign(" mod "),
    Op.ABS: lambda args, voice, yes: f"|{term(args[0], voice)}|",
    Op.MIN: _extreme("smaller"),
    Op.MAX: _extreme("larger"),
}
"""The phrase of every operator: of those that make a truth value a clause, of the others a term."""
