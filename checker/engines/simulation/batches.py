"""Batches of runs, all of them at once: their inputs are held constant, or for random times.

The same question has the same answer: what is random comes from fixed seeds, and the effort is counted.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from time import monotonic

import numpy as np

from rovercheck.checker.encode.cone import Slice, as_written, by_cone, cone, folded, straying
from rovercheck.checker.encode.simulate import HOLD, Simulator
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.results.verdict import Answer, Open, Reached, Run
from rovercheck.checker.system.intervals import postorder
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import TransitionSystem

RUNS = 256
"""Runs of a batch."""
LONGEST = 8192
"""Ticks of a run at most; where a tick takes few operations, timers of two minutes run out."""
EFFORT = 700_000
"""Operations on all runs at once, times the share of a batch: about half a second each."""
DRAWN, BESIDE = 4, 200
"""Times that inputs are tried in a tick, for not all are admissible, and what else a tick costs."""
PATIENCE = 2 * max(HOLD)
"""Ticks without a new state in any run after which no more is expected of a batch."""
BATCHES = (((2 * LONGEST,), "constant", 3), (HOLD, "in blocks", 1))
"""For how many ticks inputs keep their values, in words, and the share of effort."""
_REPORT = 512


@dataclass(frozen=True)
class Batch:
    """Runs of the cone of some goals: how long inputs are held, and from which seed they are drawn."""

    part: Slice
    escapes: Sequence[Expr]
    hold: Sequence[int]
    words: str
    share: int
    seed: int

    def steps(self) -> Iterator[tuple[Mapping[str, np.ndarray], Mapping[str, np.ndarray], np.ndarray]]:
        """The same states, inputs and runs that go on, tick by tick, whenever it is asked."""
        simulator = Simulator(self.part, self.escapes, lanes=RUNS, seed=self.seed, hold=self.hold)
        return simulator.steps(simulator.start(), resting=True)

    @property
    def ticks(self) -> int:
        """How many of them are worth their effort."""
        step, assumed = (sum(1 for _ in postorder(*of)) for of in (self.part.next.values(), self.part.assume))
        return max(1, min(LONGEST, self.share * EFFORT // (step + DRAWN * assumed + BESIDE)))


def answers(
    system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """An answer for each goal."""
    deadline = limits.deadline()
    whole = folded(transition(system))
    found: dict[str, Answer] = {}
    for names in by_cone(whole, [g.name for g in goals]):
        escapes = straying(whole, as_written(system, names))
        part = cone(whole, [*names, *escapes])
        for seed, (hold, words, share) in enumerate(BATCHES):
            left = [name for name in names if name not in found]
            batch = Batch(part, tuple(escapes.values()), hold, words, share, seed)
            hits = _hits(batch, left, limits.depth, deadline, progress)
            found |= {g: Reached(run, len(run) == 1) for g, run in _runs(system, batch, hits).items()}
    late = deadline is not None and monotonic() > deadline
    none = f"none of {RUNS} runs with inputs held constant, nor of {RUNS} in blocks, reaches it"
    reason = f"the time limit of {limits.seconds:g} s is reached" if late else none
    return {g.name: found.get(g.name) or Open(reason, 0) for g in goals}


def _hits(
    batch: Batch, goals: Sequence[str], depth: int | None, deadline: float | None, progress: Progress
) -> dict[str, tuple[int, int]]:
    """For each goal that some run reaches the tick, and the number of a run that is there after fewest."""
    hits: dict[str, tuple[int, int]] = {}
    taken = np.zeros(RUNS, dtype=np.int64)
    seen, newest = set[int](), 0
    for tick, (at, _, moved) in enumerate(islice(batch.steps() if goals else (), batch.ticks)):
        taken += moved
        for goal in [g for g in goals if g not in hits]:
            lanes = np.flatnonzero(at[goal] & moved)
            if len(lanes):
                hits[goal] = tick, int(lanes[taken[lanes].argmin()])
        before = len(seen)
        seen.update(_digests(at))
        newest = tick if len(seen) > before else newest
        over = len(hits) == len(goals) or (depth is not None and tick + 1 >= depth)
        if over or tick - newest > PATIENCE or (deadline is not None and monotonic() > deadline):
            break
        if tick % _REPORT == 0:
            progress(
                f"simulation: inputs held {batch.words}, tick {tick:,}, {len(goals) - len(hits)} goals open"
            )
    return hits


def _digests(at: Mapping[str, np.ndarray]) -> list[int]:
    """A number for the state of each run; that two have the same by chance does no harm."""
    found = np.zeros(RUNS, dtype=np.uint64)
    with np.errstate(over="ignore"):
        for values in at.values():
            low = values & 0xFFFF_FFFF_FFFF_FFFF if values.dtype == object else values
            found = found * np.uint64(0x9E3779B97F4A7C15) + low.astype(np.uint64)
    return [int(digest) for digest in found]


def _runs(system: TransitionSystem, batch: Batch, hits: Mapping[str, tuple[int, int]]) -> dict[str, Run]:
    """The runs to the goals, which are simulated once more to take down their inputs."""
    if not hits:
        return {}
    from rovercheck.checker.encode.unrolling import Outside  # Z3, which is needed for this alone

    outside = Outside(system, batch.part)
    last = max(tick for tick, _ in hits.values())
    lanes = sorted({lane for _, lane in hits.values()})
    frozen: dict[int, dict[str, int]] = {}
    inputs: dict[int, list[dict[str, int]]] = {lane: [] for lane in lanes}
    ends: dict[tuple[int, int], int] = {}
    for tick, (at, given, moved) in enumerate(islice(batch.steps(), last + 1)):
        for lane in lanes:
            if not tick:
                frozen[lane] = {v.name: int(at[v.name][lane]) for v in batch.part.frozen}
            if moved[lane]:
                inputs[lane].append({v.name: int(given[v.name][lane]) for v in batch.part.inputs})
            ends[tick, lane] = len(inputs[lane])
    return {
        goal: outside.complete(Run(frozen[lane], tuple(inputs[lane][: ends[tick, lane]])))
        for goal, (tick, lane) in hits.items()
        if outside.possible
    }
