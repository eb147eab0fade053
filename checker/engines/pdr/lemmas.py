"""Lemmas, the levels up to which they hold, and ticks that solvers find."""

from dataclasses import dataclass

from rovercheck.checker.engines.pdr.cubes import Cube

ALWAYS = 1 << 30
"""The level of lemmas that hold in every reachable state."""


@dataclass(frozen=True, slots=True)
class LemmaStep:
    """A tick that a solver found: as literals, the latches before it and the inputs that matter to it."""

    latches: tuple[int, ...]
    inputs: tuple[int, ...]


class Lemma:
    """A cube that is excluded up to a level; ``witness`` is a state of the frame at its level with a
    tick into the cube, as far as it matters, which shows that the lemma cannot be pushed for now;
    ``dropped`` once a stronger lemma has taken its place."""

    __slots__ = ("cube", "dropped", "level", "witness")

    def __init__(self, excluded: Cube, level: int) -> None:
        self.cube = excluded
        self.level = level
        self.witness: Cube | None = None
        self.dropped = False
