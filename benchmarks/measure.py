"""Measuring: a command in a child process with its cost, and several tools run in turn."""

import os
import signal
import subprocess
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from threading import Timer
from time import perf_counter
from types import MappingProxyType

ROOT = Path(__file__).parents[1]


@dataclass(frozen=True)
class Cost:
    """What a command printed and took.

    ``seconds`` are of the processor, user and system, of the command and all it waited for: a busy
    machine disturbs them less than ``wall``.  ``memory`` is the largest resident set, in bytes.
    """

    text: str
    seconds: float
    wall: float
    memory: int
    status: int
    timed_out: bool


@dataclass(frozen=True)
class Sample:
    """One run of one tool.

    ``seconds`` and ``wall`` are of the work that is compared; ``verdict`` is ``proved``, ``reached``
    after ``length`` ticks, ``searched`` to the end, or, undecided, ``open``.
    """

    seconds: float
    wall: float
    verdict: str
    length: int | None = None
    states: int | None = None
    start: float | None = None
    """Seconds from the model to the first state: slicing and compiling."""
    memory: int | None = None
    """Bytes resident at most, on top of what the tool takes before it starts to search."""
    note: str = ""
    evidence: str = ""
    """``replayed``, ``certified``, or why a verdict of ours is neither; nothing where that was not asked."""

    @property
    def decided(self) -> bool:
        return self.verdict != "open"


Tool = Callable[[], Sample]
UNCHANGED: Mapping[str, str] = MappingProxyType({})

LONG = 60.0
"""Seconds of wall time above which a run is not repeated."""


def run(
    command: Sequence[str | Path],
    seconds: float | None = None,
    folder: Path | None = None,
    changed: Mapping[str, str] = UNCHANGED,
) -> Cost:
    """Run a command to its end, or kill it and its children after ``seconds`` of wall time.

    ``changed``: variables of the environment that are other than here.
    """
    with tempfile.TemporaryFile() as out:
        began = perf_counter()
        process = subprocess.Popen(
            list(command),
            cwd=folder,
            env={**os.environ, **changed},
            stdout=out,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        late: list[bool] = []

        def kill() -> None:
            late.append(True)
            os.killpg(process.pid, signal.SIGKILL)

        timer = Timer(seconds or 0, kill)
        if seconds is not None:
            timer.start()
        _, status, used = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        wall = perf_counter() - began
        out.seek(0)
        text = out.read().decode(errors="replace")
    cpu = used.ru_utime + used.ru_stime
    return Cost(text, cpu, wall, used.ru_maxrss * 1024, process.returncode, bool(late))


def interleaved(tools: Mapping[str, Tool], repetitions: int) -> dict[str, list[Sample]]:
    """Each repetition runs every tool once; the order rotates.

    What decided nothing, or took long, is not run again.
    """
    taken: dict[str, list[Sample]] = {name: [] for name in tools}
    names = list(tools)
    for turn in range(repetitions):
        first = turn % max(1, len(names))
        for name in names[first:] + names[:first]:
            if all(s.decided and s.wall < LONG for s in taken[name]):
                taken[name].append(tools[name]())
    return taken


def seconds(samples: Sequence[Sample]) -> float | None:
    """The median time of the runs, None where there are none or one of them decided nothing."""
    if not samples or not all(s.decided for s in samples):
        return None
    return median(s.seconds for s in samples)
