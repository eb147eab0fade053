"""The entries of the cache: one file for each name, believed only under the user's seal.

A file is the seal, then the contents.  The seal is an HMAC (SHA-256) over name and contents, so that
nothing can be put under another name.  One that does not fit counts as missing, and is written anew.
"""

import hmac
import os
import re
import tempfile
from contextlib import suppress
from pathlib import Path

from rovercheck.checker.cache import run_marks
from rovercheck.checker.cache.listeners import CachedCodeUse, CacheRefused, anew, has_listener, notify
from rovercheck.checker.cache.places import VARIABLE, UnsafePlace, carefully, chosen, usable
from rovercheck.checker.cache.secret_file import SECRET, secret

ENDING = ".o"
MOST_BYTES = 256 << 20
"""Bytes of all entries together; beyond that the longest unused are removed, down to three quarters."""
SELDOM = 128
"""A process looks through the folder again when it has written the 128th part of that: there may be many."""
MEANINGLESS = ValueError, KeyError, TypeError, AttributeError, RecursionError, OverflowError
"""What reading an entry as JSON of some shape raises where it is of another one."""

_unseen: list[int] = []
"""The sizes of what this process has written since it looked; nothing before it has."""
_SEAL = 32
_LABEL = b"rovercheck cache 2\0"
"""What the secret is used for: nothing else that is sealed with it can pass for an entry."""
_BEGUN = "rovercheck-", ".part"
"""How the names of files begin and end that are being written."""
_OURS = re.compile(r"[0-9a-f]{64}-[a-z]+-[a-z]+\.(o|running)|rovercheck-\w+\.part")
"""The names of files that may be removed: the folder may be one that the user keeps other things in."""


def read(name: str, *, code: bool = True) -> bytes | None:
    """What this user's rovercheck wrote under a name; None if that is missing, changed or cannot be read.

    With ``code``, it is about to be run: where code is to be made anew (see ``listeners.listening``), and
    where a process has crashed over it, the entry is removed.
    """
    try:
        folder = usable(chosen(), make=False)
        key = secret(folder, make=False)
        path = folder / f"{name}{ENDING}"
        if code and (anew() or run_marks.crashed(path)):
            remove(name)
            return None
        contents = opened(name, carefully(path, MOST_BYTES)[1], key)
    except UnsafePlace as unsafe:
        notify(CacheRefused(str(unsafe)))
        return None
    except OSError:
        return None
    if contents is not None:
        with suppress(OSError):  # where files are read only, too, they may be used
            os.utime(path)  # used now: the last to be removed
        if code and has_listener():
            notify(CachedCodeUse(name))
        elif code:
            run_marks.mark(path)
    return contents


def write(name: str, contents: bytes) -> None:
    """Keep contents under a name: whole or not at all, also beside other processes that do the same."""
    try:
        folder = usable(chosen(), make=True)
        whole = sealed(name, contents, secret(folder, make=True))
        handle, part = tempfile.mkstemp(prefix=_BEGUN[0], suffix=_BEGUN[1], dir=folder)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(whole)
            os.replace(part, folder / f"{name}{ENDING}")
        except OSError:
            os.unlink(part)
            raise
        _written(folder, len(whole))
    except UnsafePlace as unsafe:
        notify(CacheRefused(str(unsafe)))
    except FileNotFoundError:  # switched off, or removed just now: the next one is written again
        pass
    except OSError as error:
        notify(CacheRefused(_unwritable(error)))


def _unwritable(error: OSError) -> str:
    """What to do about it; a disk that is full does not say for which file."""
    what = error.filename or chosen()
    return (
        f"Cannot write {what}: {error.strerror or error}. Choose other places with {VARIABLE} and {SECRET}, "
        f"or none: {VARIABLE}="
    )


def remove(name: str) -> None:
    """Have no entry of that name."""
    with suppress(OSError):
        (usable(chosen(), make=False) / f"{name}{ENDING}").unlink(missing_ok=True)


def sealed(name: str, contents: bytes, key: bytes) -> bytes:
    """Contents that only a holder of the key can have put under a name."""
    return _seal(name, contents, key) + contents


def opened(name: str, whole: bytes, key: bytes) -> bytes | None:
    """The contents, or None if they were not sealed with the key under that name."""
    contents = memoryview(whole)[_SEAL:]
    return bytes(contents) if hmac.compare_digest(whole[:_SEAL], _seal(name, contents, key)) else None


def _seal(name: str, contents: bytes | memoryview, key: bytes) -> bytes:
    written = name.encode()
    # With its length: where a name ends is no choice.
    seal = hmac.new(key, b"%b%d\0%b" % (_LABEL, len(written), written), "sha256")
    seal.update(contents)
    return seal.digest()


def _written(folder: Path, size: int) -> None:
    """Look for too much at the first entry that this process writes, and whenever some more is written."""
    first = not _unseen
    _unseen.append(size)
    if first or sum(_unseen) > MOST_BYTES // SELDOM:
        _unseen[:] = [0]
        _shrink(folder)


def _shrink(folder: Path) -> None:
    """Remove the entries that were not used for longest when there is too much."""
    ours = (path for path in folder.iterdir() if _OURS.fullmatch(path.name))
    files = [(status.st_mtime_ns, status.st_size, path) for path in ours if (status := _of(path))]
    size = sum(bytes_ for _, bytes_, _ in files)
    if size <= MOST_BYTES:
        return
    for _, bytes_, path in sorted(files):
        if size <= MOST_BYTES * 3 // 4:
            return
        with suppress(OSError):  # another process removed it
            path.unlink()
        size -= bytes_


def _of(path: Path) -> os.stat_result | None:
    with suppress(OSError):
        return path.lstat()
    return None
