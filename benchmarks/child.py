"""Our side of a comparison: one search in a process of its own, its cost as JSON on standard output.

python -m benchmarks.child search COMP K [SECONDS]                 the explicit search and its memory
python -m benchmarks.child engine NAME GOAL COMP K SECONDS         one engine on one property
python -m benchmarks.child auto GOAL[,GOAL...] COMP K SECONDS      what ``rovercheck check`` would do
python -m benchmarks.child certified GOAL[,GOAL...] COMP K SECONDS   and the proofs checked again
"""

import json
import os
import sys
from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from resource import RUSAGE_CHILDREN, RUSAGE_SELF, getrusage
from time import perf_counter, process_time

from benchmarks.evidence import evidence
from benchmarks.measure import Sample
from benchmarks.roverlite import roverlite
from rovercheck.checker.engines import AUTO, Limits, engines
from rovercheck.checker.results.verdict import Answer, Open, Reached, Unreachable
from rovercheck.checker.verify.portfolio import Callbacks, PortfolioQuestion, answers

SEARCHED = ("P1", "P2", "P3", "P5", "broken")
"""Goals of an exhaustive search: C and SPIN check as much; ``broken`` is never reached."""
MEMORY = 3 << 30
"""Bytes that an engine may take for a property: the full model does not fit into any memory."""
DEEP = 500
"""Ticks asked of one engine where a run is known to exist; without a depth, unrolling stops sooner."""


def resident() -> int:
    """Bytes of this process in memory now."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def cpu() -> float:
    """Seconds of the processor of this process and of the children it waited for."""
    waited = getrusage(RUSAGE_CHILDREN)
    return process_time() + waited.ru_utime + waited.ru_stime


def search(comp: int, k: int, limit: float | None) -> Sample:
    """The whole search of a model, after one tick of it has brought the compiled code into memory."""
    from benchmarks.explicit import ours

    system, goals = roverlite(comp, k)
    wanted = [g for g in goals if g.name in SEARCHED]
    limits = Limits(seconds=limit)
    first = ours(system, wanted, replace(limits, depth=1), process_time)
    before, began = resident(), perf_counter()
    timed = ours(system, wanted, limits, process_time)
    wall = perf_counter() - began
    most = getrusage(RUSAGE_SELF).ru_maxrss * 1024 - before
    done = limit is None or wall < limit
    return Sample(
        timed.seconds, wall, "searched" if done else "open", states=timed.states,
        start=first.whole - first.seconds, memory=most,
    )  # fmt: skip


def asked(name: str, goals: str, comp: int, k: int, limit: float, again: bool) -> dict[str, Sample]:
    """An engine, or several in turn, on some properties; what they say is checked outside the time."""
    system, known = roverlite(comp, k)
    wanted = {g.name: g for g in known if g.name in goals.split(",")}
    tool = engines().get(name, AUTO)
    told, began, wall = Callbacks(), cpu(), perf_counter()
    depth = DEEP if name in engines() and goals in ("P4", "P5") else None
    limits = Limits(depth=depth, seconds=limit, memory=MEMORY)
    found = answers(PortfolioQuestion(system, tuple(wanted.values())), tool, limits, told)
    cost = Sample(cpu() - began, perf_counter() - wall, "open")
    words = evidence(system, wanted, found, limit) if again else {}
    return {n: answered(cost, answer, words.get(n, "")) for n, (answer, _) in found.items()}


def answered(sample: Sample, answer: Answer, evidence: str) -> Sample:
    match answer:
        case Unreachable(because):
            return replace(sample, verdict="proved", note=because.how, evidence=evidence)
        case Reached(run, shortest):
            note = "shortest" if shortest else ""
            return replace(sample, verdict="reached", length=len(run), note=note, evidence=evidence)
        case Open(reason, _):
            return replace(sample, note=reason)


def main(kind: str, *rest: str) -> Mapping[str, object]:
    match kind, rest:
        case "search", (comp, k, *limit):
            return asdict(search(int(comp), int(k), float(limit[0]) if limit else None))
        case "engine", (name, goals, comp, k, limit):
            found = asked(name, goals, int(comp), int(k), float(limit), again=True)
        case (("auto" | "certified"), (goals, comp, k, limit)):
            found = asked(AUTO, goals, int(comp), int(k), float(limit), again=kind == "certified")
        case _:
            raise SystemExit(__doc__)
    return {goal: asdict(sample) for goal, sample in found.items()}


if __name__ == "__main__":
    print(json.dumps(main(*sys.argv[1:])))
