"""Ambiguous sentences of the source document, whose interpretations are switches of the model.

A chart is drawn under the defaults; ``spec_model.interpretations`` says what the other choices change in
it.  What is no chart writes ``choose("S43", {"OR": a | b, "AND": a & b})`` where it depends on one.
Each interpretation is a frozen variable; ``fixed`` says which constants to put in its place, by default the
choices of ``ambiguity.toml``.  The file explains every interpretation: what the text says, the choices, the
scenario in which they differ, and why the default is the default.
"""

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path

from rovercheck.spec_model.lang.domain import Bool, Num, Sort, enumeration
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import Const, Expr, Operand, Var, all_of, any_of, ite, lift
from rovercheck.spec_model.lang.specialise import Specialiser

ANY = "any"
"""In place of a choice: the interpretation stays open, and a verdict holds for every choice."""


@dataclass(frozen=True)
class Ambiguity:
    """One ambiguous sentence.

    ``choices`` maps each choice to what it means; ``not_modelled`` gives the reason for those that the
    charts cannot show.  ``scope``: M the model changes with it, P the meaning of a property, MP both.
    """

    id: str
    about: str
    says: str
    default: str
    scenario: str
    because: str
    scope: str
    choices: Mapping[str, str]
    not_modelled: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def var(self) -> Var:
        """The frozen variable of the interpretation."""
        domain = enumeration(f"Interpretation {self.id}", list(self.choices))
        return Var(self.id, domain, domain.raw(self.default), self.says)

    def value(self, choice: str) -> Const:
        """A choice as a constant.  Raises ``ModelError`` for one that is unknown or not modelled."""
        if choice not in self.choices:
            raise ModelError(f"{self.id} has no choice {choice!r}. {did_you_mean(choice, self.choices)}")
        if choice in self.not_modelled:
            raise ModelError(f"{self.id}={choice} is not modelled: {self.not_modelled[choice]}")
        return Const(self.var.domain.raw(choice), self.var.sort)


@cache
def ambiguities() -> dict[str, Ambiguity]:
    """Every interpretation by id, in document order."""
    table = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    return {id: Ambiguity(id, **row) for id, row in table.items()}


def ambiguity(id: str) -> Ambiguity:
    """The interpretation of that id.  Raises ``ModelError`` offering near ids."""
    if id not in ambiguities():
        raise ModelError(f"There is no interpretation {id!r}. {did_you_mean(id, ambiguities())}")
    return ambiguities()[id]


@cache
def under(id: str, *choices: str) -> Expr:
    """The condition that an interpretation is one of the choices."""
    one = ambiguity(id)
    return any_of(*(one.var == one.value(choice) for choice in choices))


def choose(id: str, meanings: Mapping[str, Operand]) -> Expr:
    """What a formula is under each choice of an interpretation.

    Every choice that is modelled must have a meaning.  Raises ``ModelError`` for one that is missing
    or too many.
    """
    one = ambiguity(id)
    modelled = [c for c in one.choices if c not in one.not_modelled]
    if set(meanings) != set(modelled):
        raise ModelError(f"{id} has the choices {', '.join(modelled)}; give each of them, and no other.")
    sort = _sort_of(meanings.values())
    result = lift(meanings[one.default], sort)
    for choice in modelled:
        if choice != one.default:
            result = ite(under(id, choice), lift(meanings[choice], sort), result)
    return result


def _sort_of(meanings: Iterable[Operand]) -> Sort:
    """The sort of the formulas among them; of plain values, boolean or number."""
    values = list(meanings)
    formulas = [m.sort for m in values if isinstance(m, Expr)]
    return formulas[0] if formulas else Bool() if isinstance(values[0], bool) else Num()


def fixed(choices: Mapping[str, str]) -> Specialiser:
    """Replaces every interpretation by its chosen or default constant; those chosen as ``any`` stay.

    Raises ``ModelError`` for an unknown interpretation or choice.
    """
    for id in choices:
        ambiguity(id)
    values = {}
    for id, one in ambiguities().items():
        choice = choices.get(id, one.default)
        if choice != ANY:
            values[id] = one.value(choice)
    return Specialiser(values)


def left_open(choices: Mapping[str, str]) -> tuple[Var, ...]:
    """The variables of the interpretations chosen as ``any``."""
    return tuple(ambiguity(id).var for id, choice in choices.items() if choice == ANY)


def modelled_only(choices: Mapping[str, str]) -> Expr:
    """The condition that the open interpretations are choices that the charts can show."""
    open_ = [ambiguity(id) for id, choice in choices.items() if choice == ANY]
    return all_of(
        *(under(r.id, *(c for c in r.choices if c not in r.not_modelled)) for r in open_ if r.not_modelled)
    )
