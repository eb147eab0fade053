"""The secret that entries of the cache are sealed with: 32 random bytes in a file of the user's.

It is kept outside the cache, so that whoever restores, shares or changes the cache does not have it.
"""

import os
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

from rovercheck.checker.cache.places import UnsafePlace, carefully, usable, users_state

SECRET = "ROVERCHECK_SECRET"
"""Names the file; empty: there is none, and therefore no cache."""
LENGTH = 32


def secret_place() -> Path:
    """The file of the secret, which need not exist yet.

    Raises ``FileNotFoundError`` when it is switched off, and where the user has no home.
    """
    named = os.environ.get(SECRET)
    if named is not None:
        if not named:
            raise FileNotFoundError("The secret of the cache is switched off.")
        return Path(named)
    return users_state() / "rovercheck" / "cache-secret"


def secret(cache: Path, *, make: bool) -> bytes:
    """The secret for a folder of the cache; with ``make``, a new one if there is none.

    Raises ``UnsafePlace`` if others may have read or written it or if it is kept in the cache itself, and
    ``OSError`` if there is none and none can be made.
    """
    place = secret_place()
    if _inside(place, cache):
        raise UnsafePlace(
            f"The secret of the cache, {place}, would be inside the cache {cache}: name another folder "
            "for one of them."
        )
    try:
        return _read(place)
    except FileNotFoundError:
        if not make:
            raise
    _make(place)
    return _read(place)  # of two processes that make one, both use the one that was first


def _read(place: Path) -> bytes:
    usable(place.parent, make=False)
    if place.is_symlink():
        raise UnsafePlace(_refused(place, "is a symbolic link"))
    status, found = carefully(place, LENGTH + 1)
    if not stat.S_ISREG(status.st_mode):
        raise UnsafePlace(_refused(place, "is no file"))
    if hasattr(os, "getuid"):
        if status.st_uid != os.getuid():
            raise UnsafePlace(_refused(place, "belongs to another user"))
        if status.st_mode & (stat.S_IRWXG | stat.S_IRWXO):
            raise UnsafePlace(_refused(place, "can be read or written by others"))
    if len(found) != LENGTH:
        raise UnsafePlace(_refused(place, f"does not hold {LENGTH} bytes"))
    return found


def _refused(place: Path, why: str) -> str:
    return f"The secret of the cache, {place}, {why}: delete it, and a new one is made."


def _make(place: Path) -> None:
    """A new secret, whole at once; one that another process made meanwhile stays."""
    folder = usable(place.parent, make=True)
    handle, name = tempfile.mkstemp(dir=folder)  # readable by the user only
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(os.urandom(LENGTH))
            file.flush()
            os.fsync(handle)
        with suppress(FileExistsError):
            _appear(name, place)
    finally:
        with suppress(FileNotFoundError):
            os.unlink(name)


def _appear(name: str, place: Path) -> None:
    """Give a finished file its place, unless that is taken.  Raises ``FileExistsError``."""
    try:
        os.link(name, place)
    except FileExistsError:
        raise
    except OSError:  # not every file system has hard links
        if os.path.lexists(place):
            raise FileExistsError(place) from None
        os.replace(name, place)


def _inside(place: Path, cache: Path) -> bool:
    return Path(os.path.realpath(place)).is_relative_to(os.path.realpath(cache))
