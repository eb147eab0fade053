"""Runs from a finished search: the chain of parents, then inputs for each tick of it.

Inputs that a tick does not read keep their value where they may, so that traces change little.
"""

from collections.abc import Mapping
from functools import cached_property
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.encode.native import (
    LEAVE_DOMAIN,
    REACH_TARGET,
    NativeRetrace,
    NativeTask,
    OutsideDomain,
    moved_on,
)
from rovercheck.checker.engines.explicit.levels import ExplicitFound
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.partition import Partition, partition
from rovercheck.checker.system.slice import assumption_groups
from rovercheck.spec_model.lang.evaluate import evaluate, step
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables

Packed = tuple[int, ...]
"""The words of a state."""


class Runs:
    """Rebuilds runs of the whole system from what a search of its slice stored."""

    def __init__(self, system: TransitionSystem, task: NativeTask, found: ExplicitFound) -> None:
        self.system, self.task, self.found = system, task, found

    @cached_property
    def groups(self) -> list[list[Expr]]:
        """The conjuncts of the assumption, those that share inputs together."""
        return assumption_groups(self.system)

    @cached_property
    def cells(self) -> dict[str, Partition]:
        """The cells of every input, also of those that the slice leaves out."""
        system, own = self.system, self.task.cells
        everything = {v.name: v for v in (*system.inputs, *system.frozen, *system.variables)}
        return {v.name: own.get(v.name) or partition(v, [system.assume], everything) for v in system.inputs}

    @cached_property
    def native(self) -> NativeRetrace:
        return NativeRetrace.compile(self.task)

    def to_goal(self, number: int, goal: Var) -> Run:
        """A shortest run to a goal that was hit.  Checked by running it on the whole system."""
        last = self.found.hits[number]
        assert last is not None
        run, at = self._run(last, self._chosen(self.line(last, self.found.levels[number]), number))
        if not at[goal.name]:
            raise AssertionError(f"the run of {len(run)} ticks does not reach {goal.name}")
        return run

    def to_valuation(self, number: int) -> Run:
        """A run that ends in a stored state, as short as the search found it."""
        line = self.line(number, self.found.level(number))
        run, at = self._run(number, self._ticks(line))
        if any(at[name] != raw for name, raw in self.task.layout.unpack(line[-1]).items()):
            raise AssertionError(f"the run of {len(run)} ticks does not end in state {number}")
        return run

    def _run(self, last: int, chosen: list[dict[str, int]]) -> tuple[Run, Mapping[str, int]]:
        """The run of the whole system with the inputs that were read in each tick, and where it ends."""
        at = {**self.system.init, **self._frozen(last)}
        inputs: list[Mapping[str, int]] = []
        for read in chosen:
            inputs.append(self._completed(at, read, inputs[-1] if inputs else {}))
            at = step(self.system, at, inputs[-1])
        return Run(self._frozen(last), tuple(inputs)), at

    def left_domain(self, last: Packed) -> OutsideDomain:
        """The error to raise when a tick from the last state breaks the model."""
        words = _array(last)
        before = self.task.layout.unpack(last)
        default = {v.name: v.domain.low for v in self.task.system.inputs}
        inputs = default | self.native.inputs(words, words, LEAVE_DOMAIN)
        after = step(self.task.system, before, inputs)
        broken = next((v for v in self.task.system.variables if after[v.name] not in v.domain), None)
        if broken is None:
            raise AssertionError(f"a tick from {before} leads to values that none was known to take")
        return OutsideDomain(broken, after[broken.name])

    def line(self, last: int, level: int) -> list[Packed]:
        """The states before each tick of a run that visits the last and is then quiet up to a level."""
        found: list[Packed] = []
        while True:
            found += reversed(self._quiet(last, level))
            if last < self.found.initial:
                return found[::-1]
            level = self.found.level(last) - 1
            parent = int(self.found.parents[last])
            if not 0 <= parent < last:
                raise AssertionError(f"{parent} is no parent of state {last}: it was not found before it")
            last = parent

    def _quiet(self, number: int, level: int) -> list[Packed]:
        """A stored state and those that follow it by quiet ticks."""
        at: Packed | None = tuple(self.found.words[number].tolist())
        along = []
        for _ in range(level - self.found.level(number) + 1):
            assert at is not None
            along.append(at)
            at = moved_on(at, self.task.shifts)
        return along

    def _chosen(self, line: list[Packed], wanted: int) -> list[dict[str, int]]:
        last = _array(line[-1])
        return [*self._ticks(line), self.native.inputs(last, last, wanted)]

    def _ticks(self, line: list[Packed]) -> list[dict[str, int]]:
        return [self.native.inputs(_array(a), _array(b), REACH_TARGET) for a, b in pairwise(line)]

    def _frozen(self, last: int) -> dict[str, int]:
        packed = self.task.layout.unpack(self.found.words[last].tolist())
        return {v.name: packed.get(v.name, v.init) for v in self.system.frozen}

    def _completed(
        self, at: Mapping[str, int], read: Mapping[str, int], before: Mapping[str, int]
    ) -> dict[str, int]:
        """A value for every input: the cells that were read, the last values where they may stay."""
        inputs = {n: self._calm(self.cells[n], read.get(n), before.get(n)) for n in self.cells}
        for group in self.groups:
            if not _holds(group, {**at, **inputs}):
                inputs |= self._solved(group, at, inputs, read)
        return inputs

    def _calm(self, own: Partition, read: int | None, before: int | None) -> int:
        if read is None:
            return before if before is not None and before in own.cell_of else own.values[0]
        if before is not None and own.cell_of.get(before) == own.cell_of[read]:
            return before
        return read

    def _solved(
        self, group: list[Expr], at: Mapping[str, int], inputs: Mapping[str, int], read: Mapping[str, int]
    ) -> dict[str, int]:
        """Values that meet conjuncts about inputs that the slice left out."""
        free = [n for n in variables(*group) if n in inputs and n not in read]
        for values in product(*([c.value for c in self.cells[n].cells] for n in free)):
            changed = dict(zip(free, values, strict=True))
            if _holds(group, {**at, **inputs, **changed}):
                return changed
        raise AssertionError("no inputs meet the assumption that the slice left out")


def _array(words: Packed) -> NDArray[np.uint64]:
    return np.array(words, dtype=np.uint64)


def _holds(group: list[Expr], at: Mapping[str, int]) -> bool:
    return all(evaluate(c, at) for c in group)
