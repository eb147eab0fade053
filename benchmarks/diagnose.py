"""How often the cause of a planted change comes first, and how long a diagnosis takes.

    python -m benchmarks.diagnose [changes of each board] [seed] [seconds for a part] [board]

One change is planted in the charts of a board, some of every kind; the board so changed is run on inputs
that ``compare`` tries and on those of drives.  Of the runs that show it at most three are diagnosed, together
with two that do not.  The cause is right if it is the planted change, or if no run of the part tells the two
apart.
"""

import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from random import Random
from time import process_time

from rovercheck.checker.compare.beside import played
from rovercheck.checker.compare.fixed_runs import fixed
from rovercheck.checker.compare.strategy import ENVIRONMENTS
from rovercheck.checker.conformance.cones import LogCone, parts_of
from rovercheck.checker.conformance.program import Known, ProgramOutput, compiled
from rovercheck.checker.conformance.recording import Cells, LogBlock, Recording
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.decide import RunSearch
from rovercheck.checker.diagnosis.hypotheses import (
    delay_changes,
    mutant_changes,
    rewrite_changes,
    signals_of,
    timer_changes,
    written_changes,
)
from rovercheck.checker.diagnosis.limits import number_slots
from rovercheck.checker.diagnosis.part_diagnosis import changed_part
from rovercheck.checker.diagnosis.result import BoardDiagnosis, DiagnosedPart, diagnose_board
from rovercheck.spec_model.abstraction import Board, Value, boards
from rovercheck.spec_model.lang.chart import Component, parts
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System
from tests.logs.recorded import record

FIXED_RUNS, DRIVES, DRIVE_STEPS = 14, 4, 800
SHOWN, OTHERS = 3, 2
"""Runs that show a change, and others, of a diagnosis."""

Inputs = tuple[Mapping[str, Value], ...]


@dataclass(frozen=True)
class PlantedOutcome:
    """What became of a planted change."""

    change: ChartChange
    place: int | None
    """Where the right cause stands: 0 is first; ``None``: nowhere."""
    told: str
    false: int
    """Causes told of other parts."""
    seconds: float
    rows: int


