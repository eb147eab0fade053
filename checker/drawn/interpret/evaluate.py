"""Expressions and statements of charts and MATLAB functions, evaluated as they stand."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

from rovercheck.checker.drawn.faults import DrawnFault
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
    WholeRange,
)
from rovercheck.checker.drawn.interpret.functions import BUILTINS, WITHOUT_EFFECT
from rovercheck.checker.drawn.interpret.matrix_functions import (
    CODER_VALUES,
    CODER_WORDS,
    EXTREMES,
    FURTHER,
    REDUCTIONS,
    TYPED,
    joined,
    limit_of,
    place_of_extreme,
    reduced,
    sorted_values,
)
from rovercheck.checker.drawn.interpret.memory import ChartMemory, datum_of
from rovercheck.checker.drawn.interpret.operations import binary, unary
from rovercheck.checker.drawn.interpret.values import (
    LITERAL,
    MatlabValue,
    NumberRules,
    Scalar,
    Structure,
    array,
    double,
    each_converted,
    logical,
    scalar,
    scalars,
    shape,
)
from rovercheck.checker.drawn.parsed import FunctionNode, StateNode

MOST_TURNS = 1_000_000
"""Turns of a loop, after which it is taken for one without end."""
MOST_CALLS = 100
MADE = "struct"
"""The kind of structures that scripts make."""


class Dropped(Exception):
    """What an action would do further is dropped, as the state that it belongs to was left meanwhile."""


@dataclass
class CallFrame:
    """Where a text stands: the state whose names it uses, and that its timers belong to.

    ``local``: the variables of a function, if it is one.  ``alive``: asked after each event that is sent.
    ``persistent`` are those that a function keeps, of which ``kept`` are declared, ``results`` the names of
    what it gives; ``last`` is the meaning of ``end``, and ``calls`` how deep functions call each other.
    """

    node: StateNode
    rules: NumberRules
    alive: Callable[[], bool] = lambda: True
    local: dict[str, MatlabValue] | None = None
    persistent: dict[str, MatlabValue] = field(default_factory=dict)
    kept: frozenset[str] = frozenset()
    results: frozenset[str] = frozenset()
    script: Mapping[str, ScriptFunction] = field(default_factory=dict)
    last: int = 0
    calls: int = 0


class ChartWords(Protocol):
    """What only the running chart knows: events, states and times."""

    def word(self, expression: Expression, frame: CallFrame) -> MatlabValue | None:
        """The value of an expression of the chart's own, as ``after(3, sec)``; ``None`` if it is none."""

    def sent(self, expression: Expression, frame: CallFrame) -> bool:
        """Send the event that a statement is; whether it is one."""

    def call(self, function: FunctionNode, arguments: Sequence[MatlabValue], calls: int) -> list[MatlabValue]:
        """Call a function of the chart."""


