"""Random conditions, numbers and actions over given variables, values kept inside their domains."""

from collections.abc import Iterator, Sequence
from typing import TypeVar

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.domain import Bool, Domain, Enum, Num, boolean, enumeration, fixed, integer
from rovercheck.spec_model.lang.expr import Const, Expr, Var, const, ite
from rovercheck.spec_model.lang.time import Span, ms, ticks
from rovercheck.spec_model.lang.words import (
    absolute,
    after,
    bit,
    duration,
    held,
    maximum,
    minimum,
    modulo,
    named,
    quotient,
    rising,
    sign,
)

T = TypeVar("T")
MODE = enumeration("Mode", {"idle": 1, "busy": 2, "lost": 5})
DOMAINS: tuple[Domain, ...] = (boolean, MODE, integer(0, 6), integer(-3, 3), fixed(-1, 1, 0.25))


BLOCK = st.binary(min_size=64, max_size=64)


class Choices:
    """Small numbers, drawn 64 at a time because Hypothesis is slow with many small draws."""

    def __init__(self, draw: DrawFn) -> None:
        self._draw = draw
        self._bytes: Iterator[int] = iter(())

    def below(self, n: int) -> int:
        byte = next(self._bytes, None)
        if byte is None:
            self._bytes = iter(self._draw(BLOCK))
            byte = next(self._bytes)
        return byte % n

    def chance(self, one_in: int) -> bool:
        return self.below(one_in) == 1 % one_in

    def pick(self, options: Sequence[T]) -> T:
        return options[self.below(len(options))]


class Source:
    """What formulas may read, and the choices they are made by.

    ``steady`` are the variables that do not change while a chart is executed.
    """

    def __init__(
        self, choices: Choices, scope: Sequence[Var], steady: Sequence[Var], places: Sequence[Expr] = ()
    ) -> None:
        self.choices = choices
        self.below, self.chance, self.pick = choices.below, choices.chance, choices.pick
        self.scope = list(scope)
        self.steady = list(steady)
        self.places = list(places)

    # --- formulas ---

    def number(self, scope: Sequence[Var], depth: int = 1) -> Expr:
        """A number without unit over the variables given."""
        known = [v for v in scope if isinstance(v.sort, Num)]
        if not known or self.chance(5):
            return const(self.below(5) - 2)
        first = self.pick(known)
        kind = self.below(9) if depth else 0
        match kind:
            case 1:
                return first + self.number(scope, depth - 1)
            case 2:
                return first - self.number(scope, depth - 1)
            case 3:
                return absolute(first)
            case 4:
                return ite(self.condition(scope, 0), first, self.number(scope, depth - 1))
            case 5:
                return modulo(first, 3)
            case 6:
                return -first
            case 7:
                return sign(first) * self.number(scope, 0)
            case 8 if isinstance(first.sort, Num) and first.sort.resolution == 1:
                return quotient(first, 2)
        return first

    def condition(self, scope: Sequence[Var], depth: int = 2, places: bool = False) -> Expr:
        """A condition without temporal words."""
        kind = self.below(10)
        if depth and kind < 3:
            parts = [self.condition(scope, depth - 1, places) for _ in range(2)]
            return parts[0] & parts[1] if kind == 0 else parts[0] | parts[1] if kind == 1 else ~parts[0]
        if places and self.places and kind == 3:
            return self.pick(self.places)
        if depth and kind == 4:
            return named("shown_as_a_name", self.condition(scope, 0))
        return self.atom(scope)

    def atom(self, scope: Sequence[Var]) -> Expr:
        """A flag, or a comparison with a value of the variable's own domain."""
        if not scope:
            return const(self.chance(2))
        v = self.pick(scope)
        value = Const(self.pick(v.domain.values), v.sort)
        match v.sort:
            case Bool():
                return v if self.chance(2) else ~v
            case Enum():
                return v == value if self.chance(2) else v != value
            case Num(resolution, _) if resolution == 1 and v.domain.low >= 0 and self.chance(6):
                return bit(v, 1)
        other = self.number(scope) if self.chance(4) else value
        return [v < other, v <= other, v == other, v >= other, v > other][self.below(5)]

    def span(self, least: int) -> Span:
        count = least + self.below(6)
        return count * ticks if self.chance(2) else 20 * count * ms

    def steady_word(self) -> Expr:
        """``rising`` or ``held`` of something that other components write."""
        if self.chance(2):
            numbers = [v for v in self.steady if isinstance(v.sort, Num)]
            if numbers and self.chance(3):
                return rising(self.pick(numbers))
            return rising(self.condition(self.steady, 1))
        return held(self.condition(self.steady, 1), self.span(0))

    def guard(self, state_words: bool = True) -> Expr:
        """The guard of a transition; ``state_words`` allows ``after`` and ``duration``."""
        kind = self.below(7)
        if kind == 1:
            word = self.steady_word()
        elif kind == 2 and state_words:
            word = after(self.span(1))
        elif kind in (3, 4) and state_words:
            condition = duration(self.condition(self.scope, 1, places=True))
            word = condition > self.span(0) if kind == 3 else condition >= self.span(1)
        else:
            return self.condition(self.scope, 2, places=True)
        if self.chance(3):
            other = self.condition(self.scope, 0)
            return word & other if self.chance(2) else ~word | other
        return word

    # --- actions ---

    def value(self, target: Var, scope: Sequence[Var], words: bool = True) -> Expr:
        """Something that the variable can take; ``words`` allows temporal ones."""
        domain = target.domain
        match target.sort:
            case Bool():
                return self.steady_word() if words and self.chance(8) else self.condition(scope, 1)
            case Enum() as enum:
                options = [Const(self.pick(domain.values), enum) for _ in range(2)]
                return ite(self.condition(scope, 1), *options) if self.chance(3) else options[0]
            case Num(resolution, _) as num:
                low, high = Const(domain.low, num), Const(domain.high, num)
                found = minimum(maximum(self.number([v for v in scope if _fits(v, num)]), low), high)
                fits = isinstance(found.sort, Num) and (found.sort.resolution / resolution).denominator == 1
                return found if fits else Const(self.pick(domain.values), num)
        raise AssertionError(target)

    def actions(self, targets: Sequence[Var], most: int = 2, words: bool = True) -> list[Action]:
        """A few assignments, conditional ones too."""
        made: list[Action] = []
        for _ in range(self.below(most + 1)):
            done: list[Action] = [self.assignment(targets, words)]
            if self.chance(4):
                test = self.condition(self.scope, 1, places=True)
                if words and self.chance(4):
                    test = self.steady_word()
                otherwise = [self.assignment(targets, words)] if self.chance(2) else []
                done = [when(test, done, otherwise)]
            made += done
        return made

    def assignment(self, targets: Sequence[Var], words: bool = True) -> Action:
        target = self.pick(targets)
        return assign(target, self.value(target, self.scope, words))


def _fits(v: Var, num: Num) -> bool:
    return isinstance(v.sort, Num) and (v.sort.resolution / num.resolution).denominator == 1
