"""Where the cache and its secret are, and whether only the user can write there."""

import os
import stat
import sys
from pathlib import Path

VARIABLE = "ROVERCHECK_CACHE"
"""Names the folder of the cache; empty: there is none."""
STORE = "ROVERCHECK_STORE"
"""Empty: no verdict is kept in the cache."""
_CAREFUL = sum(getattr(os, name, 0) for name in ("O_RDONLY", "O_NOFOLLOW", "O_NONBLOCK", "O_BINARY"))
"""No link is followed, no pipe waited for."""
_OTHERS = stat.S_IWGRP | stat.S_IWOTH


class UnsafePlace(PermissionError):
    """A folder or file that others may have changed or read.  The message says which, and what to do."""


def chosen() -> Path:
    """The folder of the cache, which need not exist yet.

    Raises ``FileNotFoundError`` when the cache is switched off, and where the user has no home.
    """
    named = os.environ.get(VARIABLE)
    if named is not None:
        if not named:
            raise FileNotFoundError("The cache is switched off.")
        return Path(named)
    return _users_cache() / "rovercheck"


def usable(folder: Path, *, make: bool) -> Path:
    """The folder, made if that is asked for.

    Raises ``UnsafePlace`` if others may write to it, and ``OSError`` if it is missing or cannot be made.
    """
    if make:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    status = folder.stat()
    if hasattr(os, "getuid"):
        if status.st_uid != os.getuid():
            raise UnsafePlace(
                f"The folder {folder} belongs to another user: delete it, or name one of your own."
            )
        if status.st_mode & _OTHERS:
            raise UnsafePlace(f"Others may write to the folder {folder}: chmod go-w {folder}")
    return folder


def carefully(path: Path, most: int) -> tuple[os.stat_result, bytes]:
    """What a file is, and its bytes: none if there are more, and if it is no file, as a pipe is none.

    Whatever somebody else has put there, it is not waited for and not read without end.  Raises ``OSError``.
    """
    handle = os.open(path, _CAREFUL)
    try:
        status = os.fstat(handle)
        if not stat.S_ISREG(status.st_mode) or status.st_size > most:
            return status, b""
        with os.fdopen(handle, "rb", buffering=0, closefd=False) as file:
            return status, file.readall()
    finally:
        os.close(handle)


def _users_cache() -> Path:
    """The platform's folder for what can be made again."""
    if sys.platform == "win32":
        return _of_the_user("LOCALAPPDATA", "AppData/Local")
    if sys.platform == "darwin":
        return _of_the_user("", "Library/Caches")
    return _of_the_user("XDG_CACHE_HOME", ".cache")


def users_state() -> Path:
    """The platform's folder for what a program remembers; it is not the one for caches.

    Raises ``FileNotFoundError`` where the user has no home.
    """
    if sys.platform == "win32":
        return _of_the_user("APPDATA", "AppData/Roaming")
    if sys.platform == "darwin":
        return _of_the_user("", "Library/Application Support")
    return _of_the_user("XDG_STATE_HOME", ".local/state")


def _of_the_user(variable: str, below_home: str) -> Path:
    named = os.environ.get(variable, "")
    if os.path.isabs(named):  # what is not is to be ignored, says the standard of these variables
        return Path(named)
    home = os.path.expanduser("~")
    if not os.path.isabs(home) or home == os.sep or not os.path.isdir(home):
        raise FileNotFoundError("There is no home folder.")
    return Path(home, below_home)
