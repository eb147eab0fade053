"""Loops found by holding the inputs constant until the run repeats.

Many runs have random inputs for a few ticks.  Then each gets inputs for which the condition of the
loop is true, and keeps them.  Where something that must recur in the loop is still true much later,
the run is followed until it comes back to an earlier state, and the loop is examined.  This finds
loops far too long for an unrolling; that it finds none shows nothing.  The same question has the same
answer: what is random comes from fixed seeds.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from random import Random

from rovercheck.checker.encode.bits import Circuit, circuit
from rovercheck.checker.encode.bits.simulate import BitSimulation, Values
from rovercheck.checker.engines import Progress
from rovercheck.checker.results.verdict import Reached, Run
from rovercheck.checker.system.partition import conjuncts, partitions
from rovercheck.checker.verify.liveness.loops import LoopQuery
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables

RUNS = 256
"""Runs of a batch."""
UNSETTLED = (4, 8, 16, 32)
"""Ticks of random inputs, one batch for each."""
HELD = 400
"""Ticks for which the last inputs are held before the runs are looked at."""
TRIES = 48
"""Times that inputs are drawn for a tick in which something is wanted of them."""
FOLLOWED, LONGEST = 3, 2000
"""Runs of a batch that are followed to the end, and for how many ticks."""


@dataclass(frozen=True)
class _Batch:
    """Runs, the values to choose from for each input, and the inputs that others or a state restrict."""

    simulation: BitSimulation
    choices: Mapping[Var, Sequence[int]]
    bound: frozenset[str]
    random: Random

    def drawn(self, names: frozenset[str] | None = None) -> Values:
        """Random values of the inputs, or of some of them."""
        chosen = {v.name: of for v, of in self.choices.items() if names is None or v.name in names}
        return {name: self.random.choices(of, k=self.simulation.runs) for name, of in chosen.items()}


def repeating_loop(asked: LoopQuery, progress: Progress, runs: int = RUNS) -> Reached | None:
    """A run of the lasso system that closes a loop which breaks the property; None if none was found."""
    system, goal = asked.question.system, asked.goal
    wanted = [goal.var.name, *(v.name for v in goal.recurs)]
    made = circuit(system, wanted)
    if system.frozen:
        return None
    for number, ticks in enumerate(UNSETTLED):
        progress(f"loops: {runs} random runs with constant inputs after {ticks} ticks")
        batch = _batch(system, made, runs, number)
        for run in _candidates(batch, ticks, wanted):
            found = _followed(asked, run)
            if found is not None:
                return Reached(found, shortest=False)
    return None


def _batch(system: TransitionSystem, made: Circuit, runs: int, seed: int) -> _Batch:
    cells = partitions(system)
    own = {v.name for v in system.inputs}
    depends = [variables(c) for c in conjuncts(system.assume)]
    bound = frozenset(n for found in depends if len(found) > 1 for n in found if n in own)
    choices = {v: [c.value for c in cells[v.name].cells] for v in system.inputs}
    return _Batch(BitSimulation(made, runs), choices, bound, Random(seed))


# --- random runs -----------------------------------------------------------------------------------


def _candidates(
    batch: _Batch, unsettled: int, wanted: Sequence[str]
) -> Iterator[tuple[Mapping[str, int], ...]]:
    """Inputs, tick by tick, of runs in which all that is wanted is true once the inputs are constant."""
    simulation, alive = batch.simulation, batch.simulation.full
    history: list[Values] = []
    values = batch.drawn()
    for _ in range(unsettled):
        values = _changed(batch, values)
        values, alive = _admissible(batch, values, alive)
        alive &= simulation.given(values)
        history.append(values)
        simulation.advance()
    values, held = _constant_inputs(batch, values, wanted[0])
    alive &= held
    history.append(values)
    simulation.advance()
    for _ in range(HELD):
        values, alive = _admissible(batch, values, alive)
        alive &= simulation.given(values)
        history.append(values)
        if alive:
            simulation.advance()
    for name in wanted:
        alive &= simulation.value(simulation.circuit.goals[name])
    chosen = [r for r in range(simulation.runs) if alive >> r & 1][:FOLLOWED]
    return (tuple({n: of[r] for n, of in tick.items()} for tick in history) for r in chosen)


def _changed(batch: _Batch, values: Values) -> Values:
    """About a third of the inputs of each run get new values."""
    fresh = batch.drawn()
    return {
        name: [b if batch.random.random() < 1 / 3 else a for a, b in zip(old, fresh[name], strict=True)]
        for name, old in values.items()
    }


def _merged(old: Values, new: Values, where: int) -> Values:
    """The new values in some of the runs."""
    taken = [where >> r & 1 for r in range(len(next(iter(old.values()), ())))]
    changed = {
        name: [b if take else a for take, a, b in zip(taken, old[name], of, strict=True)]
        for name, of in new.items()
    }
    return {**old, **changed}


def _admissible(batch: _Batch, values: Values, alive: int) -> tuple[Values, int]:
    """The values, with those of inputs that are restricted drawn anew where they may not be,
    and the runs of those alive in which they may be now."""
    allowed = alive & batch.simulation.allowed(values)
    for _ in range(TRIES):
        if allowed == alive:
            break
        values = _merged(values, batch.drawn(batch.bound), alive & ~allowed)
        allowed = alive & batch.simulation.allowed(values)
    return values, allowed


def _constant_inputs(batch: _Batch, values: Values, condition: str) -> tuple[Values, int]:
    """Values for which the condition is true after the tick, and the runs for which some were found.

    What does for one run is tried on the others.
    """
    simulation = batch.simulation
    held, pool = 0, list[dict[str, int]]()
    for attempt in range(2 * TRIES):
        allowed = simulation.given(values)
        new = allowed & simulation.value(simulation.circuit.goals[condition]) & ~held
        held |= new
        pool += [{n: of[r] for n, of in values.items()} for r in range(simulation.runs) if new >> r & 1]
        fresh = batch.drawn()
        if pool and attempt >= TRIES:
            drawn = batch.random.choices(pool, k=simulation.runs)
            fresh = {name: [one[name] for one in drawn] for name in fresh}
        values = _merged(values, fresh, simulation.full & ~held)
    simulation.given(values)
    return values, held


# --- one run ---------------------------------------------------------------------------------------


def _followed(asked: LoopQuery, inputs: Sequence[Mapping[str, int]]) -> Run | None:
    """The run of the lasso system that these inputs, the last of them kept, lead round a loop."""
    system, goal = asked.question.system, asked.goal
    at, ticks = dict(system.init), list(inputs)
    seen: dict[tuple[int, ...], int] = {}
    good: list[dict[str, int]] = []
    for number in range(LONGEST):
        tick = ticks[number] if number < len(ticks) else ticks[-1]
        if number >= len(ticks):
            ticks.append(tick)
        if not admissible(system, at, tick):
            return None
        at = {**at, **step(system, at, tick)}
        good.append({v.name: at[v.name] for v in (goal.var, *goal.recurs)})
        key = tuple(at[v.name] for v in asked.lasso.kept)
        if key in seen and _breaks(asked, good[seen[key] + 1 :]):
            return _saved(asked, ticks[: number + 1], seen[key] + 1)
        seen.setdefault(key, number)
    return None


def _breaks(asked: LoopQuery, loop: Sequence[Mapping[str, int]]) -> bool:
    """Whether the condition is true in every tick of the loop, and in some tick each that must recur."""
    lasting = all(at[asked.goal.var.name] for at in loop)
    return lasting and all(any(at[v.name] for at in loop) for v in asked.goal.recurs)


def _saved(asked: LoopQuery, ticks: Sequence[Mapping[str, int]], start: int) -> Run:
    """The run of the lasso system that saves its state before the tick with which the loop starts."""
    save = asked.lasso.save.name
    return Run({}, tuple({**tick, save: int(n == start)} for n, tick in enumerate(ticks)))
