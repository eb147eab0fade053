"""Whether a written model does in every run what the drawn one does: proved, if that is found soon."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from random import Random

from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.drawn.lower.uses import constants_of
from rovercheck.checker.engines import Limits
from rovercheck.checker.model.two_readings import interesting
from rovercheck.checker.results.verdict import Exhausted, Inductive, Proved, StoredInvariant, Violated
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.forms import always
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import Domain, Enum, Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr, Var, all_of
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.specialise import Specialiser
from rovercheck.spec_model.lang.system import System, TransitionSystem, in_order

SECONDS = 20.0
RUNS, STEPS = 20, 50
AS_DRAWN = "as drawn: "
"""What the names of variables of the drawn model begin with beside the written one."""


@dataclass(frozen=True)
class Equality:
    """``proved``: both do the same in all runs.  ``difference`` is a run in which they do not.

    Neither: ``how`` says why there is no answer.
    """

    proved: bool = False
    how: str = ""
    difference: str = ""


Pair = tuple[Expr, Expr]
"""The same thing in the written and in the drawn model."""


def equality_of(
    written: System, drawn: System, outputs: Mapping[str, Pair], seconds: float = SECONDS
) -> Equality:
    """Decide whether two systems of the same inputs give all data, active states and ``outputs`` alike.

    What is hidden, as counters of steps, is no part of what is compared.
    """
    try:
        both, same, pairs, left = _beside(written, lower(drawn), outputs)
        if difference := _in_runs(both, pairs):
            return Equality(difference=difference)
        if left:
            return Equality(
                how=f"no proof speaks of {', '.join(left)}, which the written model has otherwise"
            )
        claim = always("EQUAL", "Both models do the same.", that=same, covers=["EQUAL"], on=both.name)
        search = SearchSettings(limits=Limits(seconds=seconds), jobs=1)
        [found] = results([claim], {both.name: both}, search, quiet=True)
    except ModelError as error:
        return Equality(how=str(error).splitlines()[0])
    match found.verdict:
        case Proved(Exhausted() | Inductive() | StoredInvariant() as evidence):
            return Equality(proved=True, how=evidence.how)
        case Violated():
            return Equality(difference="in a run that a search has found")
    return Equality(how="that it does in every run was not decided in the time for it")


def _in_runs(both: System, pairs: Mapping[str, Pair]) -> str:
    """A difference in runs of random values, and of those on both sides of each limit, held for a while."""
    random = Random(1)
    near = constants_of(both)
    values = {
        name: list(interesting(var, near.get(name, ((), False))[0])) for name, var in both.inputs.items()
    }
    for _ in range(RUNS):
        run, left, given = Interpreter(both), dict.fromkeys(values, 0), dict[str, int]()
        for tick in range(1, STEPS + 1):
            for name, some in values.items():
                left[name] -= 1
                if left[name] < 0:
                    given[name] = _raw(both.inputs[name], random.choice(some))
                    left[name] = random.choice((0, 0, 1, 3, 20))
            try:
                run.step(given)
            except ModelError:  # a datum has left its domain, which a check tells
                break
            at = run.valuation()
            wrong = [name for name, (one, other) in pairs.items() if not evaluate(one == other, at)]
            if wrong:
                return f"in tick {tick} of a random run, in {', '.join(wrong)}"
    return ""


def _raw(var: Var, value: float) -> int:
    resolution = var.sort.resolution if isinstance(var.sort, Num) else Fraction(1)
    return round(Fraction(str(value)) / resolution)


def _beside(
    written: System, drawn: TransitionSystem, outputs: Mapping[str, Pair]
) -> tuple[System, Expr, Mapping[str, Pair], Sequence[str]]:
    """One system that does both, the condition that both have done the same, what it compares by name, and
    what it leaves out.
    """
    renamed = {one.name: _apart(one) for one in (*drawn.variables, *drawn.temps)}
    temporaries = [renamed[one.name] for one in drawn.temps]
    rename = Specialiser(renamed)
    own = {one.name: one for one in written.written.values()}
    own |= {place.name: place for chart in written.charts for place in chart.locations}
    wanted: dict[str, tuple[Expr | None, Expr]] = {
        one.name: (own.get(one.name), renamed[one.name]) for one in drawn.variables
    }
    wanted |= {name: (one, rename.expr(other)) for name, (one, other) in outputs.items()}
    pairs = {
        name: (one, other)
        for name, (one, other) in wanted.items() if one is not None and _comparable(one, other)
    }  # fmt: skip
    hidden = {one.name for one in drawn.variables if one.hidden}
    block = Block("As drawn", rename.actions(drawn.step), temporaries=temporaries)
    both = in_order("both", *written.components, block, tick_ms=written.tick_ms, step_ms=written.step_ms)
    same = all_of(*(one == other for one, other in pairs.values()))
    return both, same, pairs, sorted(wanted.keys() - pairs.keys() - hidden)


def _comparable(one: Expr, other: Expr) -> bool:
    return one.sort == other.sort or (isinstance(one.sort, Num) and isinstance(other.sort, Num))


def _apart(one: Var) -> Var:
    """A variable of the drawn model, which says nothing of the charts of the written one."""
    name = f"{AS_DRAWN}{one.name}"
    if isinstance(one.sort, Enum) and one.sort.name == "Entered":
        return Var(name, Domain(replace(one.sort, name=name), one.domain.values), one.init)
    return replace(one, name=name)


__all__ = ["Equality", "equality_of"]
