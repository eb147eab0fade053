"""What is tried on mutants before anything is searched, and in which order."""

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, TypeVar

from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.checker.encode.simulate import Trail

COUNT, TICKS = 10, 300
"""Random runs of a system, and how long they are: longer than most timers."""
NEARBY, SOON = 6, 30
"""Random runs that leave a recorded run together, and for how long they go on."""
BACK = (1, 4)
"""Ticks before the end of a recorded run at which random ones leave it."""
LONGEST = 1_000
"""Ticks of a recorded run that is still tried on every mutant."""
ON = 60
"""Ticks for which a recorded run goes on with its last inputs: what it leads to may come a little later."""
ROUNDS = (16, 4, 1)
"""Every 16th mutant is judged first, then every 4th of the others, then what is left."""

One = TypeVar("One")


class RandomRuns:
    """Runs of a system whose inputs are drawn at random and held for a while, always the same ones."""

    def __init__(self, system: System) -> None:
        from rovercheck.checker.encode.cone import (  # with numpy and Z3, slow to load
            as_written,
            cone,
            straying,
        )
        from rovercheck.checker.encode.symbolic import transition
        from rovercheck.checker.encode.unrolling import Outside

        self._whole = lowered(system)
        stepped, names = transition(self._whole), [v.name for v in self._whole.variables]
        escapes = straying(stepped, as_written(self._whole, names))
        self._part = cone(stepped, [*names, *escapes])
        self._never = tuple(escapes.values())
        self._outside = Outside(self._whole, self._part)

    def from_the_start(self) -> tuple[Run, ...]:
        """``COUNT`` runs; none of a system that has none."""
        from rovercheck.checker.encode.simulate import Simulator

        if not self._outside.possible:
            return ()
        simulator = Simulator(self._part, self._never, lanes=COUNT)
        return self._taken(simulator.run(simulator.start(), TICKS), TICKS, COUNT)

    def around(self, run: Run) -> Iterator[Run]:
        """Runs that leave the given one a few ticks before its end: more of what it leads to.

        Each goes on for ``SOON`` ticks, with inputs that change often.
        """
        from rovercheck.checker.encode.simulate import Simulator

        if not self._outside.possible:
            return
        simulator = Simulator(self._part, self._never, lanes=NEARBY, hold=(1, 2, 5))
        for back in BACK:
            kept = run.inputs[: max(0, len(run) - back)]
            trail = simulator.run(simulator.everywhere(self._after(run, kept)), SOON)
            for other in self._taken(trail, SOON, NEARBY):
                yield Run(run.frozen, kept + other.inputs)

    def _after(self, run: Run, inputs: Sequence[Mapping[str, int]]) -> Mapping[str, int]:
        of = self._whole.inputs
        at: Mapping[str, int] = {**{v.name: v.init for v in of + self._whole.frozen}, **self._whole.init}
        at = {**at, **run.frozen}
        for tick in inputs:
            at = step(self._whole, at, {v.name: tick.get(v.name, v.init) for v in of})
        return at

    def _taken(self, trail: "Trail", ticks: int, lanes: int) -> tuple[Run, ...]:
        frozen = [v.name for v in self._part.frozen]
        return tuple(self._outside.complete(trail.extract(ticks, lane, frozen)) for lane in range(lanes))


def tried(known: Sequence[Run]) -> Iterator[Run]:
    """Recorded runs that are not too long, the shortest first, each going on for a while."""
    for run in sorted(known, key=len):
        if 0 < len(run) <= LONGEST:
            yield Run(run.frozen, run.inputs + run.inputs[-1:] * ON)


def spread(found: Sequence[One]) -> Iterator[One]:
    """Some from everywhere first."""
    numbers: Mapping[int, None] = dict.fromkeys(n for every in ROUNDS for n in range(0, len(found), every))
    return (found[number] for number in numbers)


__all__ = ["ON", "ROUNDS", "RandomRuns", "spread", "tried"]
