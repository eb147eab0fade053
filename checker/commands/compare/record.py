"""Keeps the runs that the model checker found as inputs for the cross-check; run as a module after a change.

``python -m rovercheck.checker.commands.compare.record [FILE]`` decides every violated property that is
quick to decide, and writes its run on each board that it concerns; into another file than that of the
project if one is named.
"""

import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import rovercheck.checker.compare
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.compare.recorded_runs import COUNTEREXAMPLES, KeptSuite, encoded, kept
from rovercheck.checker.io.files import replaced
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Unknown
from rovercheck.properties.catalogue import catalogue, expected
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.abstraction.board import in_steps_of
from rovercheck.spec_model.lang.system import TICK_MS, System
from rovercheck.spec_model.rover import systems

Found = tuple[str, str, Trace]
"""A property, the system of its run, and the run."""


def concerns(board: Board, system: System) -> bool:
    """Whether a system runs a chart of the board, a step of 20 ms in each tick."""
    own = {chart.name for chart in board.system.charts}
    constant = system.tick_ms == TICK_MS and system.elapsed is None
    return constant and any(chart.name in own for chart in system.charts)


def runs(found: Iterable[Found], known: Mapping[str, System]) -> dict[str, list[KeptSuite]]:
    """The runs of each board, those with the same inputs once."""
    kept_runs: dict[str, list[KeptSuite]] = {name: [] for name in boards()}
    for id, system, trace in found:
        for name, board in boards().items():
            if system in known and concerns(board, known[system]):
                ticks = (in_steps_of(board, known[system], {**t.inputs, **t.after}) for t in trace.ticks)
                one = kept(f"{id} of {system}", board, ticks)
                if all(one.script != other.script for other in kept_runs[name]):
                    kept_runs[name].append(one)
    return kept_runs


def counterexamples() -> Iterator[Found]:
    """The run of every property that is violated and quick to decide."""
    wanted = [p for p in catalogue().values() if not p.costly and expected(p.id).verdict == "violated"]
    for result in results(wanted, systems()):
        verdict = result.verdict
        if not isinstance(verdict, Unknown) and isinstance(verdict.because, Trace):
            yield result.property.id, result.system, verdict.because


KEPT = Path(rovercheck.checker.compare.__file__).parent / COUNTEREXAMPLES


def main(place: Path = KEPT) -> None:
    """Write the file anew."""
    found = sorted(counterexamples(), key=lambda one: one[0])
    replaced(place, encoded(runs(found, systems())).encode())


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:2]))
