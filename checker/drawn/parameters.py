"""Parameters of a model: expressions in which their names stand, and times that are said by them."""

import re
from collections.abc import Iterator, Mapping
from fractions import Fraction

from rovercheck.checker.drawn.records import DrawnChart, DrawnModel, DrawnParameter
from rovercheck.checker.drawn.type_names import plain_type

LONGEST = 20_000
"""Letters of an expression; a longer one keeps its names."""
TYPED = re.compile(r"u?int(?:8|16|32|64)|single|boolean|logical")
_WORD = re.compile(r"""'[^'\n]*'|"[^"\n]*"|(?<![\w.])[A-Za-z]\w*(?!\w)(?!\s*\.\s*[A-Za-z])""")


def values_of(model: DrawnModel) -> dict[str, str]:
    """The values of the parameters of a model by name, as written; one with a type is converted to it."""
    return {one.name: _typed(one) for one in model.parameters}


def _typed(one: DrawnParameter) -> str:
    kind = plain_type(one.type)
    return f"{kind.replace('boolean', 'logical')}({one.value})" if TYPED.fullmatch(kind) else one.value


def expanded(text: str, named: Mapping[str, str]) -> str:
    """An expression of MATLAB with the values of names in it; names behind a dot, and texts, stay.

    >>> expanded("2*K + Mode.K", {"K": "3"})
    '2*(3) + Mode.K'
    """
    if text.strip() in named:
        return named[text.strip()]
    size = len(text) + sum(len(named.get(one[0], "")) for one in _WORD.finditer(text))
    if size > LONGEST:
        return text
    return _WORD.sub(lambda one: f"({named[one[0]]})" if one[0] in named else one[0], text)


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


__all__ = ["expanded", "names_in", "rate_of", "seen_in", "values_of"]
