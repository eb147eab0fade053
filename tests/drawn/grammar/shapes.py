"""Trees of the grammar in one line each: ``(+ a (* b 2))``."""

from collections.abc import Iterable

from rovercheck.checker.drawn.grammar import actions as a
from rovercheck.checker.drawn.grammar import syntax as s
from rovercheck.checker.drawn.grammar.labels import LabelSection, StateLabel, TransitionLabel

KINDS = {
    s.NumberKind.DOUBLE: "",
    s.NumberKind.INTEGER: "i",
    s.NumberKind.FLOATING: "f",
    s.NumberKind.SINGLE: "s",
    s.NumberKind.BITS: "b",
}


def shape(expression: s.Expression | None) -> str:
    match expression:
        case None:
            return "~"
        case s.Number(value, kind):
            return f"{value}{KINDS[kind]}"
        case s.TextLiteral(value, quote):
            return quote + value + quote
        case s.Name(name):
            return name
        case s.Member(owner, name, arrow):
            return f"{shape(owner)}{'->' if arrow else '.'}{name}"
        case s.Applied(function, arguments):
            return f"{shape(function)}({', '.join(map(shape, arguments))})"
        case s.Indexed(array, index):
            return f"{shape(array)}[{shape(index)}]"
        case s.UnaryOperation(operator, operand):
            return f"({operator} {shape(operand)})"
        case s.BinaryOperation(operator, left, right):
            return f"({operator} {shape(left)} {shape(right)})"
        case s.ColonRange(start, step, stop):
            return f"(: {' '.join(shape(part) for part in (start, step, stop) if part is not None)})"
        case s.WholeRange():
            return ":"
        case s.LastIndex():
            return "end"
        case s.Matrix(rows):
            return f"[{_rows(rows)}]"
        case s.CellArray(rows):
            return f"{{{_rows(rows)}}}"


def _rows(rows: Iterable[Iterable[s.Expression]]) -> str:
    return "; ".join(" ".join(map(shape, row)) for row in rows)


def action(statement: a.ActionStatement) -> str:
    match statement:
        case a.Assignment(targets, value, operator, fixed_point):
            sign = ":=" if fixed_point else f"{operator or ''}="
            return f"{' '.join(map(shape, targets))} {sign} {shape(value)}"
        case a.Increment(target, by):
            return f"{shape(target)} {by:+}"
        case a.Evaluated(expression):
            return shape(expression)
        case a.IfStatement(branches, otherwise):
            tests = [f"if {shape(b.condition)} <{actions(b.body)}>" for b in branches]
            return " ".join([*tests, f"else <{actions(otherwise)}>"] if otherwise else tests)
        case a.ForLoop(variable, values, body):
            return f"for {variable} {shape(values)} <{actions(body)}>"
        case a.WhileLoop(condition, body):
            return f"while {shape(condition)} <{actions(body)}>"
        case a.SwitchStatement(subject, cases, otherwise):
            tests = [f"case {' '.join(map(shape, c.values))} <{actions(c.body)}>" for c in cases]
            rest = [f"otherwise <{actions(otherwise)}>"] if otherwise else []
            return " ".join([f"switch {shape(subject)}", *tests, *rest])
        case a.ReturnStatement():
            return "return"
        case a.BreakStatement():
            return "break"
        case a.ContinueStatement():
            return "continue"
        case a.NameDeclaration(keyword, names):
            return f"{keyword} {' '.join(names)}"


def actions(statements: Iterable[a.ActionStatement]) -> str:
    return " | ".join(map(action, statements))


def section(part: LabelSection) -> str:
    kinds = "implied" if part.implied else ",".join(kind.value for kind in part.kinds)
    return f"{kinds}{''.join(' ' + shape(event) for event in part.events)}: {actions(part.statements)}"


def state(label: StateLabel) -> list[str]:
    return [label.name, *map(section, label.sections)]


def transition(label: TransitionLabel) -> tuple[list[str], str, str, str]:
    """Events, guard, condition actions, transition actions."""
    guard = "" if label.guard is None else shape(label.guard)
    following = actions(label.transition_actions)
    return [shape(event) for event in label.events], guard, actions(label.condition_actions), following
