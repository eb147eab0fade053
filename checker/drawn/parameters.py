"""Parameters of a model: expressions in which their names stand, and times that are said by them."""

import re
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.syntax import (
    ActionLanguage,
    Applied,
    BinaryOperation,
    ColonRange,
    Expression,
    LastIndex,
    Matrix,
    Member,
    Name,
    Number,
    UnaryOperation,
    parts,
)
from rovercheck.checker.drawn.grammar.text import text_of
from rovercheck.checker.drawn.records import DrawnChart, DrawnModel, DrawnParameter
from rovercheck.checker.drawn.type_names import plain_type

LONGEST = 20_000
"""Letters of an expression; a longer one keeps its names."""
TYPED = re.compile(r"u?int(?:8|16|32|64)|single|boolean|logical")
_INDEXED = re.compile(r"(?<![\w.])([A-Za-z]\w*)\s*\(([^()]*)\)")
_WORD = re.compile(r"""'[^'\n]*'|"[^"\n]*"|(?<![\w.])[A-Za-z]\w*(?!\w)(?!\s*\.\s*[A-Za-z])""")


def values_of(model: DrawnModel) -> dict[str, str]:
    """The values of the parameters of a model by name, as written; one with a type is converted to it."""
    return {one.name: _typed(one) for one in model.parameters}


def _typed(one: DrawnParameter) -> str:
    kind = plain_type(one.type)
    return f"{kind.replace('boolean', 'logical')}({one.value})" if TYPED.fullmatch(kind) else one.value


def expanded(text: str, named: Mapping[str, str]) -> str:
    """An expression of MATLAB with the values of names in it; names behind a dot, and texts, stay.

    An element of a vector is that element.

    >>> expanded("2*K + Mode.K", {"K": "3"}), expanded("V(2)+V(end)", {"V": "single([1 5 7])"})
    ('2*(3) + Mode.K', '(single(5))+(single(7))')
    """
    if text.strip() in named:
        return named[text.strip()]
    text = _INDEXED.sub(lambda one: _element(one, named), text)
    size = len(text) + sum(len(named.get(one[0], "")) for one in _WORD.finditer(text))
    if size > LONGEST:
        return text
    return _WORD.sub(lambda one: f"({named[one[0]]})" if one[0] in named else one[0], text)


def _element(found: re.Match[str], named: Mapping[str, str]) -> str:
    """An element of a vector or a matrix that a name stands for, as a text; as written if it is no such."""
    if found[1] not in named or len(named[found[1]]) > LONGEST:
        return found[0]
    try:
        value = parse_expression(named[found[1]], ActionLanguage.MATLAB)
        indices = parse_expression(f"f({expanded(found[2], named)})", ActionLanguage.MATLAB)
    except GrammarError:
        return found[0]
    around = "{}"
    if isinstance(value, Applied) and isinstance(value.function, Name) and len(value.arguments) == 1:
        [around, value] = [f"{value.function.name}({{}})", value.arguments[0]]
    rows = value.rows if isinstance(value, Matrix) else ((value,),)
    given = indices.arguments if isinstance(indices, Applied) else ()
    place = _place(given, len(rows), len(rows[0]) if rows else 0)
    entries = [one for row in rows for one in row]
    plain = all(len(row) == len(rows[0]) for row in rows) and not any(map(_is_several, entries))
    if place is None or not plain or (around != "{}" and not TYPED.fullmatch(around.partition("(")[0])):
        return found[0]
    return f"({around.format(text_of(entries[place], ActionLanguage.MATLAB))})"


def _is_several(entry: Expression) -> bool:
    """Whether an entry of a matrix may be several values."""
    return any(isinstance(one, ColonRange | Matrix | Name | Member | UnaryOperation) and not (
        isinstance(one, UnaryOperation) and one.operator in ("-", "+")
    ) for one in parts(entry))  # fmt: skip


def _place(indices: Sequence[Expression], rows: int, columns: int) -> int | None:
    """The number of an element, row by row from 0; ``None`` if there is none."""
    ends = (rows * columns,) if len(indices) == 1 else (rows, columns)
    found = [_whole(one, most) for one, most in zip(indices, ends, strict=False)]
    if len(indices) != len(ends) or any(
        a is None or not 0 < a <= b for a, b in zip(found, ends, strict=True)
    ):
        return None
    first, *others = (one - 1 for one in found if one is not None)
    down, across = (first, others[0]) if others else (first % rows, first // rows)
    return down * columns + across


def _whole(index: Expression, last: int) -> int | None:
    """The value of an index that is a constant."""
    match index:
        case Number(value) if value.denominator == 1:
            return int(value)
        case LastIndex():
            return last
        case BinaryOperation("+" | "-" | "*" as sign, left, right):
            one, other = _whole(left, last), _whole(right, last)
            if one is None or other is None:
                return None
            return {"+": one + other, "-": one - other, "*": one * other}[sign]
    return None


def names_in(text: str) -> Iterator[str]:
    """The names in an expression that a parameter may have."""
    return (one[0] for one in _WORD.finditer(text) if one[0].isidentifier())


def seen_in(chart: DrawnChart, named: Mapping[str, str]) -> dict[str, str]:
    """The parameters that an initial value in a chart may name: those that are no other data of it."""
    levels = chart.content.every_level()
    own = {one.name for level in levels for one in level.data if one.scope != "parameter"}
    return {name: value for name, value in named.items() if name not in own}


def rate_of(text: str, named: Mapping[str, str]) -> str:
    """A sample time as one number of seconds, ``-1``, ``0`` or ``inf``; what is none is as it is written.

    >>> rate_of("[Ts, 0]", {"Ts": "0.1"}), rate_of("Inf", {}), rate_of("[0.1 0.05]", {})
    ('0.1', 'inf', '[0.1 0.05]')
    """
    first, *offset = text.strip().strip("[]").replace(",", " ").split() or [""]
    if any(_number(one, named) != 0 for one in offset) or len(offset) > 1:
        return text.strip()
    plain = _bare(expanded(first, named))
    number = _number(first, named)
    return "inf" if plain.lower() == "inf" else str(int(number)) if number in (-1, 0) else plain


def _number(text: str, named: Mapping[str, str]) -> Fraction | None:
    try:
        return Fraction(_bare(expanded(text, named)))
    except (ValueError, ZeroDivisionError):
        return None


def _bare(text: str) -> str:
    """A number without the brackets or the type around it."""
    found = re.fullmatch(r"(?:double|single)?\s*\(([^()]*)\)", text.strip())
    return (found[1] if found else text).strip()


def same_number(one: str, other: str) -> bool:
    """Whether two texts are one number."""
    try:
        return Fraction(one) == Fraction(other)
    except (ValueError, ZeroDivisionError):
        return False


__all__ = ["expanded", "names_in", "rate_of", "same_number", "seen_in", "values_of"]
