"""The rover's charts written as models of Simulink and read again: is it the same system, in every step?

    python -m benchmarks.slx_equal [--seconds SECONDS] [SYSTEM ...]

One step of the system as it is drawn is executed beside what is read of its file, from the state that is
computed of the state of what is read; after it each variable must be what is computed then.  That it is, in
every reachable state, and that no condition under which what is read has no meaning ever holds, proves ABC
with signal correspondence (C.A.J. van Eijk: Sequential Equivalence Checking Based on Structural Similarities,
2000) where it is installed, and k-induction with an inductive invariant where it is not, or leaves something.
Then every property has the verdict that it has on the system as drawn, however long that takes.  Which
variable of the file is a timer of the system is guessed from random runs: a wrong guess proves nothing.  The
exit code is 1 if something is found to differ.
"""

import argparse
import re
import shutil
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from time import monotonic

import numpy as np

from benchmarks.measure import run
from benchmarks.rivals import ABC
from benchmarks.slx_verdicts import ReadAgain
from rovercheck.checker.encode.cone import cone
from rovercheck.checker.encode.simulate import Simulator
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.engines import Limits, engines, quiet
from rovercheck.checker.export import exporters
from rovercheck.checker.export.problem import Bad, Problem
from rovercheck.checker.results.verdict import Open, Reached
from rovercheck.checker.system.arrays import ArrayProgram, Column, Columns
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.domain import Bool, boolean
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import FALSE, Apply, Const, Expr, Var, ite
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.specialise import Specialiser
from rovercheck.spec_model.lang.system import System, TransitionSystem
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.lang.words import minimum
from rovercheck.spec_model.rover import systems

LANES, TICKS = 64, 600
"""Random runs, and the ticks of each, in which a timer is looked for."""

OF_KIND = {
    "after": (".steps",), "duration": ("_duration", ".held"), "held": ("_held",), "rising": ("_was",),
}  # fmt: skip
"""How the names of hidden variables are written in what is read of a file, of each kind in a system."""


class Renamed(Specialiser):
    """The step of a system with other variables, and with formulas in place of its inputs."""

    def __init__(self, by: Mapping[str, Expr]) -> None:
        super().__init__({})
        self._by = by

    def _expr(self, expr: Expr) -> Expr:
        return self._by[expr.name] if isinstance(expr, Var) else super()._expr(expr)

    def step(self, program: Sequence[Action]) -> tuple[Assign | If, ...]:
        """The statements of a lowered step."""
        found: list[Assign | If] = []
        for one in program:
            match one:
                case Assign(var, value):
                    written = self.expr(var)
                    assert isinstance(written, Var), f"{var.name} is an input"
                    found.append(Assign(written, self.expr(value)))
                case If(condition, then, otherwise):
                    found.append(If(self.expr(condition), self.step(then), self.step(otherwise)))
                case _:
                    raise AssertionError(one)
        return tuple(found)


