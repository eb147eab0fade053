"""What is known while transitions are written: when they are tested, what is left to test, who arrives."""

from dataclasses import dataclass
from xml.etree.ElementTree import Element

from rovercheck.checker.export.scxml.content import Content
from rovercheck.spec_model.lang.chart import Path, Transition


@dataclass
class Moment:
    """When transitions are tested: at an event, or without one as soon as ``holder`` is active.

    Before all of them something ``holds``.  It is ``decided`` once one without a guard is among them.
    """

    holder: Element
    event: str | None
    holds: str = ""
    decided: bool = False


@dataclass(frozen=True)
class Frame:
    """Segments that are to be tested at a level, after those of ``so_far``."""

    segments: tuple[Transition, ...]
    level: Path
    so_far: tuple[Transition, ...] = ()

    @property
    def key(self) -> object:
        """What frames have in common that are the same."""
        return tuple(map(id, self.segments)), self.level, tuple(map(id, self.so_far))


@dataclass(frozen=True)
class Arrival:
    """A state that is entered on the way to ``end``, and begins with its entry actions at an event."""

    path: Path
    event: str
    end: Path
    onward: Content


__all__ = ["Arrival", "Frame", "Moment"]
