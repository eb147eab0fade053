"""How many faults the cross-check finds: mutants of the supervisors, and faults put by hand into the charts.

    python -m benchmarks.mutants [--sample N] [--examples N] [--state FOLDER] [--write]
    python -m benchmarks.mutants --faults [--examples N] [--write]
    python -m benchmarks.mutants --link [--sample N] [--write]

The first makes every first-order mutant of Cosmic Ray (``pip install cosmic-ray``) of what the boards are
made of, and replays the runs of the cross-check's CI profile against each.  It takes about an hour on one
core; what it has found is kept in FOLDER, so that it goes on where it was stopped.  The second cross-checks
the forty faults of ``benchmarks/faults``.  The third runs tests/supervisor against the mutants of the link,
which no chart describes, and of what else the charts do not.  ``--write`` puts the tables into
``DETECTION.md``.
"""

import argparse
import sys
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from random import Random

from benchmarks.faults.by_hand import faults
from benchmarks.faults.campaign import State, campaign, of_the_boards
from benchmarks.faults.hand_run import hunt
from benchmarks.faults.mutate import Mutant
from benchmarks.faults.own_tests import examine, of_the_link, outside
from benchmarks.faults.report import of_faults, of_mutants, of_own_tests, sort, write
from benchmarks.measure import ROOT
from rovercheck.checker.compare.search import CI_EXAMPLES

SEED = 5
EVERY = 25
"""A line of progress for so many mutants."""


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.mutants", description=__doc__)
    parser.add_argument("--faults", action="store_true", help="the faults put in by hand")
    parser.add_argument("--link", action="store_true", help="mutants that tests/supervisor has to find")
    parser.add_argument("--sample", type=int, help="so many mutants, drawn at random, instead of all")
    parser.add_argument("--examples", type=int, help="random runs, instead of those of the CI profile")
    parser.add_argument("--state", type=Path, default=ROOT / ".mutants", help="where answers are kept")
    parser.add_argument("--write", action="store_true", help="write the tables into DETECTION.md")
    chosen = parser.parse_args()
    if chosen.faults:
        key, title, text = "faults", "Forty faults put in by hand", _faults(chosen.examples)
    elif chosen.link:
        key, title, text = "link", "Mutants for the supervisors' own tests", _link(chosen.sample)
    else:
        key, title = "mutants", "Mutants of the supervisors"
        text = _mutants(chosen.sample, chosen.examples, chosen.state)
    print(text)
    if chosen.write:
        write(key, title, text)


def _faults(examples: int | None) -> str:
    results = []
    for fault in faults():
        results.append((fault, hunt(fault, examples)))
        print(f"{fault}: {results[-1][1]}", file=sys.stderr, flush=True)
    return of_faults(results)


def _drawn(every: Iterator[Mutant], sample: int | None) -> tuple[list[Mutant], int]:
    """So many of them, or all, and how many there are."""
    try:
        found = list(every)
    except ModuleNotFoundError as error:
        sys.exit(f"{error}: the mutants are made by Cosmic Ray; `pip install cosmic-ray` and try again.")
    return Random(SEED).sample(found, min(sample or len(found), len(found))), len(found)


def _link(sample: int | None) -> str:
    chosen, of_all = _drawn(chain(of_the_link(), outside()), sample)
    results = []
    for mutant, found in examine(chosen):
        results.append((mutant, found))
        print(f"{mutant.name}: {'found' if found else 'MISSED'}", file=sys.stderr, flush=True)
    return of_own_tests(results, of_all)


def _mutants(sample: int | None, examples: int | None, folder: Path) -> str:
    chosen, of_all = _drawn(of_the_boards(), sample)
    answers = campaign(State(folder, examples), chosen, _progress)
    return f"{against(examples)}\n\n{of_mutants(sort(chosen, answers), of_all)}"


def against(examples: int | None) -> str:
    """A sentence on the runs that the mutants met."""
    drawn = f"the first {examples}" if examples is not None else "all"
    return (
        f"Against the counterexamples, the covering tests, the fixed runs and {drawn} of {CI_EXAMPLES} "
        "random runs of each board."
    )


def _progress(done: int, of_all: int) -> None:
    if done % EVERY == 0:
        print(f"{done} of {of_all}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
