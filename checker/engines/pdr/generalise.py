"""Inductive generalisation: few literals that still keep every tick of a frame out of a cube."""

from checker.engines.pdr.cubes import Cube, cube
from checker.engines.pdr.frames import Frames
from checker.engines.pdr.lemmas import Lemma

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
        """Literals are dropped one by one as long as the rest is blocked and holds no initial valuation."""
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
