"""Proofs kept of the rover, carried over to its charts written as models of Simulink and read again.

    python -m benchmarks.slx_proofs ID ...

For properties that ``slx_verdicts`` does not decide on systems of which ``slx_equal`` does not know whether
they are the same.  The conjuncts of the kept proof are said of the variables of the file, and of the delays
that keep these until the next step; beside them stands what a file has that the rover has not: variables that
tell whether the first step is over, and what is kept from that step on.  With these begins the search for an
inductive invariant.  One that is found is given to the ordinary search as a kept one, and the verdict is
compared with that of the rover.  The exit code is 1 if one differs or is not known.
"""

import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping
from itertools import permutations
from pathlib import Path

from benchmarks.slx_equal import Beside, Renamed
from benchmarks.slx_verdicts import ReadAgain, compared
from rovercheck.checker.encode.cone import cone
from rovercheck.checker.encode.simulate import Simulator
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.engines.kinduction.search import InductionGroup, InductionModel
from rovercheck.checker.model.kept_invariants import invariants_of_rover, row
from rovercheck.checker.results.verdict import Inductive
from rovercheck.checker.search import GoalsExcluded
from rovercheck.checker.system.formula_json import Tree, readable
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.forms import Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var, any_of
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems

LANES, TICKS = 64, 600
"""Random runs, and the ticks of each, in which it shows which variables tell that the first step is over."""
OFTEN = 0.98
"""Of the states of these runs, those in which such a variable is no longer as it began."""
DELAY = "last_"
"""The name of a delay in a file begins so, and goes on as that of what it keeps."""


class CarriedOver(Renamed):
    """The proof kept of a property of the rover, in words of the file that was written of its system."""

    def __init__(self, system: System, again: ReadAgain, prop: Property) -> None:
        beside = Beside(system, again)
        drawn, read = lower(system), lower(again.read)
        asked, self.question = reduce(drawn, [prop]), reduce(read, [again.property(prop)])
        monitors = zip(
            asked.system.variables[len(drawn.variables) :],
            self.question.system.variables[len(read.variables) :],
            strict=True,
        )
        super().__init__({**beside.of, **{one.name: other for one, other in monitors}})
        self._system, self._again, self._asked = system, again, asked
        self._known = {v.name: v for v in self.question.system.variables}

    def invariant(self) -> tuple[Tree, ...] | None:
        """An inductive invariant of what is read, as it is kept, by which the property is true; or None."""
        [goal] = self.question.goals
        model = InductionModel(self.question.system)
        for event in InductionGroup(model, [goal.var.name], None, list(self.candidates())).decide():
            if isinstance(event, GoalsExcluded) and isinstance(event.because, Inductive):
                return row(event.because)
        return None

    def candidates(self) -> Iterator[Expr]:
        """What may be part of it."""
        of_drawn = {v.name: v for v in (*self._asked.system.variables, *self._asked.system.frozen)}
        kept = invariants_of_rover()[self._asked.goals[0].property.id]
        delayed = _Delayed(self._known)
        for one in map(self.expr, readable(kept, of_drawn)):
            yield from (one, delayed.expr(one))
        starts = list(map(_as_it_began, self._flags()))
        for one, other in permutations(starts, 2):
            yield any_of(one, ~other)
        for var in self._system.frozen:  # read as an input, and kept from the first step on
            held = Apply(Op.EQ, (self._again.inside[var.name], self._again.given[var.name]), Bool())
            yield from (any_of(start, held) for start in starts)

    def _flags(self) -> Iterator[Var]:
        """Variables of two values that tell whether the first step is over."""
        part = cone(transition(self.question.system), [self.question.goals[0].var.name])
        runs = Simulator(part, lanes=LANES, seed=1)
        at = runs.run(runs.start(), TICKS).samples()
        for var in part.variables:
            if len(var.domain) == 2 and (at[var.name] != var.init).mean() > OFTEN:
                yield var

    def _expr(self, expr: Expr) -> Expr:
        found = self._again.state(expr)
        return super()._expr(expr) if found is None else found


class _Delayed(Renamed):
    """A condition on what the delays keep."""

    def __init__(self, known: Mapping[str, Var]) -> None:
        super().__init__({})
        self._known = known

    def _expr(self, expr: Expr) -> Expr:
        if isinstance(expr, Var):
            return self._known.get(DELAY + expr.name, expr)
        return super()._expr(expr)


def _as_it_began(var: Var) -> Expr:
    return Apply(Op.EQ, (var, Const(var.init, var.sort)), Bool())


def main(ids: list[str]) -> int:
    """Carry over, decide, and print what differs; the exit code."""
    kept, told = invariants_of_rover(), Counter[str]()
    unknown = [id for id in ids if id not in kept or id not in catalogue()]
    if unknown or not ids:
        wrong = f"No proof is kept of {', '.join(unknown)}" if unknown else "No property is named"
        print(f"{wrong}: name some of properties/invariants.json.", file=sys.stderr)
        return 2
    for prop in map(catalogue().__getitem__, ids):
        system = systems()[prop.on]
        with tempfile.TemporaryDirectory() as folder:
            again = ReadAgain(system, Path(folder))
            found = CarriedOver(system, again, prop).invariant()
            if found is None:
                print(f"{prop.id:24} {system.name:32} no invariant")
                told["not decided"] += 1
            else:
                told += compared(system, again, [prop], SearchSettings(jobs=1, invariants={prop.id: found}))
    print(", ".join(f"{count} {word}" for word, count in told.items()) or "nothing")
    return 1 if told.keys() - {"same"} else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
