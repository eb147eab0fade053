"""Which choices a counterexample depends on: with others, the same inputs do not break the property."""

from collections.abc import Mapping, Sequence

from rovercheck.checker.results.verdict import Run
from rovercheck.checker.verify.runs.compiled_step import CompiledStep, TooDeep
from rovercheck.properties.forms import Property, Unbounded
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.system import TransitionSystem


def needed(
    system: TransitionSystem,
    prop: Property,
    run: Run,
    taken: Mapping[str, int],
    others: Mapping[str, Sequence[int]],
) -> frozenset[str] | None:
    """The frozen variables of which some other value lets the same inputs no longer break the property.

    ``taken`` are their values in the run, ``others`` what else each may be; they are tried one at a time.
    Inputs that only another value reads are at rest.  None where it cannot be told: of a property about runs
    of any length, and if the run does not break it with the values taken.
    """
    if isinstance(prop.form, Unbounded):
        return None
    question = reduce(system, [prop])
    goals = [goal.var for goal in question.goals]
    try:
        compiled = CompiledStep(question.system, goals)
    except TooDeep:
        return None

    def broken(values: Mapping[str, int]) -> bool:
        return bool(compiled.first({**run.frozen, **values}, run.inputs))

    if not broken(taken):
        return None
    return frozenset(
        name for name, values in others.items() if not all(broken({**taken, name: value}) for value in values)
    )


__all__ = ["needed"]
