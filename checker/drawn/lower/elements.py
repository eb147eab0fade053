"""Matrices, ranges and the elements that indices name."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import replace

from rovercheck.checker.drawn.grammar.syntax import (
    ColonRange,
    Expression,
    Name,
    WholeRange,
)
from rovercheck.checker.drawn.lower.conversions import as_number, each_converted
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.names import TextScope, datum_in
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import (
    LOGICAL,
    REALS,
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicArray,
    SymbolicScalar,
    chosen,
    constant_of,
    flat,
    folded,
    least_and_greatest,
    matrix,
    number,
    single_of,
    size_of,
)
from rovercheck.spec_model.lang.expr import Expr

MOST_ELEMENTS = 10_000
"""Numbers of a range that is written out."""


class ElementWriter(ABC):
    """Makes formulas of the matrices in the texts of one chart; indices that name nothing are faults."""

    def __init__(self, table: DataTable, writer: ProgramWriter) -> None:
        self.table, self.writer = table, writer

    @abstractmethod
    def value(self, expression: Expression, scope: TextScope) -> Symbolic:
        """The value of an expression.  Raises ``NotLowered``."""

    def first_index(self, whole: Expression, scope: TextScope) -> int:
        """The number of the first element of an array of C."""
        datum = datum_in(scope.node, whole.name) if isinstance(whole, Name) else None
        return int(datum.first_index or 0) if datum is not None else 0

    def _element(self, value: Symbolic, at: Expr, first: int) -> SymbolicScalar:
        every = flat(value)
        self.check_index(at, first, len(every))
        return _one_of(every, at, first)

    def check_index(self, at: Expr, first: int, count: int) -> None:
        """Note the steps in which an index has no element."""
        whole = constant_of(at)
        if whole is not None:
            if whole.denominator != 1 or not first <= whole < first + count:
                raise NotLowered(f"the index {whole} of {count} values")
            return
        low, high = least_and_greatest(at)
        if low < first or high > first + count - 1:
            inside = folded(folded(at >= first) & folded(at <= first + count - 1))
            self.writer.choose(
                inside,
                lambda: None,
                lambda: self.writer.fault(f"an index, `{at}`, may name no element of {count}"),
            )

    def _indexed(self, value: Symbolic, indices: Sequence[Expression], scope: TextScope) -> Symbolic:
        rows, columns = size_of(value)
        every = flat(value)
        if len(indices) == 1:
            by_column = [every[(at % rows) * columns + at // rows] for at in range(rows * columns)]
            chosen_ = self.index(indices[0], rows * columns, scope)
            made = [self._at(by_column, one) for one in chosen_]
            return matrix(made, *((1, len(made)) if rows == 1 else (len(made), 1)), every[0].kind)
        down, across = (
            self.index(index, most, scope) for index, most in zip(indices, (rows, columns), strict=True)
        )
        made = []
        for r in down:
            for c in across:
                row = [
                    self._at([every[at * columns + other] for at in range(rows)], r)
                    for other in range(columns)
                ]
                made.append(self._at(row, c))
        return matrix(made, len(down), len(across), every[0].kind)

    def _at(self, values: Sequence[SymbolicScalar], index: Expr) -> SymbolicScalar:
        self.check_index(index, 1, len(values))
        return _one_of(values, index, 1)

    def index(self, index: Expression, most: int, scope: TextScope) -> list[Expr]:
        """The numbers, from 1, that an index means of so many elements."""
        if isinstance(index, WholeRange):
            return [number("double", at).expr for at in range(1, most + 1)]
        given = flat(self.value(index, replace(scope, last=most)))
        if given and all(one.kind == LOGICAL for one in given):
            if any(one.constant is None for one in given):
                raise NotLowered("elements that conditions choose: choose them one by one")
            return [number("double", at + 1).expr for at, one in enumerate(given) if one.constant]
        return [as_number(one) for one in given]

    def _matrix(self, rows: Sequence[Sequence[Symbolic]], scope: TextScope) -> Symbolic:
        every = [line for row in rows for line in _beside([one for one in row if flat(one)])]
        width = len(every[0]) if every else 0
        if any(len(row) != width for row in every):
            raise NotLowered("the rows of a matrix are not as long as each other")
        kind = _kind_of_all([one.kind for row in every for one in row])
        made = SymbolicArray(kind, len(every), width, tuple(one for row in every for one in row))
        if not every:
            return made
        found = each_converted(made, kind, scope.rules, self.table.kinds)
        return matrix(flat(found), len(every), width)

    def _range(self, one: ColonRange, scope: TextScope) -> Symbolic:
        ends = [self.value(end, scope) for end in (one.start, one.stop)]
        step = number("double", 1) if one.step is None else single_of(self.value(one.step, scope))
        start, stop = (single_of(end) for end in ends)
        if start.constant is None or stop.constant is None or not step.constant:
            raise NotLowered("a range whose ends are no constants")
        count = (stop.constant - start.constant) / step.constant
        if count >= MOST_ELEMENTS:
            raise NotLowered(f"a range of more than {MOST_ELEMENTS:,} numbers")
        kind = next((k.kind for k in (start, step, stop) if k.kind not in REALS), "double")
        values = [
            number(kind, start.constant + step.constant * at)
            for at in range(int(count) + 1 if count >= 0 else 0)
        ]
        return matrix(values, 1, len(values), kind) if len(values) != 1 else values[0]


def _beside(blocks: Sequence[Symbolic]) -> list[list[SymbolicScalar]]:
    """The rows of matrices that stand beside each other.  Raises ``NotLowered`` for others."""
    heights = {size_of(one)[0] for one in blocks}
    if len(heights) > 1:
        raise NotLowered("matrices that stand beside each other have not as many rows")
    made: list[list[SymbolicScalar]] = [[] for _ in range(max(heights, default=0))]
    for one in blocks:
        columns = size_of(one)[1]
        for at, row in enumerate(made):
            row += flat(one)[at * columns : (at + 1) * columns]
    return made


def _kind_of_all(kinds: Sequence[str]) -> str:
    """The type of a matrix of these: the first of integers or members, else the strongest of the others."""
    weaker = ("single", "double", UNTYPED, LOGICAL)
    strong = (one for one in kinds if one not in weaker)
    return next(strong, next((one for one in weaker if one in kinds), "double"))


def _one_of(values: Sequence[SymbolicScalar], at: Expr, first: int) -> SymbolicScalar:
    """The element that an index names; the last one where it names none."""
    whole = constant_of(at)
    if whole is not None:
        return values[int(whole) - first]
    made = values[-1].expr
    for number_, one in reversed(list(enumerate(values[:-1]))):
        made = chosen(folded(at == first + number_), one.expr, made)
    return SymbolicScalar(values[0].kind, made)


__all__ = ["ElementWriter"]
