"""Runs with minimal inputs: the same goal after as many ticks, with inputs that change as seldom as possible.

An engine leaves every input that does not matter at any value.  A reader wants those at rest, so
that what changes in a trace is what the counterexample needs.  Each attempt is re-run on the
reference semantics; the budget counts ticks, not seconds, so that the result is reproducible.
"""

from collections.abc import Iterator, Mapping

from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.slice import sliced
from rovercheck.checker.verify.runs.domains import stayed, stray
from rovercheck.spec_model.lang.evaluate import admissible, evaluate, step
from rovercheck.spec_model.lang.evaluate import run as execute
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables

BUDGET = 40_000
"""Ticks that may be re-run for one trace."""

Column = list[int]
"""The values of one input, tick by tick."""


def minimise_inputs(system: TransitionSystem, goal: Var, run: Run) -> Run:
    """A run of the same length that reaches the goal in its last tick, and leaves no domain.

    Every input is, in this order of preference, at its initial value throughout, constant, or with
    changes none of which can be left out alone.  A run that leaves a domain remains as it is.
    """
    if not system.inputs or stray(system, run) is not None:
        return run
    work = _Rerun(system, goal, run)
    before = None
    while before != work.columns:  # an input may become constant only after another that it depends on
        before = dict(work.columns)
        for variable in system.inputs:
            _constant(work, variable)
        for variable in system.inputs:
            _fewer_changes(work, variable.name)
    return work.run


def transferred(run: Run, system: TransitionSystem, goal: Var) -> Run | None:
    """The run on another system that has the goal, if it reaches it there in the last tick too.

    Inputs that the other system does not have are dropped, those that only it has stay initial.
    """
    frozen = {v.name: run.frozen.get(v.name, v.init) for v in system.frozen}
    at: dict[str, int] = {**system.init, **frozen}
    ticks: list[dict[str, int]] = []
    for given in run.inputs:
        inputs = {v.name: given.get(v.name, v.init) for v in system.inputs}
        if not admissible(system, at, inputs):
            return None
        ticks.append(inputs)
        at = {n: v for n, v in step(system, at, inputs).items() if n not in inputs}
    return Run(frozen, tuple(ticks)) if at[goal.name] else None


def _constant(work: "_Rerun", variable: Var) -> None:
    column = work.columns[variable.name]
    for value in dict.fromkeys((variable.init, column[0], column[-1])):
        if value in variable.domain and work.accepts(variable.name, [value] * len(column)):
            return


def _fewer_changes(work: "_Rerun", name: str) -> None:
    """Leave out changes of one input: all after the first few, then ever smaller groups of neighbours."""
    changes = _changes(work.columns[name])
    any(work.accepts(name, _with_changes(work.columns[name], changes[:n])) for n in range(len(changes)))
    size = len(_changes(work.columns[name]))
    while size:
        start = 0
        while start < len(changes := _changes(work.columns[name])):
            kept = changes[:start] + changes[start + size :]
            if not work.accepts(name, _with_changes(work.columns[name], kept)):
                start += size
        size //= 2


def _changes(column: Column) -> list[int]:
    return [k for k in range(1, len(column)) if column[k] != column[k - 1]]


def _with_changes(column: Column, kept: list[int]) -> Column:
    values, out = set(kept), [column[0]]
    for k in range(1, len(column)):
        out.append(column[k] if k in values else out[-1])
    return out


class _Rerun:
    """The run so far, the states along it, and what is left of the budget."""

    def __init__(self, system: TransitionSystem, goal: Var, run: Run) -> None:
        read = [v for v in system.variables if v.name in variables(system.assume)]
        self.part = sliced(system, [goal, *read, *(check for check, _ in system.checks)])
        self.kept = {v.name: v.init for v in (*self.part.variables, *read, goal)}
        self.system = system
        self.goal = goal
        self.frozen = dict(run.frozen)
        self.columns = {v.name: [tick[v.name] for tick in run.inputs] for v in system.inputs}
        self.budget = BUDGET + len(run)
        self.before = list(self._along(0, {**self.kept, **self.frozen}))

    @property
    def run(self) -> Run:
        return Run(self.frozen, tuple(self._inputs(k) for k in range(len(self.before) - 1)))

    def accepts(self, name: str, column: Column) -> bool:
        """Take the column over if the goal is still reached in the last tick."""
        old = self.columns[name]
        if column == old:
            return True
        first = next(k for k, (a, b) in enumerate(zip(old, column, strict=True)) if a != b)
        last = max(k for k, (a, b) in enumerate(zip(old, column, strict=True)) if a != b)
        self.columns[name] = column
        found = self._from(first, last)
        if found is None:
            self.columns[name] = old
            return False
        self.before[first + 1 : first + 1 + len(found)] = found
        return True

    def _from(self, first: int, last: int) -> list[Mapping[str, int]] | None:
        """The states after ``first`` until they are again those known, or None if all is lost."""
        found: list[Mapping[str, int]] = []
        for k, at in enumerate(self._along(first, self.before[first])):
            if k == 0:
                continue
            found.append(at)
            if first + k > last and at == self.before[first + k]:
                return found
        reaches = len(found) == len(self.before) - 1 - first and bool(found[-1][self.goal.name])
        return found if reaches else None

    def _along(self, start: int, at: Mapping[str, int]) -> Iterator[Mapping[str, int]]:
        """States from the one before tick ``start`` on, as long as inputs are admissible."""
        yield at
        ticks = len(next(iter(self.columns.values()), ()))
        for k in range(start, ticks):
            inputs = self._inputs(k)
            if self.budget <= 0 or not evaluate(self.system.assume, {**at, **inputs}):
                return
            self.budget -= 1
            after = {**at, **inputs}
            execute(self.part.step, after)
            if not stayed(self.system, after):
                return
            at = {**self.frozen, **{name: after[name] for name in self.kept}}
            yield at

    def _inputs(self, k: int) -> dict[str, int]:
        return {name: column[k] for name, column in self.columns.items()}
