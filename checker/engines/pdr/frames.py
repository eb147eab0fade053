"""Frames: what is known of the states reachable within so many ticks.

Frame 0 is the initial states; a lemma at level ``i`` is the negation of a cube that holds no
state reachable within ``i`` ticks.  Frame ``i`` consists of the lemmas at level ``i`` or above.
"""

from collections.abc import Iterator

from rovercheck.checker.engines.pdr.cones import Cones
from rovercheck.checker.engines.pdr.cubes import Cube, cube
from rovercheck.checker.engines.pdr.lemmas import ALWAYS, Lemma, LemmaStep
from rovercheck.checker.engines.pdr.machine import PdrMachine

# --- the initial states ----------------------------------------------------------------------------


class Initial:
    """The initial states of a machine."""

    def __init__(self, machine: PdrMachine) -> None:
        self._machine = machine
        self._cones = Cones(machine, inside=False)
        self._free = frozenset(range(1, machine.latches + 1)).difference(map(abs, machine.init))
        self._cones.add([self._cones.literal(machine.start)])

    def meets(self, wanted: Cube) -> bool:
        """Whether an initial state lies in a cube that contradicts no initial value."""
        if self._free.isdisjoint(map(abs, wanted.literals)):
            return True
        cones = self._cones
        return cones.solve([cones.literal(x) for x in wanted.literals if abs(x) in self._free])

    def inside(self, wanted: Cube) -> tuple[int, ...]:
        """The values of the frozen latches in an initial state that lies in a cube."""
        if not self._cones.solve([self._cones.literal(x) for x in wanted.literals if abs(x) in self._free]):
            raise ArithmeticError("the engine is wrong: a run starts where none does")
        return self._cones.model()[0]


class Frames:
    """The frames of one machine and the questions asked of them."""

    def __init__(self, machine: PdrMachine) -> None:
        self.machine = machine
        self.queries = 0
        self.lemmas: list[list[Lemma]] = [[], []]
        """Lemmas by level; those of level ``ALWAYS`` are in ``always``."""
        self.always: list[Lemma] = []
        self._contrary = frozenset(-literal for literal in machine.init)
        self._start = Initial(machine)
        self._ticks, self._goals = _Solver(self), _Solver(self)
        self._solvers = self._ticks, self._goals

    @property
    def top(self) -> int:
        """The highest level with a frame."""
        return len(self.lemmas) - 1

    @property
    def size(self) -> int:
        """The number of lemmas."""
        return sum(map(len, self.lemmas)) + len(self.always)

    def open(self) -> None:
        """One more frame, with no lemma of its own."""
        self.lemmas.append([])
        for solver in self._solvers:
            solver.level()

    # --- lemmas ----------------------------------------------------------------------------------

    def at_least(self, level: int) -> Iterator[Lemma]:
        """The lemmas of a frame."""
        for same in self.lemmas[level:]:
            yield from same
        yield from self.always

    def excluded(self, wanted: Cube, level: int) -> bool:
        """Whether one lemma of the frame excludes all of a cube."""
        mask, value = wanted.mask, wanted.value
        for lemma in self.at_least(level):
            own = lemma.cube
            if mask & own.mask == own.mask and value & own.mask == own.value:
                return True
        return False

    def add(self, lemma: Lemma) -> None:
        """A new lemma; weaker ones at its level or below are dropped."""
        for level in range(1, min(lemma.level, self.top) + 1):
            self._weaken(level, lemma.cube)
        self._enter(lemma)

    def raise_(self, lemma: Lemma, level: int) -> None:
        """Move a lemma to a higher level; weaker ones on its way are dropped."""
        self.lemmas[lemma.level].remove(lemma)
        for number in range(lemma.level + 1, min(level, self.top) + 1):
            self._weaken(number, lemma.cube)
        lemma.level = level
        self._enter(lemma)

    def _enter(self, lemma: Lemma) -> None:
        (self.always if lemma.level == ALWAYS else self.lemmas[lemma.level]).append(lemma)
        for solver in self._solvers:
            solver.add(lemma)

    def _weaken(self, level: int, excluded: Cube) -> None:
        """Drop the lemmas of a level that another one implies, and witnesses that are excluded now."""
        mask, value = excluded.mask, excluded.value
        dropped = False
        for other in self.lemmas[level]:
            own, witness = other.cube, other.witness
            if witness is not None and not (witness.value ^ value) & witness.mask & mask:
                other.witness = None
            if own.value & mask == value and own.mask & mask == mask:
                other.dropped = dropped = True
        if dropped:
            self.lemmas[level] = [other for other in self.lemmas[level] if not other.dropped]

    # --- questions -------------------------------------------------------------------------------

    def initial(self, wanted: Cube) -> bool:
        """Whether some initial state lies in a cube."""
        return self._contrary.isdisjoint(wanted.literals) and self._start.meets(wanted)

    def started(self, wanted: Cube) -> tuple[int, ...]:
        """The frozen latches of an initial state in a cube that holds some; others may have any value."""
        return self._start.inside(wanted)

    def hits(self, goal: str, level: int) -> LemmaStep | None:
        """A state of a frame and inputs with which a goal is true after the tick."""
        self.queries += 1
        solver = self._goals
        if solver.solve(level, [solver.cones.literal(self.machine.goals[goal])]):
            return LemmaStep(*solver.cones.model())
        return None

    def blocked(self, wanted: Cube, level: int, relative: bool = True) -> Cube | None:
        """If no tick leads from the frame (outside the cube, if ``relative``) into the cube: the part of the
        cube that this rests on, which holds no initial state.  None if some tick does, see ``step``."""
        self.queries += 1
        solver, after = self._ticks, self.machine.after
        solver.refresh()
        outside = solver.outside(wanted) if relative else ()
        primed = solver.cones.literals([after[x] for x in wanted.literals])
        if solver.solve(level, [*outside, *primed]):
            return None
        core = solver.cones.core()
        return self._apart([x for x, y in zip(wanted.literals, primed, strict=True) if y in core], wanted)

    def step(self) -> LemmaStep:
        """The tick that ``blocked`` found last."""
        return LemmaStep(*self._ticks.cones.model())

    def witness(self) -> Cube:
        """The state before that tick."""
        return cube(self._ticks.cones.model()[0])

    def _apart(self, kept: list[int], whole: Cube) -> Cube:
        """A cube of these literals of a whole cube, and of more if it would hold an initial state."""
        part = cube(kept)
        if len(part) == len(whole) or not self.initial(part):
            return part
        for literal in whole.literals:
            if literal in self._contrary:
                return cube([*kept, literal])
        return whole