class Beside:
    """A system as it is drawn beside what is read of its file.

    ``of`` computes variables of the one from those of the other: all that properties speak of, and those that
    a step reads.  ``unknown`` are those for which nothing was found.
    """

    def __init__(self, system: System, again: ReadAgain) -> None:
        self._system, self._again = system, again
        self._drawn, self._read = lower(system), lower(again.read)
        own = (*self._drawn.variables, *self._drawn.temps)
        self._as_drawn = {v.name: replace(v, name=f"{v.name} as drawn") for v in own}
        given = {v.name: again.inside[v.name] for v in self._drawn.inputs}
        given |= {v.name: again.given[v.name] for v in self._drawn.frozen}  # kept in the first step only
        self._rename = Renamed({**self._as_drawn, **given})
        self.of: dict[str, Expr] = {}
        self.unknown: list[str] = []
        self.guessed: list[str] = []
        hidden: list[Var] = []
        for var in (v for v in self._drawn.variables if v not in dict(self._drawn.checks)):
            found = self._again.inside.get(var.name, self._location(var))
            if found is not None:
                self.of[var.name] = found
            elif var.name in self._carried:
                hidden.append(var)
        if hidden:
            self._guess(hidden)

    @property
    def _carried(self) -> set[str]:
        """The variables that a step reads as they were before it."""
        after = transition(self._drawn)
        return {name for expr in (*after.next.values(), *after.assume) for name in variables(expr)}

    def _location(self, var: Var) -> Expr | None:
        """The active state of a chart, of a condition for each."""
        active = {raw: one for (name, raw), one in self._again.active.items() if name == var.name}
        found: Expr | None = None
        for raw, condition in active.items():
            last = Const(raw, var.sort)
            found = last if found is None else ite(condition, last, found)
        return found

    def _guess(self, hidden: Sequence[Var]) -> None:
        """Timers, and what is remembered of conditions: what is the same in random runs.

        The timer of a state is 0 where the state is not active, and stays as it was in what is read.
        """
        at = self._random_runs()
        taken = {one.name for one in self.of.values() if isinstance(one, Var)}
        for var in hidden:
            values = at[self._as_drawn[var.name].name]
            chart, *path, _ = var.name.split(".")
            active = next((c.active_path(tuple(path)) for c in self._system.charts if c.name == chart), FALSE)
            on = np.ones(len(values), dtype=np.bool_)
            if path:
                [found] = ArrayProgram([self._rename.expr(active)])(at)
                on &= found
            high = var.domain.high  # where the one counts no further, the other may
            alike = [
                v for v in self._read.variables
                if self._fits(v, var) and _same(np.minimum(at[v.name], high), values, on)
            ]  # fmt: skip
            likely = Likely(var.name)
            size = len(var.domain)
            alike.sort(key=lambda v: (*likely.order(v.name), v.name in taken, len(v.domain) != size))
            if not alike or values[~on].any():
                self.unknown.append(var.name)
                continue
            taken.add(alike[0].name)
            self.guessed.append(var.name)
            zero, counter = Const(0, var.sort), alike[0]
            one = minimum(counter, high) if counter.domain.high > high else counter
            self.of[var.name] = ite(self._again.expr(active), one, zero) if path else one

    @staticmethod
    def _fits(one: Var, other: Var) -> bool:
        return type(one.sort) is type(other.sort)

    def _random_runs(self) -> Columns:
        """The variables of both in many states of random runs, each with a state of its own."""
        variables_ = (*self._read.variables, *(self._as_drawn[v.name] for v in self._drawn.variables))
        step = (*self._rename.step(self._drawn.step), *self._read.step)
        both = self._system_of(variables_, (self._as_drawn[v.name] for v in self._drawn.temps), step)
        runs = Simulator(cone(transition(both), [v.name for v in variables_]), lanes=LANES, seed=1)
        return runs.run(runs.start(), TICKS).samples()

    def differing(self) -> tuple[TransitionSystem, list[Var]]:
        """What is read of the file, and for each variable of the system whether it differs after a step.

        Behind these are the conditions under which what is read has no meaning.
        """
        goals = {name: Var(f"{name} differs", boolean, 0) for name in self.of}
        before = [Assign(self._as_drawn[name], expr) for name, expr in self.of.items()]
        after = [
            Assign(goals[name], ~Apply(Op.EQ, (self._as_drawn[name], expr), Bool()))
            for name, expr in self.of.items()
        ]
        step = (*before, *self._rename.step(self._drawn.step), *self._read.step, *after)
        own = (*self._read.variables, *goals.values())
        meaningless = [one for one in self._read.variables if one.name in dict(self._read.checks)]
        return self._system_of(own, self._as_drawn.values(), step), [*goals.values(), *meaningless]

    def begins_otherwise(self) -> list[str]:
        """The variables of the system that are not what is computed before the first step."""
        before = {**self._read.init, **{one.name: one.init for one in self._read.frozen}}
        first = self._drawn.init
        return [name for name, expr in self.of.items() if evaluate(expr, before) != first[name]]

    def _system_of(
        self, own: Iterable[Var], more: Iterable[Var], step: Sequence[Assign | If]
    ) -> TransitionSystem:
        return replace(
            self._read, name=f"{self._system.name} beside its file", variables=tuple(own),
            temps=(*self._read.temps, *more), step=tuple(step), checks=(), source=None,
        )  # fmt: skip


