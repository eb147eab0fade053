"""Breadth-first exploration by compiled code that keeps every tick, not only what is new.

It ends when nothing new appears, or at a limit: then the ticks of some states are missing, and what
is made of it must say so.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from itertools import islice
from time import monotonic

import numpy as np

from rovercheck.checker.encode.native import (
    REACH_TARGET,
    ExpansionEnd,
    NativeSuccessors,
    NativeTask,
    OutsideDomain,
    TooWide,
    layout,
)
from rovercheck.checker.encode.native import Words as Packed
from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.engines.explicit.levels import ExplicitFound, initial_valuations
from rovercheck.checker.engines.explicit.runs import Runs
from rovercheck.checker.explore.graphs.reachable_ticks import ReachableTicks
from rovercheck.checker.explore.graphs.row_numbers import Numbers, numbered
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.slice import sliced
from rovercheck.checker.verify.runs.domains import leaves, stray
from rovercheck.spec_model.lang.action import Assign, each_action
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.lower.ranges import checked
from rovercheck.spec_model.lang.system import TransitionSystem

AT_ONCE = 1 << 12
"""States expanded in one call."""
ROOM, MOST_ROOM = 1 << 18, 1 << 23
"""Rows for their ticks at first, and at most."""
PER_PAIR = 80
"""Bytes for a pair of states, sorting included."""
_REPORT = 0.5


def explore(
    system: TransitionSystem, onto: Sequence[str], limits: Limits, progress: Progress
) -> "Exploration":
    """Everything reachable in the part of the system that the variables named ``onto`` depend on.

    Raises ``ModelError`` for an unknown variable, an input, and a tick that leaves a domain.
    """
    part = _part(system, onto)
    try:
        packing = layout((*part.frozen, *part.variables))
        progress(f"compiling {len(packing.fields)} variables in {packing.bits} bits")
        native = NativeSuccessors.compile(NativeTask(part, packing, ()))
    except (TooWide, ValueError) as problem:
        raise ModelError(f"{system.name} cannot be explored: {problem} Project on other variables.") from None
    return Exploration(system, native, limits, progress)


def _part(system: TransitionSystem, onto: Sequence[str]) -> TransitionSystem:
    """What the variables depend on, and they themselves though no tick may read them.

    Of what is assigned in it, it is checked that it stays in its domain.
    """
    known = {v.name: v for v in (*system.variables, *system.frozen)}
    for name in onto:
        if name in {v.name for v in system.inputs}:
            raise ModelError(f"{name} is an input of {system.name}; project on what the system remembers.")
        if name not in known:
            raise ModelError(f"There is no variable {name!r} to project on. {did_you_mean(name, known)}")
    onto = [*onto, *(check.name for check in checks_of(sliced(system, [known[name] for name in onto])))]
    part = sliced(system, [known[name] for name in onto])
    kept = {v.name for v in (*part.variables, *part.frozen)} | set(onto)
    return replace(
        part,
        variables=tuple(v for v in system.variables if v.name in kept),
        frozen=tuple(v for v in system.frozen if v.name in kept),
        temps=tuple(v for v in part.temps if v.name not in kept),
    )


def checks_of(part: TransitionSystem) -> tuple[Var, ...]:
    """The checks of a sliced system that are about what it assigns."""
    written = {a.var.name for a in each_action(part.step) if isinstance(a, Assign)}
    return tuple(check for check, _ in part.checks if checked(check) in written)


class Exploration:
    """One exploration: ``explored`` is what it found, ``run`` and ``inputs`` how to get there."""

    def __init__(
        self, system: TransitionSystem, native: NativeSuccessors, limits: Limits, progress: Progress
    ) -> None:
        self.system, self.native, self.limits, self.progress = system, native, limits, progress
        self.deadline = limits.deadline()
        self.task = native.task
        self.fields = self.task.layout.fields
        self.numbers: dict[int | bytes, int] = {}
        self.found: list[Packed] = []
        self.parents: list[Numbers] = []
        self.pairs: list[tuple[Numbers, Numbers]] = []
        self.joined = self.expanded = self.initial = 0
        self.levels: list[int] = [0]
        self.stopped, self.reported = "", monotonic()
        self._search()

    # --- searching -------------------------------------------------------------------------------

    def _search(self) -> None:
        self._start()
        newest = 0
        while not self.stopped and self.expanded < len(self.numbers):
            if self.limits.depth is not None and len(self.levels) > self.limits.depth:
                self.stopped = f"the limit of {self.limits.depth:,} ticks is reached"
                return
            end, before = len(self.numbers), len(self.found)
            self._level(np.concatenate(self.found[newest:]), end)
            if len(self.numbers) > end:
                self.levels.append(end)
                self._stays(before, end)
            newest = before

    def _start(self) -> None:
        valuations = initial_valuations(self.task)
        while batch := [self.task.layout.pack(v) for v in islice(valuations, ROOM)]:
            self._new(np.array(batch, dtype=np.uint64), np.full(len(batch), -1, dtype=np.int64))
            self.initial = len(self.numbers)
            if not self._within():
                return

    def _level(self, words: Packed, end: int) -> None:
        """Expand the states in front of number ``end``, which are in ``words``."""
        room, done = ROOM, 0
        while self.expanded < end and self._within():
            ended, count, rows, origins = self.native(words[done : done + AT_ONCE], room)
            self._store(rows, origins + self.expanded)
            done += count
            self.expanded += count
            if ended is ExpansionEnd.OUTSIDE:
                raise self._outside(words[done])
            if ended is ExpansionEnd.TOO_MANY or (
                ended is ExpansionEnd.NO_ROOM and not count and room >= MOST_ROOM
            ):
                self.stopped = f"one state has more than {MOST_ROOM:,} ticks"
                return
            room = min(4 * room, MOST_ROOM) if ended is ExpansionEnd.NO_ROOM and not count else room

    def _store(self, rows: Packed, origins: Numbers) -> None:
        """Keep each pair once; rows come by origin."""
        columns = [origins, *rows.T]
        first, _ = numbered(columns, len(rows))
        rows, origins = rows[first], origins[first]
        self.pairs.append((origins, self._new(rows, origins)))
        self.joined += len(origins)

    def _new(self, rows: Packed, origins: Numbers) -> Numbers:
        """The number of each state; those not seen before are entered with their parents."""
        first, kind = numbered(list(rows.T), len(rows))
        distinct = rows[first]
        keys: list[int | bytes]
        keys = distinct[:, 0].tolist() if rows.shape[1] == 1 else [row.tobytes() for row in distinct]
        before, numbers = len(self.numbers), self.numbers
        numbered_ = np.array([numbers.setdefault(k, len(numbers)) for k in keys], dtype=np.int64)
        new = numbered_ >= before
        if new.any():
            self.found.append(distinct[new])
            self.parents.append(origins[first][new])
        return numbered_[kind]

    def _stays(self, found: int, first: int) -> None:
        """Raises ``LeavesDomain`` if a tick to one of the states found last leaves a domain."""
        checks = [f for f in self.fields if f.var.name in {check.name for check, _ in self.system.checks}]
        rows = np.concatenate(self.found[found:]) if checks else np.zeros((0, 0), dtype=np.uint64)
        raised = np.zeros(len(rows), dtype=np.bool_)
        for f in checks:
            raised |= (rows[:, f.word] >> np.uint64(f.shift)) & np.uint64(f.mask) != 0
        if raised.any():
            run = self.runs.to_valuation(first + int(raised.argmax()))
            at = stray(self.system, run)
            assert at is not None
            raise leaves(self.system, at, first=at.tick == len(run))

    def _within(self) -> bool:
        """Whether to go on; says so now and then."""
        count = len(self.numbers)
        used = count * (160 + 24 * self.task.layout.words + 8 * len(self.fields)) + self.joined * PER_PAIR
        if used > self.limits.memory:
            self.stopped = f"the memory limit of {self.limits.memory / 2**30:g} GiB is reached"
        if self.deadline is not None and monotonic() > self.deadline:
            self.stopped = f"the time limit of {self.limits.seconds:g} s is reached"
        if monotonic() - self.reported > _REPORT:
            self.reported = monotonic()
            self.progress(
                f"{count:,} states, {self.joined:,} ticks between them, depth {len(self.levels)}, "
                f"{count - self.expanded:,} to expand, {used / 2**20:.0f} MiB"
            )
        return not self.stopped

    def _outside(self, last: Packed) -> ModelError:
        broken: OutsideDomain = self.runs.left_domain(tuple(last.tolist()))
        return ModelError(f"{self.system.name}: {broken} Widen the domain or saturate the assignment.")

    # --- what was found --------------------------------------------------------------------------

    @cached_property
    def words(self) -> Packed:
        """The packed states."""
        return np.concatenate(self.found)

    @cached_property
    def explored(self) -> ReachableTicks:
        """The states and their ticks."""
        columns = np.empty((len(self.fields), len(self.words)), dtype=np.int64)
        for row, f in zip(columns, self.fields, strict=True):
            code = (self.words[:, f.word] >> np.uint64(f.shift)) & np.uint64(f.mask)
            row[:] = code.astype(np.int64) * f.stride + f.low
        none = np.zeros(0, dtype=np.int64)
        sources, targets = (np.concatenate([none, *(p[i] for p in self.pairs)]) for i in (0, 1))
        return ReachableTicks(
            tuple(f.var for f in self.fields), columns, self.initial, tuple(self.levels),
            np.concatenate([none, *self.parents]), sources, targets, self.expanded, self.stopped,
        )  # fmt: skip

    @cached_property
    def runs(self) -> Runs:
        """Runs of the whole system, from what was found of its part."""
        parents = self.explored.parents.clip(min=0).astype(np.uint32)
        depth = len(self.levels) - 1
        found = ExplicitFound(
            (), (), tuple(self.levels), self.words, parents, self.initial, len(self.words), 0, depth, ""
        )
        return Runs(self.system, self.task, found)

    def run(self, number: int) -> Run:
        """A shortest run to a state."""
        return self.runs.to_valuation(number)

    def inputs(self, source: int, target: int) -> dict[str, int]:
        """Inputs that a tick between two states reads, and their values."""
        return self.runs.native.inputs(self.words[source], self.words[target], REACH_TARGET)