class Evaluator(ABC):
    """Evaluates the texts of one chart; what is of the chart is asked of ``words``."""

    def __init__(self, memory: ChartMemory, words: ChartWords) -> None:
        self.memory, self._words = memory, words

    # --- expressions ---------------------------------------------------------------------------------------

    def value(self, expression: Expression, frame: CallFrame) -> MatlabValue:
        """The value of an expression.  Raises ``DrawnFault``."""
        if self.memory.free.texts and (free := self._free(expression, frame)):
            return self._any_value(free, expression, frame)
        match expression:
            case Number(value, kind):
                return self._number(value.numerator, value.denominator, kind, frame)
            case Name(name):
                return self._name(name, expression, frame)
            case Member() | Applied():
                return self._one(self._several(expression, frame))
            case Indexed(array_, index):
                return self._element(expression, self.value(array_, frame), index, frame)
            case UnaryOperation(sign, operand):
                return unary(sign, self.value(operand, frame), frame.rules)
            case BinaryOperation(sign, left, right):
                return self._binary(sign, left, right, frame)
            case Matrix(rows):
                return self._matrix(rows, frame)
            case ColonRange():
                return array(
                    map(double, self._range(expression, frame)), 1, len(self._range(expression, frame))
                )
            case LastIndex():
                return double(frame.last)
            case TextLiteral(text):
                raise DrawnFault(f"the text {text!r} has no value here")
        raise DrawnFault("it has no value")

    def _free(self, expression: Expression, frame: CallFrame) -> str:
        """The name under which the value of an expression is free; empty if it is not."""
        name = free_name(expression, self.memory.free.texts)
        return "" if name and self._is_of_the_chart(Name(name), frame) else name

    def _any_value(self, free: str, expression: Expression, frame: CallFrame) -> MatlabValue:
        """What is given for this step, as often as a function of matrices has elements."""
        given = [self.value(one, frame) for one in arguments_of(expression)]
        kind = "single" if any(one.kind == "single" for one in given) else "double"
        rows, columns = max(map(shape, given), default=(1, 1), key=lambda size: size[0] * size[1])
        value = scalar(each_converted(double(self.memory.free.values[free]), kind, frame.rules))
        return array([value] * (rows * columns), rows, columns)

    def truth(self, expression: Expression, frame: CallFrame) -> bool:
        """An expression as a condition."""
        value = self.value(expression, frame)
        if isinstance(value, Structure):
            raise DrawnFault("a structure is no condition")
        return value.truth

    @staticmethod
    def _number(numerator: int, denominator: int, kind: NumberKind, frame: CallFrame) -> Scalar:
        whole = denominator == 1 and kind in (NumberKind.INTEGER, NumberKind.BITS)
        if whole and frame.rules.c:
            return Scalar(LITERAL, numerator)
        return Scalar("single" if kind is NumberKind.SINGLE else "double", numerator / denominator)

    def _binary(self, sign: str, left: Expression, right: Expression, frame: CallFrame) -> MatlabValue:
        if sign == "&&":
            return logical(self.truth(left, frame) and self.truth(right, frame))
        if sign == "||":
            return logical(self.truth(left, frame) or self.truth(right, frame))
        return binary(sign, self.value(left, frame), self.value(right, frame), frame.rules)

    def _name(self, name: str, expression: Expression, frame: CallFrame) -> MatlabValue:
        if frame.local is not None and name in frame.local:
            return frame.local[name]
        if name in frame.kept:
            return frame.persistent[name]
        if name in frame.results:
            raise DrawnFault(f"{name} is read, and nothing is assigned to it before")
        if (datum := datum_of(frame.node, name)) is not None:
            return self.memory.read(datum.ssid)
        return self._one(self._several(expression, frame))

    def _several(self, expression: Expression, frame: CallFrame) -> list[MatlabValue]:
        """The values of a call; of anything else its value."""
        if not (isinstance(expression, Applied) and self._is_of_the_chart(expression.function, frame)):
            found = self._words.word(expression, frame)
            if found is not None:
                return [found]
        match expression:
            case Member(Name(owner), name) if member := self.memory.types.member(name, owner):
                if self._is_no_datum(owner, frame):
                    return [member]
            case Name(name) if (member := self.memory.types.member(name)) is not None:
                if name not in frame.script:
                    return [member]
        match expression:
            case Member(structure, name):
                value = self.value(structure, frame)
                if isinstance(value, Structure) and name in value.elements:
                    return [value.elements[name]]
                raise DrawnFault(f"there is no element {name}")
            case Applied(Member(Name("coder"), word), arguments) if self._is_no_datum("coder", frame):
                return self._of_coder(word, arguments, frame)
            case Applied(Name(name), arguments) if self._is_no_datum(name, frame):
                return self._called(name, arguments, frame)
            case Applied(whole, arguments):
                return [self._indexed(self.value(whole, frame), arguments, frame)]
            case Name(name):
                return self._called(name, (), frame)
        return [self.value(expression, frame)]

    def _is_of_the_chart(self, called: Expression, frame: CallFrame) -> bool:
        """Whether a datum or a function has the name, which may be that of a word of time."""
        if not isinstance(called, Name):
            return False
        functions = frame.script.keys() | {name for node in frame.node.lineage() for name in node.functions}
        return called.name in functions or not self._is_no_datum(called.name, frame)

    def _is_no_datum(self, name: str, frame: CallFrame) -> bool:
        local = (frame.local or {}).keys() | frame.kept | frame.results
        return name not in local and datum_of(frame.node, name) is None

    @staticmethod
    def _one(values: Sequence[MatlabValue]) -> MatlabValue:
        if not values:
            raise DrawnFault("a function that gives nothing stands where a value must")
        return values[0]

    # --- calls ---------------------------------------------------------------------------------------------

    def _called(self, name: str, arguments: Iterable[Expression], frame: CallFrame) -> list[MatlabValue]:
        given = list(arguments)
        function = next((one.functions[name] for one in frame.node.lineage() if name in one.functions), None)
        if frame.calls > MOST_CALLS:
            raise DrawnFault(f"{name} calls itself, or more than {MOST_CALLS} functions call each other")
        if name in frame.script or function is not None:
            values = [self.value(one, frame) for one in given]
            if name in frame.script:
                return self.script(frame.script[name], values, frame)
            assert function is not None
            return self._words.call(function, values, frame.calls + 1)
        if name in WITHOUT_EFFECT:
            return []
        if name == "struct":
            return [self._structure(given, frame)]
        texts = [one.value for one in given if isinstance(one, TextLiteral)]
        values = [self.value(one, frame) for one in given if not isinstance(one, TextLiteral)]
        if name == "sort" and len(values) == 1 and texts in ([], ["ascend"], ["descend"]):
            return [sorted_values(values[0], texts == ["descend"])]
        if name == "error":
            raise DrawnFault(f"error(...) is called: {' '.join(texts)}".rstrip(": "))
        if texts or name in TYPED:
            return [self._typed(name, values, texts, frame)]
        try:
            if name == "isempty" and values and isinstance(values[0], Structure):
                return [logical(False)]
            if name in REDUCTIONS and values and not isinstance(values[0], Structure):
                lines = reduced(name, values, frame.rules)
                if lines is not None and (len(values) > 1 or min(shape(values[0])) > 1):
                    return [lines]
            if name in BUILTINS:
                found = BUILTINS[name](values, frame.rules)
                return [found, place_of_extreme(name, values[0])] if name in EXTREMES else [found]
            if name in FURTHER:
                return [FURTHER[name](values, frame.rules)]
        except (ValueError, IndexError) as error:
            raise DrawnFault(f"{name} takes other arguments") from error
        if name in self.memory.types.enumerations and len(values) == 1:
            return [each_converted(values[0], f"Enum: {name}", frame.rules)]
        raise DrawnFault(f"{name} is not known here")

    def _structure(self, given: Sequence[Expression], frame: CallFrame) -> Structure:
        """``struct('name', value, ...)``."""
        elements = {}
        for name, value in zip(given[::2], given[1::2], strict=False):
            if not isinstance(name, TextLiteral):
                raise DrawnFault("struct takes pairs of a name, as a text, and a value")
            elements[name.value] = self.value(value, frame)
        return Structure(MADE, elements)

    def _of_coder(self, word: str, arguments: Sequence[Expression], frame: CallFrame) -> list[MatlabValue]:
        """What is written for the code generator means nothing, or the value that it is about."""
        if word in CODER_VALUES and arguments:
            return [self.value(arguments[0], frame)]
        if word in CODER_WORDS:
            return []
        raise DrawnFault(f"coder.{word} reaches outside of the model, which is not known here")

    def _typed(
        self, name: str, values: Sequence[MatlabValue], texts: Sequence[str], frame: CallFrame
    ) -> MatlabValue:
        """A function whose last argument names a type, or is ``like`` a value."""
        given, like = list(values), bool(texts and values) and texts[-1] == "like"
        if len(texts) > 1 or not (like or name in ("zeros", "ones", *TYPED)):
            raise DrawnFault(f"{name} takes no text here: leave {texts[0]!r} out")
        kind = given.pop().kind if like else self.memory.types.kind(texts[0] if texts else "int32")
        if name in ("zeros", "ones"):
            return each_converted(BUILTINS[name](given, frame.rules), kind, frame.rules)
        if name == "cast" and len(given) == 1:
            return each_converted(given[0], kind, frame.rules)
        if name == "isa" and len(given) == 1:
            return logical(given[0].kind == kind)
        if name in ("intmax", "intmin"):
            return limit_of(name, kind)
        raise DrawnFault(f"{name} takes other arguments")

    @abstractmethod
    def script(
        self, function: ScriptFunction, values: Sequence[MatlabValue], caller: CallFrame
    ) -> list[MatlabValue]:
        """Call a MATLAB function with these values."""

    # --- indices -------------------------------------------------------------------------------------------

    def _element(
        self, whole: Indexed, value: MatlabValue, index: Expression, frame: CallFrame
    ) -> MatlabValue:
        """An element of C, counted from the first index of its datum."""
        at = int(scalar(self.value(index, frame)).value) - self._first(whole.array, frame)
        found = scalars(value)
        if not 0 <= at < len(found):
            raise DrawnFault(f"the index {at} of {len(found)} values")
        return found[at]

    def _first(self, array_: Expression, frame: CallFrame) -> int:
        datum = datum_of(frame.node, array_.name) if isinstance(array_, Name) else None
        return int(datum.first_index or 0) if datum is not None else 0

    def _indexed(self, value: MatlabValue, indices: Sequence[Expression], frame: CallFrame) -> MatlabValue:
        places, size = self._places(value, indices, frame)
        found = scalars(value)
        return array((found[at] for at in places), *size)

    def _places(
        self, value: MatlabValue, indices: Sequence[Expression], frame: CallFrame
    ) -> tuple[list[int], tuple[int, int]]:
        """Where the elements are that indices from 1 name, and in how many rows and columns."""
        rows, columns = shape(value)
        if len(indices) == 1:
            every = self._index(indices[0], rows * columns, frame)
            by_column = [(at % rows) * columns + at // rows for at in every]
            return by_column, ((1, len(every)) if rows == 1 else (len(every), 1))
        down, across = (
            self._index(index, most, frame) for index, most in zip(indices, (rows, columns), strict=True)
        )
        return [r * columns + c for r in down for c in across], (len(down), len(across))

    def _index(self, index: Expression, most: int, frame: CallFrame) -> list[int]:
        if isinstance(index, WholeRange):
            return list(range(most))
        given = scalars(self.value(index, replace(frame, last=most)))
        if given and all(one.kind == "logical" for one in given):
            return [at for at, one in enumerate(given) if one.value]
        for one in given:
            if one.value != int(one.value) or not 1 <= one.value <= most:
                raise DrawnFault(f"the index {one.value:g} of {most} values, which are counted from 1")
        return [int(one.value) - 1 for one in given]

    def _matrix(self, rows: Sequence[Sequence[Expression]], frame: CallFrame) -> MatlabValue:
        made = [[self.value(one, frame) for one in row] for row in rows]
        return joined(made, frame.rules)

    def _range(self, one: ColonRange, frame: CallFrame) -> list[float]:
        start, stop = (scalar(self.value(end, frame)).value for end in (one.start, one.stop))
        step = 1 if one.step is None else scalar(self.value(one.step, frame)).value
        count = int((stop - start) / step + 1e-10) + 1 if step and (stop - start) / step >= 0 else 0
        if count > MOST_TURNS:
            raise DrawnFault(f"a range of {count:,} numbers")
        return [start + step * number for number in range(count)]


__all__ = ["MADE", "CallFrame", "ChartWords", "Dropped", "Evaluator"]
