"""Every tool on RoverLite in one interleaved run, and whether the targets are met.

    python -m benchmarks.compare [REPETITIONS] [--only PART] [--limit SECONDS] [--large] [--write]

Prints Markdown.  ``--only searches`` or ``--only properties`` leaves the rest out, ``--large`` also
searches 61 million states, which takes about a minute, and ``--write`` puts the tables into
``benchmarks/RESULTS.md``.  Outside tools that are missing leave dashes.
"""

import argparse
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from benchmarks import rivals, tools
from benchmarks.evidence import STANDS
from benchmarks.markdown import NOTHING, number, table
from benchmarks.measure import Cost, Sample, Tool, interleaved, seconds
from benchmarks.results import write
from benchmarks.targets import Target, targets
from benchmarks.tools import MODELS, PROPERTIES
from rovercheck.checker.engines import engines

Runs = Mapping[str, Sequence[Sample]]
SEARCH_LIMIT = 600.0
"""Seconds of wall time for one search of all states."""
LARGE = (31, 5)
SEARCHES_ONLY, PROPERTIES_ONLY = "searches", "properties"


@dataclass
class Measured:
    """All runs: of the searches by model and tool, of the properties by name and tool."""

    searches: dict[str, Runs] = field(default_factory=dict)
    properties: dict[str, Runs] = field(default_factory=dict)
    together: list[Sample] = field(default_factory=list)
    start_up: list[Cost] = field(default_factory=list)
    large: Sample | None = None


def searchers(comp: int, k: int, folder: Path) -> dict[str, Tool]:
    """The tools that search all states of a model."""
    return present({
        "ours": tools.search(comp, k),
        "C naive": rivals.c_search(comp, k, False, folder),
        "C factored": rivals.c_search(comp, k, True, folder),
        "SPIN": rivals.spin_search(comp, k, folder, SEARCH_LIMIT),
    })  # fmt: skip


def provers(goal: str, limit: float, folder: Path) -> dict[str, Tool]:
    """The tools that decide a property of the full model at full timing."""
    broken = goal in ("P4", "P5")
    return present({
        **{name: tools.engine(name, goal, limit) for name in engines()},
        "auto": tools.auto(goal, limit),
        "ABC pdr": rivals.abc("pdr", goal, limit),
        "ABC, our AIGER": rivals.abc_exported(goal, folder, limit),
        "ABC bmc3": rivals.abc("bmc3 -F 1000", goal, limit) if broken else None,
        "Z3": rivals.z3(goal, limit, "unroll" if broken else "induct"),
    })  # fmt: skip


def present(known: Mapping[str, Tool | None]) -> dict[str, Tool]:
    return {name: tool for name, tool in known.items() if tool is not None}


def measured(repetitions: int, limit: float, only: str) -> Measured:
    """Run everything, or only one part, saying on standard error what is being run."""
    found = Measured()
    with tempfile.TemporaryDirectory() as folder:
        if only != PROPERTIES_ONLY:
            searched(found, repetitions, Path(folder))
        if only != SEARCHES_ONLY:
            decided(found, repetitions, limit, Path(folder))
    return found


def searched(found: Measured, repetitions: int, folder: Path) -> None:
    for name, (comp, k) in MODELS.items():
        say(f"{name}: searching all states")
        found.searches[name] = interleaved(searchers(comp, k, folder), repetitions)


def decided(found: Measured, repetitions: int, limit: float, folder: Path) -> None:
    for goal in PROPERTIES:
        say(f"{goal}: each engine, ABC and Z3")
        found.properties[goal] = interleaved(provers(goal, limit, folder), repetitions)
    say("all properties together, and the start-up of the command line")
    tools.start_up()
    for _ in range(repetitions):
        found.together.append(tools.together(limit))
        found.start_up.append(tools.start_up())


def say(text: str) -> None:
    print(f"  {text} ...", file=sys.stderr, flush=True)


# --- tables ------------------------------------------------------------------------------------------


