"""Expressions of charts and MATLAB functions as formulas."""

from abc import abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import replace

from rovercheck.checker.drawn.free import arguments_of, free_name
from rovercheck.checker.drawn.grammar.functions import ScriptFunction
from rovercheck.checker.drawn.grammar.syntax import (
    Applied,
    BinaryOperation,
    ColonRange,
    Expression,
    Indexed,
    LastIndex,
    Matrix,
    Member,
    Name,
    Number,
    NumberKind,
    TextLiteral,
    UnaryOperation,
    parts,
)
from rovercheck.checker.drawn.lower.arithmetic import unary, zeros_of
from rovercheck.checker.drawn.lower.builtins import BUILTINS, NOTHING
from rovercheck.checker.drawn.lower.conversions import as_number, condition_of, each_converted
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.matrix_functions import (
    CODER_VALUES,
    CODER_WORDS,
    EXTREMES,
    FURTHER,
    REDUCTIONS,
    TYPED,
    limit_of,
    place_of_extreme,
    reduced,
    sorted_values,
)
from rovercheck.checker.drawn.lower.names import TextScope, datum_in, function_in
from rovercheck.checker.drawn.lower.operators import OperatorWriter, division_in
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import (
    MADE,
    TWO_TYPES,
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    SymbolicStructure,
    filled,
    folded,
    leaves,
    matrix,
    number,
    single_of,
    size_of,
    truth,
)
from rovercheck.checker.drawn.lower.times import COUNTED
from rovercheck.checker.drawn.parsed import FunctionNode
from rovercheck.checker.drawn.refused import FREE
from rovercheck.spec_model.lang.expr import TRUE, Const, Expr, Var, const


