"""How states and times grow with the scale of the timers and the number of parts.

    python -m benchmarks.growth [REPETITIONS] [--limit SECONDS] [--large] [--write]

Prints Markdown.  ``--write`` puts it into ``benchmarks/RESULTS.md``; ``--large`` adds the search of 61
million states, which takes about a minute and 2 GB.
"""

import argparse
import sys
from collections.abc import Mapping, Sequence

from benchmarks import tools
from benchmarks.compare import answer
from benchmarks.markdown import number, table
from benchmarks.measure import Sample, Tool, interleaved, seconds
from benchmarks.plot import plot
from benchmarks.results import FILE, write
from benchmarks.roverlite import FULL
from rovercheck.checker.engines import engines, explicit

SCALES = (20, 10, 5, 4, 2, 1)
"""Divisors of the timers: 1 is full timing."""
LINKS, NO_SONARS = 28, 31
"""The parts searched state by state: links and relay; and temperature and battery as well."""
PARTS = (1, 3, 7, 15, 31, 63)
PARTS_SCALE = 10
SEARCH = "search"
ENOUGH = 100_000
"""States from which on bytes for each say something."""

Runs = Mapping[str, Sequence[Sample]]


def symbolic() -> list[str]:
    """The engines that do not store one state after the other, and can prove."""
    able = {n: engine for n, engine in engines().items() if not getattr(engine, "SAMPLES", False)}
    return [name for name in able if name != explicit.NAME]


def by_scale(goal: str, k: int, limit: float) -> dict[str, Tool]:
    """The search of links and relay, and each other engine on a property of the full model."""
    proving: dict[str, Tool] = {n: tools.engine(n, goal, limit, FULL, k) for n in symbolic()}
    return {SEARCH: tools.search(LINKS, k, limit)} | proving


def by_parts(parts: int, limit: float) -> dict[str, Tool]:
    """The search of some parts, and each other engine on P2, which depends on all of them but the relay."""
    own = {n: tools.engine(n, "P2", limit, parts, PARTS_SCALE) for n in symbolic()}
    return {SEARCH: tools.search(parts, PARTS_SCALE, limit)} | own


def size(samples: Sequence[Sample]) -> list[str]:
    """The states of a search, its time and its bytes for each; how far it came where it was cut."""
    last = samples[-1]
    states = last.states or 0
    each = number(last.memory / states if last.memory and states >= ENOUGH else None)
    return [f"{'' if last.decided else '> '}{states:,}", number(seconds(samples)), each]


def rows(taken: Mapping[str, Runs]) -> list[list[str]]:
    return [
        [name, *size(runs[SEARCH]), *(answer(runs[n]) for n in symbolic())] for name, runs in taken.items()
    ]


def measured(label: str, cases: Mapping[str, dict[str, Tool]], repetitions: int) -> dict[str, Runs]:
    """The runs of each case, saying on standard error what is being run."""
    taken: dict[str, Runs] = {}
    for name, chosen in cases.items():
        print(f"  {label} {name} ...", file=sys.stderr, flush=True)
        taken[name] = interleaved(chosen, repetitions)
    return taken


def shown(label: str, taken: Mapping[str, Runs]) -> str:
    """A table with a row for each case."""
    return table([label, "states", "search s", "B each", *(f"{n} s" for n in symbolic())], rows(taken))


def pictured(title: str, label: str, taken: Mapping[str, Runs]) -> str:
    """The same as a plot."""
    names = [SEARCH, *symbolic()]
    return plot(title, label, list(taken), {n: [seconds(runs[n]) for runs in taken.values()] for n in names})


def searched(cases: Sequence[tuple[int, int]], repetitions: int) -> str:
    """Searches of growing models, without a limit."""
    lines = []
    for comp, k in cases:
        print(f"  parts {comp}, K {k} ...", file=sys.stderr, flush=True)
        runs = interleaved({SEARCH: tools.search(comp, k)}, repetitions)[SEARCH]
        own = seconds(runs)
        lines.append(
            [f"{comp}, K {k}", *size(runs), number((runs[0].states or 0) / own / 1e6 if own else None)]
        )
    return table(["parts", "states", "search s", "B each", "M/s"], lines)


def report(repetitions: int, limit: float, large: bool) -> tuple[str, dict[str, str]]:
    """The tables in Markdown, and plots by file name."""
    true, false = (
        measured(goal, {str(k): by_scale(goal, k, limit) for k in SCALES}, repetitions)
        for goal in ("P3h", "P5")
    )
    parts = measured("parts", {str(p): by_parts(p, limit) for p in PARTS}, repetitions)
    plots = {
        "growth-timers.svg": pictured(
            "P5 on the full model, and the search of its links", "timers divided by", false
        ),
        "growth-parts.svg": pictured(f"P2, timers divided by {PARTS_SCALE}", "parts", parts),
    }
    sizes = searched([(NO_SONARS, k) for k in (25, 20, 10, *[5] * large)], repetitions)
    text = f"""Processor seconds, medians. `search` stores every state of some parts; the other columns
are engines on one property, in brackets the length of the run that breaks it; `open`: not decided within
{limit:.0f} s.

### Scale of the timers: P3h, which holds, on the full model; the search is of links and relay

{shown("K", true)}
### Scale of the timers: P5, which does not hold, on the full model; the same search

![growth with the timers](growth-timers.svg)

{shown("K", false)}
### Number of parts, timers divided by {PARTS_SCALE}: P2, which holds and depends on all parts but the relay

![growth with the parts](growth-parts.svg)

{shown("parts", parts)}
### Size alone: everything but the sonars

{sizes}"""
    return text, plots


def main() -> None:
    parser = argparse.ArgumentParser(prog="benchmarks.growth", description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("repetitions", nargs="?", type=int, default=1)
    parser.add_argument("--limit", type=float, default=20.0, help="seconds for each engine and for a search")
    parser.add_argument("--large", action="store_true", help="search 61 million states as well")
    parser.add_argument("--write", action="store_true", help="put the tables into benchmarks/RESULTS.md")
    chosen = parser.parse_args()
    text, plots = report(chosen.repetitions, chosen.limit, chosen.large)
    print(text)
    if chosen.write:
        write("growth", "Growth", text, chosen.repetitions)
        for name, plotted in plots.items():
            (FILE.parent / name).write_text(plotted, encoding="utf-8")


if __name__ == "__main__":
    main()