def search_table(found: Mapping[str, Runs]) -> str:
    """Times of the search alone; ``x`` is how many times as fast as that tool ours is."""
    head = ["model", "states", "ours s", "M/s", "start s", "B each"]
    others = ("C naive", "C factored", "SPIN")
    head += [column for other in others for column in (f"{other} s", "x")]
    return table(head, [_search_row(name, runs, others) for name, runs in found.items()])


def _search_row(name: str, runs: Runs, others: Sequence[str]) -> list[str]:
    ours, own = runs["ours"][0], seconds(runs["ours"])
    states = ours.states or 0
    row = [name, f"{states:,}", number(own), number(states / own / 1e6 if own else None)]
    row += [number(ours.start), number(ours.memory / states if ours.memory and states else None)]
    for other in others:
        theirs = seconds(runs.get(other, ()))
        row += [number(theirs), number(theirs / own if theirs and own else None)]
    return row


def property_table(found: Mapping[str, Runs]) -> str:
    """Seconds of each tool on each property, with the length of the run where there is one."""
    names = list(dict.fromkeys(name for runs in found.values() for name in runs))
    rows = [[goal, *(answer(runs.get(name, ())) for name in names)] for goal, runs in found.items()]
    return table(["", *names], rows)


def answer(samples: Sequence[Sample]) -> str:
    """``0.31`` for a proof, ``0.31 (200)`` for a run of 200 ticks, ``open`` and after how long.

    A tick marks what was replayed or certified in every run.
    """
    if not samples:
        return NOTHING
    taken = seconds(samples)
    if taken is None:
        return f"open {max(s.seconds for s in samples):.0f}"
    lengths = "/".join(str(n) for n in sorted({s.length for s in samples if s.length is not None}))
    stands = all(s.evidence in STANDS for s in samples)
    return number(taken) + (f" ({lengths})" if lengths else "") + " ✓" * stands


def target_table(found: Sequence[Target]) -> str:
    words = {True: "met", False: "NOT MET", None: "not measured"}
    return table(["target", "measured", ""], [[t.text, t.figure, words[t.met]] for t in found])


def report(found: Measured, limit: float) -> str:
    """The whole comparison in Markdown."""
    parts = []
    if found.searches:
        parts.append(SEARCHES.format(table=search_table(found.searches)))
    if found.properties:
        parts.append(DECISIONS.format(limit=limit, table=property_table(found.properties)))
    return "\n".join([*parts, f"### Targets\n\n{target_table(targets(found))}"])


SEARCHES = """### Every state searched

Processor seconds of the search alone, medians; `x` is the time of that tool divided by ours: above 1, ours
is faster. All store every state, ours and C with parents, and check P1 to P3. `start s` is from the
model to the first state, `B each` what the search takes of memory, divided by the states.

{table}"""

DECISIONS = """### The full model, K = 1: 1.5e16 states

Processor seconds from the model to the answer, medians; in brackets the length of the run; `open`: not
decided, with the seconds of the processor that it took within {limit:.0f} s of wall time. A tick: the run was
replayed, or the proof certified by another solver or by enumeration, outside the time. Z3 is 1-induction for
P1 to P3h and unrolling within the cone of influence for P4 and P5.

{table}"""


def main() -> None:
    parser = argparse.ArgumentParser(prog="benchmarks.compare", description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("repetitions", nargs="?", type=int, default=3)
    parser.add_argument("--only", choices=[SEARCHES_ONLY, PROPERTIES_ONLY], default="")
    parser.add_argument("--limit", type=float, default=30.0, help="seconds for each engine and property")
    parser.add_argument("--large", action="store_true", help="search 61 million states as well")
    parser.add_argument("--write", action="store_true", help="put the tables into benchmarks/RESULTS.md")
    chosen = parser.parse_args()
    found = measured(chosen.repetitions, chosen.limit, chosen.only)
    if chosen.large:
        say("61 million states")
        found.large = tools.search(*LARGE)()
    text = report(found, chosen.limit)
    print(text)
    if chosen.write:
        write("compare", "Comparison", text, chosen.repetitions)


if __name__ == "__main__":
    main()