class _Solver:
    """A solver with the lemmas of all frames; each holds under the literal of its level."""

    def __init__(self, frames: Frames) -> None:
        self._frames = frames
        self._open()

    def _open(self) -> None:
        frames = self._frames
        machine = frames.machine
        cones = self.cones = Cones(machine, inside=True)
        cones.add([cones.literal(machine.assume)])
        self._levels: list[int] = []
        self._outside = 0
        self._begun = False
        for _ in frames.lemmas:
            self.level()
        for lemma in frames.at_least(1):
            self.add(lemma)

    def refresh(self) -> None:
        """Start anew if much of what the solver holds serves no more."""
        if self.cones.bloated:
            self._open()

    def level(self) -> None:
        """One more level; each implies the next."""
        new = self.cones.fresh()
        if self._levels:
            self.cones.add([-self._levels[-1], new])
        self._levels.append(new)

    def add(self, lemma: Lemma) -> None:
        clause = [-x for x in self.cones.literals(lemma.cube.literals)]
        if lemma.level < ALWAYS:
            clause.append(-self._levels[lemma.level])
        self.cones.add(clause)

    def solve(self, level: int, assumptions: list[int]) -> bool:
        """Whether literals can be true together, in this tick, in some state of a frame."""
        if level == 0 and not self._begun:
            self._begin()
        frame = [self._levels[level]] if level < ALWAYS else []
        return self.cones.solve([*frame, *assumptions])

    def _begin(self) -> None:
        """Frame 0: the initial states."""
        machine, cones = self._frames.machine, self.cones
        for literal in (*machine.init, machine.start):
            cones.add([-self._levels[0], cones.literal(literal)])
        self._begun = True

    def outside(self, wanted: Cube) -> tuple[int]:
        """A literal that confines the next question to states outside a cube."""
        self.cones.retire(self._outside)
        self._outside = self.cones.fresh()
        self.cones.add([-self._outside, *(-x for x in self.cones.literals(wanted.literals))])
        return (self._outside,)
