"""Boards with changes put in by hand, and recorded runs of them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from random import Random

from rovercheck.checker.conformance.mismatch import LogMismatch
from rovercheck.checker.conformance.numbers import value_of
from rovercheck.checker.conformance.program import Known, ProgramOutput, compiled
from rovercheck.checker.conformance.recording import LogBlock, Raw, Recording
from rovercheck.checker.conformance.tracker import TrackedRow, Tracker, UndecidedRow
from rovercheck.checker.diagnosis.evidence import EvidenceCollector
from rovercheck.checker.diagnosis.result import BoardDiagnosis, diagnose_board
from rovercheck.spec_model.abstraction import Board, Value, boards
from rovercheck.spec_model.lang.chart import Block, Chart, parts
from rovercheck.spec_model.lang.edit import in_system
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.lower.ranges import unguarded
from rovercheck.spec_model.lang.system import System

Row = dict[str, Value]
Held = Sequence[tuple[int, Mapping[str, Value]]]
"""Steps, and the inputs that change at their start."""

SECONDS = 60.0

CALM: Mapping[str, Mapping[str, Value]] = {
    "board1": {"temperature_degC": 25.0, "battery_pct": 80.0, "isMotionConsistent": True},
    "board2": {"d1": 301, "d2": 301, "d3": 301, "crit_mask_b1": 4},
}


class LostTracker(Tracker):
    """Cannot follow a run from its fourth row on."""

    rows = 0

    def step(self, row: TrackedRow) -> LogMismatch | None:
        self.rows += 1
        if self.rows == 4:
            self.undecided = UndecidedRow(row.tick, self.cone.name, "too many states")
        return None


def inputs(board: str, held: Held) -> list[Row]:
    """Concrete inputs from power-up: every stamp is new in every step unless it is given."""
    at: Row = {**boards()[board].at_power_up(), **CALM[board]}
    stamps = [s.name for s in boards()[board].inputs if s.stamp]
    given: set[str] = set()
    found: list[Row] = []
    for steps, changes in held:
        at |= changes
        given = {n for n in stamps if n in changes}
        for _ in range(steps):
            now = 20 * (len(found) + 1)
            at |= {n: now for n in stamps if n not in given}
            found.append(dict(at))
    return found


@cache
def restless(board: str, seed: int, steps: int = 450) -> tuple[Row, ...]:
    """Random inputs, held for a while: values at and beside those of the model."""
    random, signals = Random(seed), boards()[board].inputs
    held: list[tuple[int, Row]] = [(2, {})]
    while sum(n for n, _ in held) < steps:
        changes: Row = {}
        for s in signals:
            if not s.stamp and random.random() < 0.3:
                raw = random.choice(s.domain.values)
                number = raw * getattr(s.domain.sort, "resolution", 1)
                changes[s.name] = int(number) if number == int(number) else float(number)
            if not s.stamp and random.random() < 0.3 and s.name in CALM[board]:
                changes[s.name] = CALM[board][s.name]
        held.append((random.choice((1, 1, 1, 2, 2, 3, 5)), changes))
    return tuple(inputs(board, held))


def recorded(board: str, system: System, rows: Sequence[Mapping[str, Value]], name: str) -> Recording:
    """A run of a changed board, as its lowered charts go through it."""
    return recorded_on(replace(boards()[board], system=system), rows, name)


def recorded_on(own: Board, rows: Sequence[Mapping[str, Value]], name: str) -> Recording:
    """A run of a board with its own charts, which may take stamps otherwise."""
    whole = lower(own.system)
    signals = tuple(v for v in whole.inputs if value_of(v.name) is None)
    lowered = replace(whole, checks=(), step=unguarded(whole.step), inputs=signals)
    reader = own.reader()
    step = compiled(lowered, [ProgramOutput(o.var, o.unless) for o in own.outputs])
    values: dict[str, list[Raw | None]] = {s.name: [s.raw(row[s.name]) for row in rows] for s in own.inputs}
    values |= {o.name: [] for o in own.outputs}
    state: Known = tuple(v.init for v in lowered.variables)
    for row in rows:
        seen = reader.step(row)
        state, given = step(state, tuple(seen[v.name] for v in lowered.inputs))
        for o, value in zip(own.outputs, given, strict=True):
            values[o.name].append(value)
    steps = range(1, len(rows) + 1)
    block = LogBlock([n + 1 for n in steps], list(steps), [0] * len(rows), values)
    return Recording(name, frozenset(values), True, lambda: [block])


def changed(board: str, part: str, edit: Callable[[Chart | Block], Chart | Block]) -> System:
    """The charts of a board with one part edited."""
    return in_system(boards()[board].system, part, edit)


def part_of(board: str, name: str) -> Chart | Block:
    return next(p for p in parts(boards()[board].system.components) if p.name == name)


def diagnosis(board: str, system: System, *runs: Sequence[Mapping[str, Value]]) -> BoardDiagnosis:
    """What is found of a changed board in its runs."""
    made = [recorded(board, system, rows, f"run {number}") for number, rows in enumerate(runs, 1)]
    return diagnose_board(boards()[board], made, SECONDS)


def deviating(board: Board, runs: Sequence[Recording]) -> list[str]:
    """The parts of a board that deviate in some run."""
    collector = EvidenceCollector(board)
    for run in runs:
        collector.add(run)
    return [part.name for part in collector.evidence().parts]
