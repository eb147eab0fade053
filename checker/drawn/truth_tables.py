"""Truth tables as actions: their conditions are computed first, then the first decision is looked for that
fits, and its actions are done.
"""

import re
from collections.abc import Sequence
from fractions import Fraction
from functools import reduce

from rovercheck.checker.drawn.grammar.actions import ActionStatement, Assignment, IfBranch, IfStatement
from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.labels import parse_transition_label
from rovercheck.checker.drawn.grammar.syntax import (
    ActionLanguage,
    BinaryOperation,
    Expression,
    Name,
    Number,
    NumberKind,
    UnaryOperation,
)
from rovercheck.checker.drawn.records import DrawnTruthTable

_LABEL = re.compile(r"\s*([A-Za-z]\w*)\s*:(?![:=])")
_SEPARATORS = re.compile(r"[\s,;]+")
ALWAYS = "INIT"
"""The label of an action that is done before the conditions are computed."""
AT_LAST = "FINAL"
"""And of one that is done after the decision."""


def actions_of(
    table: DrawnTruthTable, language: ActionLanguage
) -> tuple[tuple[str, ...], tuple[ActionStatement, ...]]:
    """The names that keep the conditions, and what a table does.

    Raises ``GrammarError`` for a condition or an action that cannot be parsed, and for a decision that names
    an action that is not there.

    >>> from rovercheck.checker.drawn.records import DrawnTruthTable
    >>> table = DrawnTruthTable(("u > 1",), (("T",), ("-",)), ("1", "2"), ("y = 1;", "y = 2;"))
    >>> actions_of(table, ActionLanguage.MATLAB)[0]
    ('condition 1',)
    """
    names = tuple(f"condition {number}" for number, _ in enumerate(table.conditions, 1))
    kept = tuple(
        Assignment((Name(name),), _condition(text, language))
        for name, text in zip(names, table.conditions, strict=True)
    )
    labels, bodies = _labelled(table.actions, language)
    branches = tuple(
        IfBranch(_decision(column, names), _chosen(chosen, labels, bodies))
        for column, chosen in zip(table.decisions, table.chosen, strict=True)
    )
    first, last = (bodies[labels[one]] if one in labels else () for one in (ALWAYS, AT_LAST))
    decide = (IfStatement(branches, ()),) if branches else ()
    return names, (*first, *kept, *decide, *last)


def _condition(text: str, language: ActionLanguage) -> Expression:
    """A condition as a truth value; the label before it does not count."""
    found = _LABEL.match(text)
    parsed = parse_expression(text[found.end() :] if found else text, language)
    return UnaryOperation("!", UnaryOperation("!", parsed))


def _labelled(
    texts: Sequence[str], language: ActionLanguage
) -> tuple[dict[str, int], list[tuple[ActionStatement, ...]]]:
    """The actions in their order, and where each is by its number and its label."""
    labels: dict[str, int] = {}
    bodies = []
    for number, text in enumerate(texts):
        found = _LABEL.match(text)
        labels[str(number + 1)] = number
        if found:
            labels[found[1]] = number
        plain = text[found.end() :] if found else text
        bodies.append(parse_transition_label(f"{{{plain}\n}}", language).condition_actions)
    return labels, bodies


def _decision(column: Sequence[str], names: Sequence[str]) -> Expression:
    """Whether a decision fits.  Raises ``GrammarError`` for what is no ``T``, ``F`` or ``-``."""
    every: list[Expression] = []
    for wanted, name in zip(column, names, strict=True):
        if wanted not in ("T", "F", "-"):
            raise GrammarError(f"a decision has {wanted!r}: write T, F or -", wanted, 0)
        if wanted != "-":
            every.append(Name(name) if wanted == "T" else UnaryOperation("!", Name(name)))
    if not every:
        one = Number(Fraction(1), NumberKind.INTEGER, "1")
        return BinaryOperation("==", one, one)
    return reduce(lambda sofar, one: BinaryOperation("&&", sofar, one), every)


def _chosen(
    text: str, labels: dict[str, int], bodies: Sequence[tuple[ActionStatement, ...]]
) -> tuple[ActionStatement, ...]:
    """What one decision does: the actions that it names, one after the other."""
    found: list[ActionStatement] = []
    for name in filter(None, _SEPARATORS.split(text)):
        if name not in labels:
            raise GrammarError(f"a decision names the action {name}, which is not there", text, 0)
        found += bodies[labels[name]]
    return tuple(found)


__all__ = ["actions_of"]
