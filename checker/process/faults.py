"""Internal errors in the midst of work that goes on without them: kept, told, and never the end of a verdict.

An engine that raises is an internal error, and no reason for the others to lose their turns.  ``attempted``
is put around such a piece of work; whoever leads the whole listens, and says it loudly when all is done.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import TypeVar

from rovercheck.spec_model.lang.errors import ModelError

MEMORY_IS_OVER = ("out of memory", "allocate memory", "bad_alloc", "start new thread")
"""What libraries say, in errors of many kinds, when they get no more memory."""
LONGEST = 300
"""Characters of an error's own message that are told."""


@dataclass(frozen=True)
class Fault:
    """An internal error: ``who`` failed, on which system (empty: not known here), and with what."""

    who: str
    system: str
    error: str

    def __str__(self) -> str:
        return f"{self.who} failed on {self.system} with {self.error}"


@dataclass(frozen=True)
class Failed:
    """What comes of work that a fault has ended; ``reason`` names who failed, and with what."""

    reason: str


class InternalError(Exception):
    """A fault that nobody listened to."""


T = TypeVar("T")
Listener = Callable[[Fault], None]


@dataclass
class _Listening:
    listeners: list[Listener] = field(default_factory=list)


_now = _Listening()


@contextmanager
def listening(listener: Listener) -> Iterator[None]:
    """Have the faults of this process told to ``listener`` alone."""
    _now.listeners.append(listener)
    try:
        yield
    finally:
        _now.listeners.pop()


def has_listener() -> bool:
    """Whether somebody listens."""
    return bool(_now.listeners)


def report(fault: Fault) -> None:
    """Say it to who listens.  Raises ``InternalError`` if nobody does: no fault is lost."""
    if not has_listener():
        raise InternalError(str(fault))
    _now.listeners[-1](fault)


def attempted(who: str, system: str, work: Callable[[], T], *known: type[Exception]) -> T | Failed:
    """What the work comes to, or that a fault has ended it, which is told.

    What is no internal error is raised: mistakes of the model, no memory, what the operating system refuses,
    and ``known`` kinds of errors, which have a meaning.  So is everything where nobody listens.
    """
    if not has_listener():
        return work()
    within: list[Fault] = []
    try:
        with listening(within.append):
            return work()
    except Exception as error:
        if isinstance(error, (ModelError, MemoryError, OSError, *known)):
            raise
        if starved(error):
            raise MemoryError from error
        within.append(Fault(who, system, described(error)))
        return Failed(f"{who} failed with {in_short(error)}")
    finally:
        for fault in within:
            report(replace(fault, who=fault.who or who, system=fault.system or system))


def is_fault(error: BaseException) -> bool:
    """Whether an error that nobody expects is one of ours, and not one of the machine or the model."""
    outside = isinstance(error, ModelError | MemoryError | OSError) or starved(error)
    return isinstance(error, Exception) and not outside


def starved(error: BaseException) -> bool:
    """Whether an error says that there is no more memory."""
    text = str(error).lower()
    return isinstance(error, MemoryError) or any(words in text for words in MEMORY_IS_OVER)


def in_short(error: BaseException) -> str:
    """``AssertionError: message``, in one line."""
    text = " ".join(str(error).split())
    text = text if len(text) <= LONGEST else f"{text[:LONGEST]}..."
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def described(error: BaseException) -> str:
    """The same, with the place where it arose."""
    return f"{in_short(error)}{place(error)}"


def place(error: BaseException) -> str:
    """`` (module, line 7)`` for the report of an error, as far as that is known."""
    last = error.__traceback__
    while last is not None and last.tb_next is not None:
        last = last.tb_next
    return "" if last is None else f" ({last.tb_frame.f_globals.get('__name__')}, line {last.tb_lineno})"
