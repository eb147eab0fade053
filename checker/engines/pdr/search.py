"""Property directed reachability (Bradley, VMCAI 2011; Eén, Mishchenko, Brayton, FMCAD 2011).

Obligations are states from which a goal is reached; each is excluded from a frame by a lemma, or
has a predecessor there, which is the next obligation, or is initial, which makes a run.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import count

from rovercheck.checker.engines.pdr.cones import Cones
from rovercheck.checker.engines.pdr.cubes import Cube, cube
from rovercheck.checker.engines.pdr.frames import Frames
from rovercheck.checker.engines.pdr.lemmas import ALWAYS, Lemma, LemmaStep
from rovercheck.checker.engines.pdr.machine import PdrMachine

# --- lifting -------------------------------------------------------------------------------------------


class Lifter:
    """Generalises one state and its inputs to all states in which the same inputs do the same."""

    def __init__(self, machine: PdrMachine) -> None:
        self._machine = machine
        self._cones = Cones(machine, inside=False)

    def into(self, step: LemmaStep, target: Cube) -> Cube:
        """The states from which, as the step shows of one, the inputs lead into the target."""
        after = self._machine.after
        return self._lifted(step, [after[x] for x in target.literals])

    def onto(self, step: LemmaStep, goal: str) -> Cube:
        """The states from which, as the step shows of one, the inputs make the goal true."""
        return self._lifted(step, [self._machine.goals[goal]])

    def _lifted(self, step: LemmaStep, wanted: list[int]) -> Cube:
        """By a core of why the inputs cannot fail to do what is wanted and be assumed."""
        if self._cones.bloated:
            self._cones = Cones(self._machine, inside=False)
        cones = self._cones
        active = cones.fresh()
        cones.add([-active, *(-x for x in cones.literals([self._machine.assume, *wanted]))])
        latches = cones.literals(step.latches)
        if cones.solve([active, *cones.literals(step.inputs), *latches]):
            raise ArithmeticError("the engine is wrong: a tick does not do what it was found to do")
        core = cones.core()
        cones.retire(active)
        return cube(x for x, y in zip(step.latches, latches, strict=True) if y in core)


# --- inductive generalisation --------------------------------------------------------------------------

_AGING = 1.02


class Generaliser:
    """Makes lemmas of blocked cubes; latches that occur in many recent lemmas are dropped last."""

    def __init__(self, frames: Frames) -> None:
        self._frames = frames
        self._activity = [0.0] * (frames.machine.latches + 1)
        self._step = 1.0

    def lemma(self, blocked: Cube, level: int) -> Lemma:
        """A lemma that excludes a cube, at the highest level that holds; the cube is blocked at ``level``."""
        frames = self._frames
        lemma = Lemma(self._smallest(blocked, level), level)
        while lemma.level < frames.top and lemma.witness is None:
            if frames.blocked(lemma.cube, lemma.level) is None:
                lemma.witness = frames.witness()
            else:
                lemma.level += 1
        self._bump(lemma.cube)
        frames.add(lemma)
        return lemma

    def _smallest(self, blocked: Cube, level: int) -> Cube:
        """Literals are dropped one by one as long as the rest is blocked and holds no initial state."""
        activity, frames = self._activity, self._frames
        for literal in sorted(blocked.literals, key=lambda x: activity[abs(x)]):
            if literal in blocked.literals:
                part = cube(x for x in blocked.literals if x != literal)
                if not frames.initial(part):
                    blocked = frames.blocked(part, level - 1) or blocked
        return blocked

    def _bump(self, small: Cube) -> None:
        self._step *= _AGING
        for literal in small.literals:
            self._activity[abs(literal)] += self._step
        if self._step > 1e100:
            self._activity = [x / self._step for x in self._activity]
            self._step = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class PdrObligation:
    """Every state of the cube leads with the inputs to the next obligation, or to the goal."""

    cube: Cube
    inputs: tuple[int, ...]
    next: "PdrObligation | None"


@dataclass(frozen=True)
class PdrRun:
    """A run: the latches before the first tick and the inputs of every tick, as literals."""

    latches: tuple[int, ...]
    inputs: tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class PdrInvariant:
    """The goal is never reached: the cubes of an inductive invariant, whose negations are its clauses."""

    cubes: tuple[Cube, ...]


@dataclass(frozen=True)
class BoundedDepth:
    """The goal is not reached by any run of at most ``depth`` ticks."""

    depth: int


Event = PdrRun | PdrInvariant | BoundedDepth


class PdrSearch:
    """Frames of one machine, used for one goal after the other."""

    def __init__(self, machine: PdrMachine) -> None:
        self.frames = Frames(machine)
        self._lifter = Lifter(machine)
        self._generaliser = Generaliser(self.frames)
        self._made = 0

    def decide(self, goal: str) -> Iterator[Event]:
        """Bounds, again and again while the work goes on; the last event is a run or an invariant.

        What is learned serves the other goals too, also while their searches are not over.
        """
        frames = self.frames
        for level in count():
            while frames.top < max(level, 1):
                frames.open()
            while (run := self._one_less(goal, level)) is not None:
                if isinstance(run, PdrRun):
                    yield run
                    return
                yield BoundedDepth(level)
            yield BoundedDepth(level + 1)
            self._propagate()
            if frames.hits(goal, ALWAYS) is None:
                yield PdrInvariant(tuple(lemma.cube for lemma in frames.always))
                return

    # --- obligations -----------------------------------------------------------------------------

    def _one_less(self, goal: str, level: int) -> PdrRun | LemmaStep | None:
        """Exclude a state of the frame from which the goal is reached: the step is such a one, unless
        it begins a run; None when there is none left."""
        step = self.frames.hits(goal, level)
        if step is None:
            return None
        first = PdrObligation(self._lifter.onto(step, goal), step.inputs, None)
        return self._discharged(first, level) or step

    def _discharged(self, first: PdrObligation, level: int) -> PdrRun | None:
        frames = self.frames
        heap: list[tuple[int, int, PdrObligation]] = []
        self._push(heap, level, first)
        while heap:
            level, _, wanted = heappop(heap)
            if frames.initial(wanted.cube):
                return self._run(wanted)
            if level == 0:
                raise ArithmeticError("the engine is wrong: frame 0 has a state that is not initial")
            if not frames.excluded(wanted.cube, level):
                blocked = frames.blocked(wanted.cube, level - 1)
                if blocked is None:
                    step = frames.step()
                    before = PdrObligation(self._lifter.into(step, wanted.cube), step.inputs, wanted)
                    self._push(heap, level, wanted)
                    self._push(heap, level - 1, before)
                    continue
                level = self._generaliser.lemma(blocked, level).level
            if level < frames.top:
                self._push(heap, level + 1, wanted)
        return None

    def _push(self, heap: list[tuple[int, int, PdrObligation]], level: int, wanted: PdrObligation) -> None:
        self._made += 1
        heappush(heap, (level, self._made, wanted))

    def _run(self, first: PdrObligation) -> PdrRun:
        inputs, obligation = list[tuple[int, ...]](), first
        while True:
            inputs.append(obligation.inputs)
            if obligation.next is None:
                return PdrRun(self.frames.started(first.cube), tuple(inputs))
            obligation = obligation.next

    # --- propagation -----------------------------------------------------------------------------

    def _propagate(self) -> None:
        """Push lemmas to higher frames; those above two equal frames are inductive, and hold always."""
        frames = self.frames
        for level in range(1, frames.top):
            for lemma in list(frames.lemmas[level]):
                if lemma.witness is None and not lemma.dropped:
                    self._try(lemma)
            if not frames.lemmas[level]:
                self._conclude(level + 1)
                return

    def _try(self, lemma: Lemma) -> None:
        """Push a lemma to the next frame, or note what hinders it."""
        frames = self.frames
        if frames.blocked(lemma.cube, lemma.level, relative=False) is None:
            lemma.witness = frames.witness()
        else:
            frames.raise_(lemma, lemma.level + 1)

    def _conclude(self, level: int) -> None:
        """The lemmas from a level on are inductive: they hold always."""
        frames = self.frames
        for lemma in [lemma for same in frames.lemmas[level:] for lemma in same]:
            if not lemma.dropped:
                frames.raise_(lemma, ALWAYS)
