"""Contracts: what a property proved of a board says, in the place of the board."""

from dataclasses import dataclass

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import TRUE, Apply, Expr, Var, flag
from rovercheck.spec_model.lang.operators import Op


@dataclass(frozen=True, eq=False)
class Contract:
    """If ``premise`` is true in an execution, and ``before`` in the one before, ``then`` is true after it.

    With ``first=False`` nothing is said of the first execution, which has none before it in any case.
    ``then`` is a flag of the contract's own, or its negation; where the premise says nothing, ``free``, an
    input, says what it is.  So the block does all that the sentence allows, and nothing else.
    """

    name: str
    text: str
    premise: Expr
    then: Expr
    free: Var
    before: Expr = TRUE
    first: bool = True

    @property
    def begins(self) -> int:
        """The first execution of which it says something."""
        return 1 if self.first and self.before is TRUE else 2

    @property
    def block(self) -> Block:
        remembered = flag(f"{self.name}.before", f"{self.before}, in the step before")
        note = [] if self.begins == 1 else [assign(remembered, self.before)]
        given = self.premise & remembered if note else self.premise
        match self.then:
            case Var() as own:
                actions = [assign(own, given | self.free)]
            case Apply(Op.NOT, (Var() as own,), _):
                actions = [assign(own, ~given & self.free)]
            case _:
                raise AssertionError(f"{self.name}: {self.then} is no flag")
        return Block(self.name, [*actions, *note], text=self.text)