@cache
def drives(name: str) -> tuple[Inputs, ...]:
    """Inputs of a board: some fixed runs of the comparison, the longest kinds of each; and drives."""
    board, env = boards()[name], ENVIRONMENTS[name]
    every = [s for label, s in fixed(env) if label != "first step"]
    chosen = every[:: max(1, len(every) // FIXED_RUNS)]
    found = [tuple(step.inputs for step in played(board, env.fields, s)) for s in chosen]
    names = [s.name for s in board.inputs]
    for seed in range(1, DRIVES + 1):
        rows = record(board, DRIVE_STEPS, seed, 0.02 * seed)
        found.append(tuple({n: row[n] for n in names} for row in rows))
    return tuple(found)


def outputs(board: Board, system: System, inputs: Inputs) -> list[Known]:
    """The raw outputs of a changed board, step by step; ``None`` where nothing is required."""
    lowered = lower(system)
    step = compiled(lowered, [ProgramOutput(o.var, o.unless) for o in board.outputs])
    state: Known = tuple(v.init for v in lowered.variables)
    reader, found = board.reader(), list[Known]()
    for one in inputs:
        seen = reader.step(one)
        state, given = step(state, tuple(seen[v.name] for v in lowered.inputs))
        found.append(given)
    return found


@cache
def required(name: str, number: int) -> tuple[Known, ...]:
    """The outputs of the board as drawn."""
    board = boards()[name]
    return tuple(outputs(board, board.system, drives(name)[number]))


def recorded(board: Board, name: str, inputs: Inputs, given: Sequence[Known]) -> Recording:
    """Inputs and outputs as a recorded run."""
    values: dict[str, Cells] = {s.name: [s.raw(row[s.name]) for row in inputs] for s in board.inputs}
    columns = {o.name: [row[i] for row in given] for i, o in enumerate(board.outputs)}
    steps = range(1, len(inputs) + 1)
    block = LogBlock(list(steps), list(steps), [0] * len(inputs), {**values, **columns})
    return Recording(name, frozenset(block.values), True, lambda: [block])


def planted(board: Board, count: int, random: Random) -> Iterator[ChartChange]:
    """Changes of every kind in turn, drawn at random."""
    system = board.system
    names = frozenset(p.name for p in parts(system.components))
    kinds: dict[str, list[ChartChange]] = {}
    every = [
        *written_changes(board, system), *mutant_changes(system),
        *rewrite_changes(system, signals_of(board), names),
        *timer_changes(system, (3, 25, 60, 120, 175, 180), names), *delay_changes(system, names),
        *_numbers(system, names, random),
    ]  # fmt: skip
    for one in every:
        kinds.setdefault(one.kind, []).append(one)
    for of_kind in kinds.values():
        random.shuffle(of_kind)
    while any(kinds.values()):
        for of_kind in kinds.values():
            if of_kind:
                yield of_kind.pop()


def _numbers(system: System, names: frozenset[str], random: Random) -> Iterator[ChartChange]:
    for slot in number_slots(system, names):
        factor = Fraction(random.choice((5, 8, 9, 11, 15)), 10)
        raw = Fraction(round(slot.drawn * factor)) if slot.drawn else Fraction(1)
        if raw != slot.drawn:
            yield slot.change(slot.op, raw.numerator)


def tried(board: Board, change: ChartChange, seconds: float, random: Random) -> PlantedOutcome | None:
    """Plant a change and diagnose it; ``None`` if no run shows it."""
    try:
        system = change.make()
        made = [outputs(board, system, inputs) for inputs in drives(board.name)]
    except (ModelError, AssertionError, ValueError):
        return None
    shown = [n for n, rows in enumerate(made) if tuple(rows) != required(board.name, n)]
    others = [n for n in range(len(made)) if n not in shown]
    chosen = [*random.sample(shown, min(SHOWN, len(shown))), *random.sample(others, min(OTHERS, len(others)))]
    runs = [recorded(board, f"run {n}", drives(board.name)[n], made[n]) for n in chosen]
    start = process_time()
    found = diagnose_board(board, runs, seconds)
    taken = process_time() - start
    if not found.parts:
        return None
    return _judged(found, change, system, taken, sum(len(drives(board.name)[n]) for n in chosen))


def _judged(
    found: BoardDiagnosis, change: ChartChange, system: System, taken: float, rows: int
) -> PlantedOutcome:
    own = [p for p in found.parts if change.chart in _names(p)]
    false = sum(p.cause is not None for p in found.parts if p not in own)
    place, told = None, "nothing"
    for part in own:
        causes = [part.cause, *(r.cause for r in part.rivals)] if part.cause is not None else []
        told = " and ".join(c.text for c in part.cause.changes) if part.cause is not None else "no cause"
        real = _changed_cone(part, system)
        for number, cause in enumerate(causes):
            same = cause is not None and len(cause.changes) == 1 and cause.changes[0].key == change.key
            if cause is not None and (same or _equal(part, changed_part(part.evidence[0], cause)[0], real)):
                place = number
                break
    return PlantedOutcome(change, place, told, false, taken, rows)


def _names(part: DiagnosedPart) -> set[str]:
    return {p.component.name for e in part.evidence for p in e.group.parts}


def _changed_cone(part: DiagnosedPart, system: System) -> LogCone | None:
    """The part as planted: its components in the changed board, and what was put beside them."""
    group = part.evidence[0].group
    drawn = {p.name for p in parts(group.board.system.components)}
    mine = _names(part)
    kept = [
        c for c in _flat(system) if (n := c[0]) in mine or (n not in drawn and not n.startswith("(not used"))
    ]
    try:
        return group.cone(System(group.name, tuple(c[1] for c in kept), tick_ms=system.tick_ms))
    except (ModelError, StopIteration):
        return None


def _flat(system: System) -> list[tuple[str, Component]]:
    board = replace(boards()["board1"], system=system)
    return [(p.component.name, p.whole) for p in parts_of(board)]


def _equal(part: DiagnosedPart, one: LogCone, other: LogCone | None) -> bool:
    return other is not None and RunSearch(part.evidence[0], one, other).found() is None


def main(count: int = 40, seed: int = 18, seconds: float = 60.0, only: str = "") -> None:
    total: Counter[str] = Counter()
    for name, board in boards().items():
        if only not in ("", name):
            continue
        random = Random(seed)
        outcomes: list[PlantedOutcome] = []
        for change in planted(board, count, random):
            if len(outcomes) >= count:
                break
            one = tried(board, change, seconds, random)
            if one is None:
                continue
            outcomes.append(one)
            word = "first" if one.place == 0 else f"place {one.place + 1}" if one.place else "missed"
            print(
                f"{name} {word:8} {one.seconds:5.1f} s {change.kind}: {change.chart}: {change.text}",
                flush=True,
            )
            if one.place != 0:
                print(f"{'':22} told: {one.told}", flush=True)
        first = sum(o.place == 0 for o in outcomes)
        some = sum(o.place is not None for o in outcomes)
        per_row = sum(o.seconds for o in outcomes) / max(1, sum(o.rows for o in outcomes)) * 1500
        total.update(first=first, some=some, all=len(outcomes), false=sum(o.false for o in outcomes))
        print(f"{name}: {first} of {len(outcomes)} first, {some} among the first four; ", end="")
        print(f"{per_row:.1f} s for 1,500 rows")
    print(f"both: {total['first']} of {total['all']} first, {total['some']} among the first four, "
          f"{total['false']} false causes")  # fmt: skip


if __name__ == "__main__":
    given = [*sys.argv[1:], *("40", "18", "60", "")[len(sys.argv) - 1 :]]
    main(int(given[0]), int(given[1]), float(given[2]), given[3])