class ExpressionWriter(OperatorWriter):
    """Makes formulas of the texts of one chart; what it calls is written before the formula."""

    def __init__(self, table: DataTable, writer: ProgramWriter) -> None:
        super().__init__(table, writer)
        self.cells: dict[int, Symbolic] = {}
        """The data of the chart by SSID: variables, or the formulas that feed its inputs."""
        self.persistent: dict[str, Symbolic] = {}

    # --- what only the chart, or the statements, know ------------------------------------------------------

    @abstractmethod
    def word(self, expression: Expression, scope: TextScope) -> Symbolic | None:
        """The value of an expression of the chart's own, as ``after(3, sec)``; ``None`` if it is none."""

    @abstractmethod
    def call(self, function: FunctionNode, arguments: Sequence[Symbolic], scope: TextScope) -> list[Symbolic]:
        """Call a function of the chart."""

    @abstractmethod
    def script(
        self, function: ScriptFunction, arguments: Sequence[Symbolic], scope: TextScope
    ) -> list[Symbolic]:
        """Call a MATLAB function of the script that a text stands in."""

    # --- values --------------------------------------------------------------------------------------------

    def value(self, expression: Expression, scope: TextScope) -> Symbolic:
        """The value of an expression.  Raises ``NotLowered``."""
        if free := self._free(expression, scope):
            return self._any_value(free, expression, scope)
        match expression:
            case Number(value, kind):
                return number(self._kind(value.denominator == 1, kind, scope), value)
            case Name(name):
                return self._named(name, expression, scope)
            case Member() | Applied():
                found = self.several(expression, scope)
                if not found:
                    raise NotLowered("a function that gives nothing stands where a value must")
                return found[0]
            case Indexed(whole, index):
                every, at = self._both(whole, index, scope)
                return self._element(every, as_number(single_of(at)), self.first_index(whole, scope))
            case UnaryOperation(sign, operand):
                after = self.value(operand, scope)
                with self.noting(expression, scope) as outside:
                    return unary(sign, after, replace(scope.rules, outside=outside))
            case BinaryOperation("&&" | "||" as sign, left, right):
                return truth(self._short(sign, left, right, scope))
            case BinaryOperation(_, left, right):
                return self.operated(expression, *self._both(left, right, scope), scope)
            case Matrix(rows):
                return self._matrix([[self.value(one, scope) for one in row] for row in rows], scope)
            case ColonRange():
                return self._range(expression, scope)
            case LastIndex():
                return number("double", scope.last)
            case TextLiteral(text):
                raise NotLowered(f"the text {text!r} has no value here")
        raise NotLowered("it has no value")

    def _free(self, expression: Expression, scope: TextScope) -> str:
        """The name under which the value of an expression is free; empty if it is not."""
        name = free_name(expression, self.table.free_texts)
        return "" if name in self.table.free and self._is_own(name, scope) else name

    def _is_own(self, name: str, scope: TextScope) -> bool:
        """Whether a name is that of a datum or a function of the chart."""
        own = name in scope.script or function_in(scope.node, name) is not None
        return own or self.is_datum(name, scope)

    def _any_value(self, free: str, expression: Expression, scope: TextScope) -> Symbolic:
        """Any value wherever the expression stands, a function of matrices one for each element."""
        if self._does(expression, scope):
            raise NotLowered(f"free: {free} calls functions of the chart, which may do more than give values")
        self.table.free_met.add(free)
        given = [self.value(one, scope) for one in arguments_of(expression)]
        kind = "single" if any(one.kind == "single" for one in given) else "double"
        rows, columns = max(map(size_of, given), default=(1, 1), key=lambda size: size[0] * size[1])
        value = SymbolicScalar(kind, self.table.free[free])
        return matrix([self.writer.kept("free", value) for _ in range(rows * columns)], rows, columns)

    def condition(self, expression: Expression, scope: TextScope) -> Expr:
        """An expression as a condition."""
        return condition_of(self.value(expression, scope))

    @staticmethod
    def _kind(whole: bool, kind: NumberKind, scope: TextScope) -> str:
        if whole and kind in (NumberKind.INTEGER, NumberKind.BITS) and scope.rules.c:
            return UNTYPED
        return "single" if kind is NumberKind.SINGLE else "double"

    def _both(self, left: Expression, right: Expression, scope: TextScope) -> tuple[Symbolic, Symbolic]:
        """Two values, of which the first is what it was before the second was computed."""
        one = self.value(left, scope)
        if self._does(right, scope):
            one = self.kept(one)
        return one, self.value(right, scope)

    def kept(self, value: Symbolic) -> Symbolic:
        """A value as it is now, whatever is assigned later."""
        made = [self.writer.kept("value", one) for _, one in leaves(value, "")]
        return filled(value, iter(made))

    def _does(self, expression: Expression, scope: TextScope) -> bool:
        """Whether a function is called in an expression, which may write data."""
        names = (
            one.function.name
            for one in parts(expression)
            if isinstance(one, Applied) and isinstance(one.function, Name)
        )
        plain = (one.name for one in parts(expression) if isinstance(one, Name))
        return any(n in scope.script or function_in(scope.node, n) for n in (*names, *plain))

    def _is_felt(self, expression: Expression, scope: TextScope) -> bool:
        """Whether it matters that it is computed: it may write data, begin a time, be a fault or free."""
        felt = self._does(expression, scope) or any(
            isinstance(one, Indexed)
            or self._free(one, scope)
            or (
                isinstance(one, Applied)
                and isinstance(one.function, Name)
                and (one.function.name in COUNTED or self.is_datum(one.function.name, scope))
            )
            for one in parts(expression)
        )
        return felt or any(
            zeros_of(one.operator, self.value(one.left, scope), self.value(one.right, scope), scope.rules)
            for part in parts(expression)
            for one in division_in(part)
        )

    def _short(self, sign: str, left: Expression, right: Expression, scope: TextScope) -> Expr:
        """``&&`` and ``||``, of which the right side is computed only where it decides."""
        return self.decided_by(sign, self.condition(left, scope), right, scope)

    def decided_by(self, sign: str, one: Expr, right: Expression, scope: TextScope) -> Expr:
        """The same with the left side as a formula."""
        if isinstance(one, Const) and bool(one.value) == (sign == "||"):
            return one
        if not self._is_felt(right, scope):
            around, self.only_if = self.only_if, folded(self.only_if & (one if sign == "&&" else ~one))
            other = self.condition(right, scope)
            self.only_if = around
            return folded(one & other if sign == "&&" else one | other)
        key = f"{scope.function}:?"
        self.writer.locals[key] = truth(one)

        def rest() -> None:
            made = self.kept(truth(self.condition(right, scope)))
            self.writer.locals[key] = made

        self.writer.choose(one if sign == "&&" else folded(~one), rest)
        found = self.writer.locals.pop(key)
        return single_of(found).expr

    def _named(self, name: str, expression: Expression, scope: TextScope) -> Symbolic:
        if scope.function and (local := self.writer.locals.get(f"{scope.function}:{name}")) is not None:
            if isinstance(local, SymbolicStructure) and local.kind == TWO_TYPES:
                raise NotLowered(f"{name} has values of several types or sizes: give each a name")
            return local
        if name in scope.kept:
            if (kept := self.persistent.get(f"{scope.keeper}.{name}")) is not None:
                return self._now(kept)
            raise NotLowered(f"{name} is read, and nothing is assigned to it before")
        if name in scope.results:
            raise NotLowered(f"{name} is read, and nothing is assigned to it before")
        if (datum := datum_in(scope.node, name)) is not None:
            return self._now(self.cells[datum.ssid])
        found = self.several(expression, scope)
        if not found:
            raise NotLowered(f"{name} has no value")
        return found[0]

    def _now(self, value: Symbolic) -> Symbolic:
        """A datum with what is known of its value at this point."""
        made = [
            SymbolicScalar(one.kind, self.writer.read(one.expr) if isinstance(one.expr, Var) else one.expr)
            for _, one in leaves(value, "")
        ]
        return filled(value, iter(made))

    def is_datum(self, name: str, scope: TextScope) -> bool:
        """Whether a name is that of a variable or a datum."""
        local = bool(scope.function) and f"{scope.function}:{name}" in self.writer.locals
        return local or name in scope.kept or name in scope.results or datum_in(scope.node, name) is not None

    def several(self, expression: Expression, scope: TextScope) -> list[Symbolic]:
        """All values of a call; of anything else its value."""
        called = expression.function if isinstance(expression, Applied) else None
        own = isinstance(called, Name) and self._is_own(called.name, scope)
        if not own and (found := self.word(expression, scope)) is not None:
            return [found]
        match expression:
            case Member(Name(owner), name) if not self.is_datum(owner, scope):
                if (member := self.table.kinds.member(name, owner)) is not None:
                    return [member]
            case Name(name) if name not in scope.script:
                if (member := self.table.kinds.member(name)) is not None:
                    return [member]
        match expression:
            case Member(structure, name):
                value = self.value(structure, scope)
                if isinstance(value, SymbolicStructure) and name in value.elements:
                    return [value.elements[name]]
                raise NotLowered(f"there is no element {name}")
            case Applied(Member(Name("coder"), word), arguments) if not self.is_datum("coder", scope):
                if word in CODER_VALUES and arguments:
                    return [self.value(arguments[0], scope)]
                if word in CODER_WORDS:
                    return []
                raise NotLowered(f"coder.{word} reaches outside of the model")
            case Applied(Name(name), arguments) if not self.is_datum(name, scope):
                return self._called(name, arguments, scope)
            case Applied(whole, arguments):
                value = self.value(whole, scope)
                return [self._indexed(value, arguments, scope)]
            case Name(name):
                return self._called(name, (), scope)
        return [self.value(expression, scope)]

    def _called(self, name: str, arguments: Iterable[Expression], scope: TextScope) -> list[Symbolic]:
        given = list(arguments)
        if (
            name == "isempty"
            and len(given) == 1
            and isinstance(given[0], Name)
            and given[0].name in scope.kept
        ):
            return [truth(self.is_unset(given[0].name, scope))]
        function = function_in(scope.node, name)
        if name in NOTHING and name not in scope.script and function is None:
            return []
        own = name in scope.script or function is not None
        if name == "struct" and not own:
            return [self._structure(given, scope)]
        texts = [] if own else [one.value for one in given if isinstance(one, TextLiteral)]
        values = self._in_turn([one for one in given if own or not isinstance(one, TextLiteral)], scope)
        if name in scope.script:
            return self.script(scope.script[name], values, scope)
        if function is not None:
            return self.call(function, values, scope)
        if name == "sort" and len(values) == 1 and texts in ([], ["ascend"], ["descend"]):
            return [sorted_values(values[0], texts == ["descend"])]
        if name == "error":
            self.writer.fault(f"error(...) may be called: {' '.join(texts)}".rstrip(": "))
            return []
        with self.noting(Applied(Name(name), tuple(given)), scope) as outside:
            noted = replace(scope, rules=replace(scope.rules, outside=outside))
            if texts or name in TYPED:
                return [self._typed(name, values, texts, noted)]
            found = self._of_matlab(name, values, noted)
        if found is not None:
            return found
        if name in self.table.kinds.enumerations and len(values) == 1:
            kind = self.table.kinds.kind(f"Enum: {name}")
            return [each_converted(values[0], kind, scope.rules, self.table.kinds)]
        raise NotLowered(
            f"{name} is no datum, event or function that is known here; a function of MATLAB may be named "
            f"under {FREE}"
        )

    def _of_matlab(self, name: str, values: Sequence[Symbolic], scope: TextScope) -> list[Symbolic] | None:
        """What a function of MATLAB gives; ``None`` for one that is not known."""
        rules, kinds = scope.rules, self.table.kinds
        try:
            if name == "isempty" and values and isinstance(values[0], SymbolicStructure):
                return [truth(const(False))]
            if name in REDUCTIONS and values and not isinstance(values[0], SymbolicStructure):
                lines = reduced(name, values, rules, kinds)
                if lines is not None:
                    return [lines]
            if name in BUILTINS:
                made = BUILTINS[name](values, rules, kinds)
                extreme = name in EXTREMES and len(values) == 1
                return [made, place_of_extreme(name, values[0], rules)] if extreme else [made]
            if name in FURTHER:
                return [FURTHER[name](values, rules, kinds)]
        except (ValueError, IndexError) as error:
            raise NotLowered(f"{name} takes other arguments") from error
        return None

    def _structure(self, given: Sequence[Expression], scope: TextScope) -> Symbolic:
        """``struct('name', value, ...)``."""
        names = [one.value if isinstance(one, TextLiteral) else "" for one in given[::2]]
        if not all(names) or len(given) % 2:
            raise NotLowered("struct takes pairs of a name, as a text, and a value")
        return SymbolicStructure(MADE, dict(zip(names, self._in_turn(given[1::2], scope), strict=True)))

    def _in_turn(self, given: Sequence[Expression], scope: TextScope) -> list[Symbolic]:
        """The values of arguments, each as it is before the later ones are computed."""
        values: list[Symbolic] = []
        for at, one in enumerate(given):
            value = self.value(one, scope)
            later = any(self._does(other, scope) for other in given[at + 1 :])
            values.append(self.kept(value) if later else value)
        return values

    def _typed(
        self, name: str, values: Sequence[Symbolic], texts: Sequence[str], scope: TextScope
    ) -> Symbolic:
        """A function whose last argument names a type, or is ``like`` a value."""
        given, kinds = list(values), self.table.kinds
        like = bool(texts) and texts[-1] == "like" and bool(given)
        known = like or name in ("zeros", "ones", *TYPED)
        if len(texts) > 1 or not known:
            raise NotLowered(f"{name} takes no text here: leave {texts[0]!r} out")
        kind = given.pop().kind if like else kinds.kind(texts[0] if texts else "int32")
        if name in ("zeros", "ones"):
            return each_converted(BUILTINS[name](given, scope.rules, kinds), kind, scope.rules, kinds)
        if name in ("intmax", "intmin"):
            return limit_of(name, kind)
        if len(given) == 1 and name == "cast":
            return each_converted(given[0], kind, scope.rules, kinds)
        if len(given) == 1 and name == "isa":
            return truth(const(given[0].kind == kind))
        raise NotLowered(f"{name} takes other arguments")

    def is_unset(self, name: str, scope: TextScope) -> Expr:
        """Whether nothing was assigned to a persistent variable so far."""
        flag = self.persistent.get(f"{scope.keeper}.{name}?")
        if flag is None:
            return TRUE
        return single_of(self._now(flag)).expr


__all__ = ["ExpressionWriter"]
