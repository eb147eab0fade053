"""Who hears what the cache does: a child tells its parent, which cannot ask it after a crash."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field


@dataclass(frozen=True)
class CachedCodeUse:
    """Code of that name comes from the cache and is about to be run."""

    name: str


@dataclass(frozen=True)
class CacheRefused:
    """Nothing is kept: that would not be safe, or cannot be; ``why`` says what was found and what to do."""

    why: str


Listener = Callable[[CachedCodeUse | CacheRefused], None]


@dataclass
class _Listening:
    listener: Listener | None = None
    anew: bool = False
    refused: set[str] = field(default_factory=set)
    unheard: list[str] = field(default_factory=list)


_now = _Listening()


def notify(what: CachedCodeUse | CacheRefused) -> None:
    """Say it to who listens; why the cache is refused is said once, and kept where nobody listens."""
    if isinstance(what, CacheRefused):
        if not first(what):
            return
        if _now.listener is None:
            _now.unheard.append(what.why)
    if _now.listener is not None:
        _now.listener(what)


def first(what: CacheRefused) -> bool:
    """Whether that is heard for the first time in this process."""
    new = what.why not in _now.refused
    _now.refused.add(what.why)
    return new


def unheard() -> list[str]:
    """Why the cache was refused in this process when nobody listened; told once."""
    told, _now.unheard = _now.unheard, []
    return told


def has_listener() -> bool:
    """Whether somebody listens."""
    return _now.listener is not None


def anew() -> bool:
    """Whether what is in the cache is to be made again."""
    return _now.anew


@contextmanager
def listening(listener: Listener, *, anew: bool = False) -> Iterator[None]:
    """Have this process tell what its cache does.

    With ``anew``, entries that are asked for are removed instead of read: code like it has crashed.
    """
    before = _now.listener, _now.anew
    _now.listener, _now.anew = listener, anew
    try:
        yield
    finally:
        _now.listener, _now.anew = before
