"""What the three ways to search timers cost: states stored, and seconds of the processor for all of it.

    python -m benchmarks.timers [repetitions]

Prints medians.  ``x`` is exact divided by the other: states saved, time saved (below 1: lost).
A search is given up after 256 MiB or a minute: unfinished.
With free timers a property that is reached there would be searched exactly after all; it is marked.
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from statistics import median
from time import process_time

from rovercheck.checker.engines import Limits, Timers, explicit, quiet
from rovercheck.checker.results.verdict import Answer, Exhausted, Open, Unreachable
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.expiry import free_timers
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems

CASES = (
    ("relay", "PB1-13b"),
    ("temperature", "PB1-01b"),
    ("battery", "PB1-04c"),
    ("references", "PB1-26b"),
    ("obstacles_n_straight", "PB2-10-least"),
    ("obstacles_n", "PB2-02-n1"),
    ("obstacles", "PB2-02d"),
)
"""A system and a property that is decided on it; the last is both obstacle charts and the selection."""

LIMITS = Limits(seconds=60, memory=1 << 28)


@dataclass(frozen=True)
class Cost:
    """One search: the answer, and seconds of the processor from the system to it."""

    answer: Answer
    seconds: float

    @property
    def stored(self) -> int | None:
        """The states stored by a search that came to its end."""
        because = self.answer.because if isinstance(self.answer, Unreachable) else None
        return because.states if isinstance(because, Exhausted) else None

    @property
    def shown(self) -> str:
        if self.stored is not None:
            return f"{self.stored:>11,}"
        return f"{'unfinished' if isinstance(self.answer, Open) else 'reached':>11}"


def cost(system: System, id: str, timers: Timers) -> Cost:
    """Lower, monitor, slice, compile and search once."""
    began = process_time()
    searched = free_timers(system) if timers is Timers.FREE else system
    question = reduce(lower(searched), [replace(catalogue()[id], on=searched.name)])
    goal = question.goals[0].var
    how = Timers.EXACT if timers is Timers.FREE else timers
    answer = explicit.check(question.system, [goal], replace(LIMITS, timers=how), quiet)[goal.name]
    return Cost(answer, process_time() - began)


def measured(system: System, id: str, repetitions: int) -> Iterator[str]:
    """The columns of one line: exact, skip, free."""
    runs = {t: [cost(system, id, t) for _ in range(repetitions)] for t in Timers}
    seconds = {t: median(c.seconds for c in costs) for t, costs in runs.items()}
    most, time = runs[Timers.EXACT][0], seconds[Timers.EXACT]
    for timers, costs in runs.items():
        yield f"{costs[0].shown} {seconds[timers]:>6.2f}"
        if timers is not Timers.EXACT:
            stored = costs[0].stored
            saved = f"{most.stored / stored:>6.1f}" if most.stored and stored else f"{'':>6}"
            yield f"{saved} {time / seconds[timers]:>5.2f}"


def main() -> None:
    repetitions = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    head = f"{'stored':>11} {'s':>6}"
    print(f"{'':35} {'exact':>18} {'skip':>18} {'':12} {'free':>18}")
    print(f"{'system':20} {'property':14} {head} {head} {'x':>6} {'x s':>5} {head} {'x':>6} {'x s':>5}")
    for name, id in CASES:
        columns = " ".join(measured(systems()[name], id, repetitions))
        print(f"{name:20} {id:14} {columns}", flush=True)


if __name__ == "__main__":
    main()
