"""The search for invariants: cheap templates first, then whatever excludes a counterexample to induction.

Of the rich templates only those candidates are tried that exclude the states a counterexample
stands for, or the states that lead there when the first ones are not inductive alone.
"""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from rovercheck.checker.encode.invariants import Candidates, TemplateCube, TemplatePool
from rovercheck.checker.encode.simulate import Trail
from rovercheck.checker.engines.kinduction.houdini import Consecution, initially, spoken, unbroken
from rovercheck.checker.engines.kinduction.ticks import Scope
from rovercheck.spec_model.lang.expr import Expr

EVERY = 8
"""Of the ticks of the random runs, one in so many is a sample that suggests candidates."""
AT_ONCE = 2000
"""Up to so many candidates of the templates are tried before anything else."""
ROUNDS = 60
"""Counterexamples that are answered."""
_CLAUSES = 8
"""Clauses of our own making that answer one counterexample."""
_BRANCHES = 6
"""Counterexamples to the candidates of one answer that are answered in turn."""


class InvariantSearch:
    """An inductive invariant that grows, and the counterexamples still to be answered.

    ``invariant`` is what is known so far; ``answered`` counts those to which clauses were tried.  What is
    ``given`` may be part of it: that is tried first.
    """

    def __init__(self, scope: Scope, trail: Trail, given: Sequence[Expr] = ()) -> None:
        self._scope, self._trail = scope, trail
        self._given = spoken(scope, given)
        self._candidates = Candidates(scope.part, trail.samples(EVERY))
        self.invariant = Consecution(scope)
        self._random = np.random.default_rng(0)
        self.answered = 0
        self._tried: list[Expr] = []
        self._queue: list[TemplateCube] = []
        self._asked: list[TemplateCube] = []

    def note(self, cube: TemplateCube) -> None:
        """A goal is reached from this cube: exclude it."""
        self._asked.append(cube)

    def phases(self) -> Iterator[str]:
        """What has been done, each time the invariant has grown."""
        made = self._candidates
        if self._given and self._grow(self._given):
            yield self._said("given")
        self._grow(made.ranges())
        yield self._said("ranges")
        if self._grow(made.latched()):
            yield self._said("latches")
        pool = TemplatePool([*made.exclusions(), *made.ranges_under(), *made.relations()])
        if len(pool) <= AT_ONCE:
            self._grow(pool.rest())
            yield self._said("templates")
        while self.answered < ROUNDS:
            if self._asked:  # new counterexamples, since the invariant has grown
                self._queue, self._asked, self._tried = self._asked, [], []
            if not self._queue:
                return
            self.answered += 1
            if self._answer(self._queue.pop(0), pool):
                yield self._said(f"counterexample {self.answered}")

    def _answer(self, cube: TemplateCube, pool: TemplatePool) -> bool:
        """Try what excludes the cube, with what was tried since the last success; whether any of it holds.

        What struck it out is to be answered next.
        """
        fresh = pool.take(cube)
        made = (self._candidates.excluding(cube, self._random) for _ in range(_CLAUSES))
        fresh += {id(c): c for c in made if c is not None}.values()
        gained = self._grow(fresh)
        self._queue += self.invariant.cubes(_BRANCHES)
        return gained

    def _grow(self, fresh: Iterable[Expr]) -> bool:
        old = {id(c) for c in (*self._tried, *self.invariant.known)}
        new = [c for c in fresh if id(c) not in old]
        for block in self._trail.blocks():
            new = unbroken(new, block)
        candidates = self._tried + initially(self._scope, new)
        taken = {id(c) for c in self.invariant.grow(candidates)}
        self._tried = [c for c in candidates if id(c) not in taken]
        return bool(taken)

    def _said(self, what: str) -> str:
        return f"{what}, {len(self.invariant.known)} invariants"
