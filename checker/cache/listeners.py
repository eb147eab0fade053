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
    """The cache is not used because it would not be safe; ``why`` says what was found and what to do."""

    why: str


Listener = Callable[[CachedCodeUse | CacheRefused], None]


@dataclass
class _Listening:
    listener: Listener | None = None
    anew: bool = False
    refused: set[str] = field(default_factory=set)


_now = _Listening()


def notify(what: CachedCodeUse | CacheRefused) -> None:
    """Say it to who listens; why the cache is refused is said once."""
    if _now.listener is None or (isinstance(what, CacheRefused) and what.why in _now.refused):
        return
    if isinstance(what, CacheRefused):
        _now.refused.add(what.why)
    _now.listener(what)


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
