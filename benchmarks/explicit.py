"""The explicit engine beside the hand-written C search of the same model, interleaved in one run.

    python -m benchmarks.explicit [repetitions]

Prints medians of CPU seconds, which other work on the machine disturbs less than the clock.  ``search``
is the search alone and what the ratios compare; ``all`` adds slicing, cells and compiling (nothing is
taken from the cache).  ``B/st`` is what the resident memory of the process grew by, for each stored
state.  Both store parents.  Naive C tries every input vector, factored C multiplies the distinct
successors of each part.  Without gcc the C columns stay empty.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from statistics import median
from time import process_time

from benchmarks.roverlite import roverlite
from rovercheck.checker import cache
from rovercheck.checker.encode.native import NativeSearch, NativeTask, layout
from rovercheck.checker.engines import Limits, quiet
from rovercheck.checker.engines.explicit.levels import ExplicitFound, LevelSearch
from rovercheck.checker.system.slice import sliced
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.rover import systems

SOURCE = Path(__file__).parent / "peers" / "c"
MODELS = ((3, 1), (28, 1), (32, 1), (31, 10), (85, 1))
GOALS = {85: "P5"}
"""By default the goal is ``broken``, never true: the whole state space is searched."""
UNLIMITED = Limits()
CHART, PROPERTY, SECONDS = "obstacles_n", "PB2-05-12", 8.0


@dataclass(frozen=True)
class Timed:
    """One run: stored states, transitions, seconds of the search, seconds of everything, bytes by
    which the resident memory grew."""

    states: int
    transitions: int
    seconds: float
    whole: float
    memory: int = 0


def ours(
    system: TransitionSystem,
    goals: Sequence[Var],
    limits: Limits = UNLIMITED,
    clock: Callable[[], float] = process_time,
) -> Timed:
    """Slice, compile and search once."""
    began = clock()
    part = sliced(system, goals)
    packing = layout((*part.frozen, *part.variables))
    native = NativeSearch.compile(NativeTask(part, packing, tuple(goals)))
    native.improve()
    resident, started = _resident(), clock()
    found: ExplicitFound = LevelSearch(native, limits, limits.deadline(), quiet).run()
    ended = clock()
    grown = _resident() - resident  # the arrays are still held
    return Timed(found.states, found.transitions, ended - started, ended - began, grown)


def _resident() -> int:
    """Bytes of this process in memory; 0 where the system does not say."""
    status = Path("/proc/self/statm")
    return int(status.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") if status.exists() else 0


def compiled(comp: int, k: int, factored: bool, folder: str) -> str | None:
    """The C search of one model, compiled; None without gcc."""
    gcc = shutil.which("gcc")
    if gcc is None:
        return None
    program = f"{folder}/bfs-{comp}-{k}-{factored}"
    options = ["-O3", "-march=native", "-w", "-DPARENT", f"-DCOMP={comp}", f"-DK={k}"]
    options += ["-DFACT"] * factored + ["-DSTOPON=16"] * (comp == 85)
    subprocess.run([gcc, *options, "-o", program, str(SOURCE / "bfs.c")], check=True)
    return program


def c(program: str) -> Timed:
    """Run a compiled C search once."""
    before = _children()
    out = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    seconds = _children() - before
    counts = dict(re.findall(r"\b(states|trans)=(\d+)", out))
    return Timed(int(counts["states"]), int(counts["trans"]), seconds, seconds)


def _children() -> float:
    """CPU seconds of the processes that have ended."""
    import resource  # not on every platform, and only here

    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def model(comp: int, k: int, repetitions: int, folder: str) -> Iterator[str]:
    """A line of the table for one model."""
    system, goals = roverlite(comp, k)
    goals = tuple(g for g in goals if g.name == GOALS.get(comp, "broken"))
    runs: list[tuple[str, Callable[[], Timed]]] = [("ours", lambda: ours(system, goals))]
    for name, factored in (("naive", False), ("factored", True)):
        program = compiled(comp, k, factored, folder)
        if program is not None:
            runs.append((name, partial(c, program)))
    taken: dict[str, list[Timed]] = {name: [] for name, _ in runs}
    for _ in range(repetitions):
        for name, run in runs:
            taken[name].append(run())
    yield line(f"{comp} k{k}", taken)


def line(name: str, taken: dict[str, list[Timed]]) -> str:
    """States, times and ratios; a ratio above 1 means that ours is slower."""
    own = taken["ours"]
    seconds, memory = median(t.seconds for t in own), median(t.memory for t in own)
    text = f"{name:>12} {own[0].states:>12,} {own[0].transitions:>14,} {median(t.whole for t in own):>8.3f}"
    text += f" {seconds:>8.3f}"
    text += "".join(f" {n / seconds / 1e6:>7.{d}f}" for n, d in ((own[0].states, 2), (own[0].transitions, 1)))
    text += f" {memory / own[0].states:>6.1f}"
    for other in ("naive", "factored"):
        if other in taken:
            theirs = median(t.seconds for t in taken[other])
            text += f" {theirs:>8.3f} {seconds / theirs:>5.2f}"
    return text


def chart(repetitions: int) -> str:
    """The obstacle chart with all its counters and the monitor of a property, for some seconds."""
    question = reduce(lower(systems()[CHART]), [replace(catalogue()[PROPERTY], on=CHART)])
    goals = tuple(g.var for g in question.goals)
    runs = [ours(question.system, goals, Limits(seconds=SECONDS)) for _ in range(repetitions)]
    return line(CHART, {"ours": runs})


def main() -> None:
    os.environ[cache.VARIABLE] = ""
    repetitions = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    columns = [("model", 12), ("states", 12), ("transitions", 14), ("all s", 8), ("search s", 8)]
    columns += [("Mst/s", 7), ("Mtr/s", 7), ("B/st", 6), ("C s", 8), ("x", 5), ("C fact s", 8), ("x", 5)]
    print(" ".join(f"{name:>{width}}" for name, width in columns))
    with tempfile.TemporaryDirectory() as folder:
        for comp, k in MODELS:
            for text in model(comp, k, repetitions, folder):
                print(text, flush=True)
    print(chart(min(repetitions, 3)))


if __name__ == "__main__":
    main()
