"""Other runs that end alike for another reason: what the runs before needed does not explain their end.

While a run goes on, it is watched whether its last ticks are as an earlier run needs them, which may have
begun in any tick.  The engines are run for a run that first comes to the goal when, for no earlier run,
they are.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from rovercheck.checker.engines import Limits, Progress, quiet
from rovercheck.checker.explain.other_runs import NoOtherRun, answered
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Open, Reached, Unreachable
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.runs.minimise import minimise_inputs
from rovercheck.checker.verify.runs.replay import replay
from rovercheck.properties.forms import Property
from rovercheck.properties.reduce import Question, reduce
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import Num, boolean
from rovercheck.spec_model.lang.expr import TRUE, Const, Expr, Var, all_of, any_of
from rovercheck.spec_model.lang.system import System


class OtherCauses:
    """Runs to the end of a property, or to what it wants reached, that end so for another reason."""

    def __init__(self, prop: Property, system: System) -> None:
        self._plain = reduce(lowered(system), [replace(prop, on=system.name)])

    def next(
        self, runs: Sequence[Trace], engine: str, limits: Limits, progress: Progress = quiet
    ) -> Trace | NoOtherRun:
        """A run whose last ticks are not as any of these runs needs its own, or why there is none.

        Of each of these it must be known what it needs.
        """
        question = self._another(runs)
        goal = question.goals[0].var
        match answered(question.system, goal, engine, limits, progress):
            case Reached(run):
                return replay(
                    self._plain.system, self._plain.goals[0], minimise_inputs(question.system, goal, run)
                )
            case Unreachable(because):
                return NoOtherRun(True, because.how)
            case Open() as left:
                return NoOtherRun.open(left)

    def _another(self, runs: Sequence[Trace]) -> Question:
        """The question for a run to the goal that no earlier run explains."""
        [goal] = self._plain.goals
        system = self._plain.system
        other = Var("another reason", boolean, 0, "the end is reached, not for a known reason", hidden=True)
        watches = [list(_watching(run, i, system.inputs)) for i, run in enumerate(runs)]
        same = (w[0].var & _fixed(run, system.frozen) for w, run in zip(watches, runs, strict=True))
        before, now = (Var(f"{at} at the end", boolean, 0, hidden=True) for at in ("before", "so far"))
        steps = [step for watch in watches for step in watch]
        steps += [Assign(before, now), Assign(now, now | goal.var)]
        system = replace(
            system,
            variables=(*system.variables, *(step.var for step in steps), other),
            step=(*system.step, *steps, Assign(other, goal.var & ~before & ~any_of(*same))),
        )
        return Question(system, (replace(goal, var=other),))


def _watching(run: Trace, number: int, inputs: Sequence[Var]) -> Iterator[Assign]:
    """For each number of ticks, most first: whether the last so many are as the first of the run must be."""
    known = {v.name: v for v in inputs}
    needed: dict[int, list[Expr]] = {}
    for one in run.needed():
        needed.setdefault(one.number, []).append(_one_of(known[one.name], one.values))
    likes = [Var(f"as run {number}: {k}", boolean, 0, hidden=True) for k in range(1, len(run) + 1)]
    for tick in range(len(run), 0, -1):
        before = likes[tick - 2] if tick > 1 else TRUE
        yield Assign(likes[tick - 1], all_of(before, *needed.get(tick, ())))


def _fixed(run: Trace, frozen: Sequence[Var]) -> Expr:
    """That what is fixed for a whole run is as in this one."""
    return all_of(*(_one_of(v, {run.before[v.name]}) for v in frozen))


def _one_of(var: Var, values: Collection[int]) -> Expr:
    """That a variable has one of these raw values."""
    if not isinstance(var.sort, Num):
        return any_of(*(var == Const(v, var.sort) for v in sorted(values)))
    spans: list[list[int]] = []
    for v in sorted(values):
        if spans and v == spans[-1][1] + 1:
            spans[-1][1] = v
        else:
            spans.append([v, v])
    return any_of(*((var >= Const(a, var.sort)) & (var <= Const(b, var.sort)) for a, b in spans))
