"""Candidate invariants: what held in every state of a sample and may hold in every reachable one.

Templates go from cheap to rich: ranges, values never taken, pairs that exclude each other, ranges
under a condition, and bounded differences and sums of counters (also under a condition, also up to
saturation).  A candidate is a guess until an engine has shown it to be inductive.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.encode.cone import Slice
from rovercheck.checker.encode.terms import Terms
from rovercheck.checker.system.arrays import ArrayProgram, Column, Columns, column
from rovercheck.checker.system.intervals import postorder
from rovercheck.spec_model.lang.domain import Bool, Enum, Num
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import variables

_MOST_MEMBERS = 12
"""Members of an enumeration, or values of a number, that are distinguished one by one."""

_TELLING = 3
"""Different values of a number at which a bound of a difference must have been met."""

Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Atom:
    """A condition on one variable and the sampled states in which it holds."""

    var: Var
    expr: Expr
    holds: Mask


@dataclass(frozen=True)
class TemplateCube:
    """States that agree with one of them on the variables named."""

    valuation: Mapping[str, int]
    names: frozenset[str]


class Candidates:
    """Builds candidates about the variables of a slice from sampled states."""

    def __init__(self, part: Slice, sample: Columns) -> None:
        self.terms = Terms()
        self.sample = sample
        self._part = part
        self._scope = [v for v in (*part.variables, *part.frozen) if len(v.domain) > 1]
        self._numbers = [v for v in self._scope if isinstance(v.sort, Num)]
        self._near = _neighbours(part)
        self._counters = {v.name for v in self._numbers if _counts(v, part)}
        self._latches = {v.name for v in self._scope if _latches(v, part)}
        self.atoms = [a for v in self._scope for a in self._atoms_of(v)]
        self._conditions = [a for a in self.atoms if not isinstance(a.var.sort, Num)]

    # --- one variable ----------------------------------------------------------------------------

    def ranges(self) -> Iterator[Expr]:
        """Least and greatest values, where the domain is wider, and values never taken."""
        for var in self._scope:
            seen = np.unique(self.sample[var.name])
            if isinstance(var.sort, Num):
                yield from self._within(var, int(seen[0]), int(seen[-1]), var.domain.low, var.domain.high)
            if len(var.domain) <= _MOST_MEMBERS:
                for value in set(var.domain.values) - set(seen.astype(np.int64).tolist()):
                    yield self.terms.negation(self._equals(var, value))

    def _within(self, var: Var, low: int, high: int, known_low: int, known_high: int) -> Iterator[Expr]:
        if low > known_low:
            yield self.terms.at_most(self._constant(low, var), self.terms.var(var))
        if high < known_high:
            yield self.terms.at_most(self.terms.var(var), self._constant(high, var))

    def _equals(self, var: Var, value: int) -> Expr:
        return self.terms.equal(self.terms.var(var), self._constant(value, var))

    def _constant(self, value: int, like: Var) -> Expr:
        return self.terms.const(value, like.sort)

    def _atoms_of(self, var: Var) -> Iterator[Atom]:
        """Conditions on a variable that are true in some sampled states and false in others."""
        values = self.sample[var.name]
        for expr, holds in self._raw_atoms(var, values):
            if holds.any() and not holds.all():
                yield Atom(var, expr, holds)
                yield Atom(var, self.terms.negation(expr), ~holds)

    def _raw_atoms(self, var: Var, values: Column) -> Iterator[tuple[Expr, Mask]]:
        if isinstance(var.sort, Bool):
            yield self.terms.var(var), values
            return
        seen = np.unique(values).tolist()
        if len(var.domain) <= _MOST_MEMBERS or isinstance(var.sort, Enum):
            chosen = seen if len(seen) != 2 else seen[:1]
        else:
            chosen = sorted({seen[0], seen[-1], var.init} & set(seen))
        for value in chosen:
            yield self._equals(var, value), values == value

    # --- two variables ---------------------------------------------------------------------------

    def exclusions(self) -> Iterator[Expr]:
        """Pairs of conditions that were never true together: implications and one-hot facts."""
        if not self.atoms:
            return
        matrix = np.stack([a.holds for a in self.atoms]).astype(np.float32)
        together = matrix @ matrix.T
        for i, j in zip(*np.nonzero(np.triu(together == 0, 1)), strict=True):
            a, b = self.atoms[i], self.atoms[j]
            if a.var.name != b.var.name and self._related(a.var, b.var):
                yield self._never(a.expr, b.expr)

    def _never(self, *conditions: Expr) -> Expr:
        return self.terms.disjunction([self.terms.negation(c) for c in conditions])

    def _related(self, a: Var, b: Var) -> bool:
        near = b.name in self._near[a.name] or a.name in self._near[b.name]
        return near or a.name in self._latches or b.name in self._latches

    def ranges_under(self) -> Iterator[Expr]:
        """Ranges of numbers under a condition on another variable, narrower than without it."""
        for var in self._numbers:
            values = self.sample[var.name]
            low, high = int(values.min()), int(values.max())
            for atom in self._conditions_near(var):
                inside = values[atom.holds]
                for bound in self._within(var, int(inside.min()), int(inside.max()), low, high):
                    yield self.terms.disjunction((self.terms.negation(atom.expr), bound))

    def _conditions_near(self, *numbers: Var) -> Iterator[Atom]:
        for atom in self._conditions:
            if all(atom.var.name != v.name and self._related(atom.var, v) for v in numbers):
                yield atom

    def latched(self) -> list[Expr]:
        """Those candidates that depend on a latch: what is so until something has happened, or since."""
        made = (*self.exclusions(), *self.ranges_under())
        return [c for c in made if not self._latches.isdisjoint(variables(c))]

    # --- two numbers -----------------------------------------------------------------------------

    def relations(self) -> Iterator[Expr]:
        """Bounds of differences and sums of two counters, everywhere and under a condition."""
        moving = [v for v in self._numbers if v.name in self._counters]
        everywhere: Mask = np.ones(len(next(iter(self.sample.values()), ())), dtype=np.bool_)
        for x, y in combinations(moving, 2):
            if x.sort != y.sort or not self._related(x, y):
                continue
            yield from self._relation(x, y, (), everywhere)
            for atom in self._conditions_near(x, y):
                yield from self._relation(x, y, (atom.expr,), atom.holds)

    def _relation(self, x: Var, y: Var, under: Sequence[Expr], where: Mask) -> Iterator[Expr]:
        a, b = self.sample[x.name][where], self.sample[y.name][where]
        premises = [self.terms.negation(c) for c in under]
        for bound in (
            *self._differences(x, y, a, b),
            *self._differences(y, x, b, a),
            *self._sums(x, y, a, b),
        ):
            yield self.terms.disjunction((*premises, bound))

    def _differences(self, x: Var, y: Var, a: Column, b: Column) -> Iterator[Expr]:
        """``x - y <= c``, and ``x - y <= c`` where ``y`` has not reached its greatest value."""
        gap, difference = a - b, self._made(Op.SUB, x, y)
        if _informative(gap, a):
            yield self.terms.at_most(difference, self._constant(int(gap.max()), x))
            return
        below = b < b.max()
        if below.any() and _informative(gap[below], a[below]):
            capped = self.terms.at_most(difference, self._constant(int(gap[below].max()), x))
            yield self.terms.disjunction((self._equals(y, int(b.max())), capped))

    def _sums(self, x: Var, y: Var, a: Column, b: Column) -> Iterator[Expr]:
        both, total = a + b, self._made(Op.ADD, x, y)
        if _informative(both, a):
            yield self.terms.at_most(total, self._constant(int(both.max()), x))
        if _informative(-both, a):
            yield self.terms.at_most(self._constant(int(both.min()), x), total)

    def _made(self, op: Op, x: Var, y: Var) -> Expr:
        return self.terms.apply(op, (self.terms.var(x), self.terms.var(y)), x.sort)

    # --- from a state that no run visits -----------------------------------------------------

    def excluding(self, cube: TemplateCube, order: np.random.Generator) -> Expr | None:
        """A clause over few conditions that is false in the cube and true in the whole sample.

        Conditions that hold in the cube are dropped one by one, in a random order, while no sampled
        state meets all of them.  None when the sample visits the cube.
        """
        met = list(self._met_by(cube))
        shuffled = [met[i] for i in order.permutation(len(met))]
        kept = _least_unmet(shuffled) if shuffled else None
        return None if kept is None else self._never(*(shuffled[i].expr for i in kept))

    def _met_by(self, cube: TemplateCube) -> Iterator[Atom]:
        inside = [v for v in self._scope if v.name in cube.names]
        for var in inside:
            values, own = self.sample[var.name], cube.valuation[var.name]
            if isinstance(var.sort, Num):
                yield from self._sides(var, values, own)
            else:
                yield Atom(var, self._equals(var, own), values == own)
        for x, y in combinations(inside, 2):
            if isinstance(x.sort, Num) and x.sort == y.sort and self._related(x, y):
                yield from self._compared(x, y, cube.valuation)

    def _sides(self, var: Var, values: Column, own: int) -> Iterator[Atom]:
        here, limit = self.terms.var(var), self._constant(own, var)
        yield Atom(var, self.terms.at_most(here, limit), values <= own)
        yield Atom(var, self.terms.at_most(limit, here), values >= own)

    def _compared(self, x: Var, y: Var, valuation: Mapping[str, int]) -> Iterator[Atom]:
        gap, own = self.sample[x.name] - self.sample[y.name], valuation[x.name] - valuation[y.name]
        difference, limit = self._made(Op.SUB, x, y), self._constant(own, x)
        yield Atom(x, self.terms.at_most(difference, limit), gap <= own)
        yield Atom(x, self.terms.at_most(limit, difference), gap >= own)


class TemplatePool:
    """Candidates to choose from, by what they exclude."""

    def __init__(self, candidates: Iterable[Expr]) -> None:
        self._left = {id(c): c for c in candidates}
        self._names = {key: frozenset(variables(c)) for key, c in self._left.items()}

    def __len__(self) -> int:
        return len(self._left)

    def rest(self) -> list[Expr]:
        """All that are left; they are taken out."""
        found, self._left = list(self._left.values()), {}
        return found

    def take(self, cube: TemplateCube) -> list[Expr]:
        """The candidates that exclude the whole cube; they are taken out."""
        inside = [c for key, c in self._left.items() if self._names[key] <= cube.names]
        if not inside:
            return []
        at = {name: np.asarray([value]) for name, value in cube.valuation.items()}
        truth = ArrayProgram(inside)(_as_truth(inside, at))
        found = [c for c, holds in zip(inside, truth, strict=True) if not np.all(holds)]
        for candidate in found:
            del self._left[id(candidate)]
        return found


def _as_truth(exprs: Sequence[Expr], at: Mapping[str, Column]) -> dict[str, Column]:
    """The columns of the variables that occur, in the type of their sort."""
    return {name: column(var, at[name]) for name, var in variables(*exprs).items()}


def _informative(values: Column, beside: Column) -> bool:
    """Whether the greatest value is met beside several values of another column: hardly by accident."""
    return len(np.unique(beside[values == values.max()])) >= _TELLING


def _least_unmet(atoms: Sequence[Atom]) -> list[int] | None:
    """A subset of the conditions, none of them superfluous, that no sampled state meets."""
    count = np.zeros(len(atoms[0].holds), dtype=np.int32)
    for atom in atoms:
        count += ~atom.holds
    if not count.all():
        return None
    kept = []
    for place, atom in enumerate(atoms):
        fewer = count - ~atom.holds
        if fewer.all():
            count = fewer
        else:
            kept.append(place)
    return kept


def _latches(var: Var, part: Slice) -> bool:
    """Whether a truth value, once changed, stays: it remembers whether something has ever happened."""
    following = part.next.get(var.name)
    return (
        isinstance(following, Apply)
        and following.op in (Op.OR, Op.AND)
        and any(isinstance(a, Var) and a.name == var.name for a in following.args)
    )


def _counts(var: Var, part: Slice) -> bool:
    """Whether a tick may move the variable on by a constant."""
    return any(
        isinstance(node, Apply) and node.op is Op.ADD and _is_step(var, node)
        for node in postorder(part.next.get(var.name, var))
    )


def _is_step(var: Var, node: Apply) -> bool:
    first, second = node.args
    return isinstance(first, Var) and first.name == var.name and isinstance(second, Const)


def _neighbours(part: Slice) -> dict[str, set[str]]:
    """The variables that each one is read with, in its own next value or in that of another."""
    near: dict[str, set[str]] = {v.name: set() for v in (*part.variables, *part.frozen)}
    for name, following in part.next.items():
        read = {n for n in variables(following) if n in near} | {name}
        for one in read:
            near[one] |= read
    return near