class Likely:
    """Which variable of a file may be a hidden one of a system: runs may not tell, where a state is rare."""

    def __init__(self, name: str) -> None:
        chart, *path, last = name.split(".")
        self._inside = ".".join(path)
        self._kinds = OF_KIND[last.rstrip("0123456789")]
        self._of_chart = re.compile(rf"\b{re.escape(chart)}(({'|'.join(self._kinds)})\d|\.)")

    def order(self, name: str) -> tuple[bool, ...]:
        """False where a name says that it may be the one, what tells most first."""
        of_kind = any(kind in name for kind in self._kinds)
        return not of_kind, not self._of_chart.search(name), self._inside not in name


def _same(one: Column, other: Column, where: Column) -> bool:
    return bool(np.array_equal(one[where], other[where]))


def main(arguments: list[str]) -> int:
    """Prove that systems are the same, and print of which that is not known; the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.slx_equal")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("systems", nargs="*")
    asked = parser.parse_args(arguments)
    on = Counter(prop.on for prop in catalogue().values())
    told, properties = Counter[str](), Counter[str]()
    with tempfile.TemporaryDirectory() as folder:
        for name, system in systems().items():
            if on[name] and (not asked.systems or name in asked.systems):
                since = monotonic()
                word, why = _compared(system, Path(folder), asked.seconds)
                told[word] += 1
                properties[word] += on[name]
                took = f"{on[name]:3} properties {monotonic() - since:7.1f} s"
                print(f"{name:40} {word:12} {took}  {why}".rstrip(), flush=True)
    for word, count in told.items():
        print(f"{count} systems with {properties[word]} properties: {word}")
    return 1 if told["differs"] else 0


def _compared(system: System, folder: Path, seconds: float) -> tuple[str, str]:
    """Whether what is read of a file is the same as the system of which it was written, and why."""
    try:
        beside = Beside(system, ReadAgain(system, folder))
    except ModelError as error:
        return "refused", str(error).splitlines()[0]
    return judged(beside, folder, seconds)


def judged(beside: Beside, folder: Path, seconds: float) -> tuple[str, str]:
    """Whether both are ``the same``, by what, ``not known``, or differ, with the variables that do."""
    if unknown := [*beside.unknown, *beside.begins_otherwise()]:
        return "not known", f"nothing is known of {', '.join(unknown)}"
    if shutil.which(ABC) and by_correspondence(*beside.differing(), folder, seconds):
        return "the same", "ABC"
    return by_induction(beside, seconds)


def by_correspondence(joined: TransitionSystem, goals: Sequence[Var], folder: Path, seconds: float) -> bool:
    """Whether ABC proves that none of the goals is ever reached.

    ``fold`` makes the constraint on inputs part of each, and what ``scorr`` finds to be equal is one signal
    for ``pdr``, which is asked of each goal on its own: their disjunction may take it much longer.
    """
    data = exporters()["aiger"].export(Problem("equal", joined, tuple(Bad(one, one.name) for one in goals)))
    assert isinstance(data, bytes)
    file = folder / "equal.aig"
    file.write_bytes(data)
    script = f"read_aiger {file}; fold; strash; scorr; pdr -a -T {seconds:.0f}"
    return "Disproved = 0. Undecided = 0." in run([ABC, "-q", script], 2 * seconds).text


def by_induction(beside: Beside, seconds: float) -> tuple[str, str]:
    """What k-induction says of it, each variable by itself."""
    joined, goals = beside.differing()
    answers = engines()["kinduction"].check(joined, goals, Limits(seconds=seconds), quiet)
    reached = [name for name, answer in answers.items() if isinstance(answer, Reached)]
    if reached and beside.guessed:
        return "not known", f"{', '.join(reached)}, or a guess is wrong: {', '.join(beside.guessed)}"
    if reached:
        return "differs", ", ".join(reached)
    left = [answer for answer in answers.values() if isinstance(answer, Open)]
    if left:
        return "not known", f"{len(left)} of {len(goals)}: {left[0].reason}"
    return "the same", "k-induction"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
