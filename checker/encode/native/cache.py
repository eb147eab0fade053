"""Compiled code on disk: one file for each key, checked when it is read, never needed to go on.

The folder is ``$ROVERCHECK_CACHE`` (empty: no cache) or ``rovercheck`` in the user's cache folder.
What is read is native code that will be run, so a folder that others may write to is not used.  Every
file starts with a digest of its key and contents: one that is damaged counts as missing.
"""

import os
import sys
import tempfile
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

VARIABLE = "ROVERCHECK_CACHE"
MOST_BYTES = 256 << 20
"""Bytes of all files together; beyond that the longest unused are removed, down to three quarters."""

_DIGEST = sha256().digest_size


def read(key: str) -> bytes | None:
    """What was written under a key; None if it is missing, damaged or cannot be read."""
    with suppress(OSError):
        path = _folder(make=False) / f"{key}.o"
        sealed = path.read_bytes()
        contents = sealed[_DIGEST:]
        if sealed[:_DIGEST] == _seal(key, contents):
            with suppress(OSError):  # where files are read only, too, they may be used
                os.utime(path)  # used now: the last to be removed
            return contents
    return None


def write(key: str, contents: bytes) -> None:
    """Keep contents under a key: whole or not at all, also beside other processes that do the same."""
    with suppress(OSError):
        folder = _folder(make=True)
        handle, name = tempfile.mkstemp(dir=folder)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(_seal(key, contents) + contents)
            os.replace(name, folder / f"{key}.o")
        except OSError:
            os.unlink(name)
            raise
        _shrink(folder)


def _seal(key: str, contents: bytes) -> bytes:
    return sha256(key.encode() + contents).digest()


def _folder(make: bool) -> Path:
    """The folder.  Raises ``OSError`` when there is none that is safe to use."""
    folder = chosen()
    if make:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    if hasattr(os, "getuid"):
        status = folder.stat()
        if status.st_uid != os.getuid() or status.st_mode & 0o022:
            raise PermissionError(f"{folder} can be written by others.")
    return folder


def chosen() -> Path:
    """The folder, which need not exist yet.  Raises ``FileNotFoundError`` when the cache is switched off."""
    named = os.environ.get(VARIABLE)
    if named is not None:
        if not named:
            raise FileNotFoundError("The cache is switched off.")
        return Path(named)
    return _users() / "rovercheck"


def _users() -> Path:
    """The platform's folder for what can be made again."""
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or os.path.expanduser("~/AppData/Local"))
    if sys.platform == "darwin":
        return Path(os.path.expanduser("~/Library/Caches"))
    return Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"))


def _shrink(folder: Path) -> None:
    """Remove the files that were not used for longest when there is too much."""
    files = [(status.st_mtime_ns, status.st_size, path) for path in folder.iterdir() if (status := _of(path))]
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
        return path.stat()
    return None
