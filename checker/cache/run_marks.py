"""A mark beside an entry while a process may run its code: a mark without its process tells of a crash.

For processes that nobody listens to: a child tells its parent instead (see ``telling``).
"""

import atexit
import os
import platform
import sys
from contextlib import suppress
from pathlib import Path

from rovercheck.checker.cache.places import carefully

ENDING = ".running"
_MOST = 300
_marks: set[Path] = set()


def mark(entry: Path) -> None:
    """Say that this process may run the code of an entry from now on; taken back when it ends."""
    place = entry.with_suffix(ENDING)
    if sys.platform == "win32" or place in _marks:
        return
    with suppress(OSError):  # where nothing can be written, a crash is not noted
        place.unlink(missing_ok=True)  # and never written through a link that somebody has put there
        with os.fdopen(os.open(place, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
            file.write(_who(os.getpid()))
        if not _marks:
            atexit.register(_take_back)
        _marks.add(place)


def crashed(entry: Path) -> bool:
    """Whether a process has ended over the code of an entry without a word; that is forgotten then."""
    if sys.platform == "win32":
        return False
    place = entry.with_suffix(ENDING)
    try:
        said = carefully(place, _MOST)[1]
        pid = int(said.rpartition(b" ")[2])
        if said != _who(pid) or pid <= 0 or _alive(pid):
            return False
        place.unlink()
    except (OSError, ValueError):
        return False
    return True


def _who(pid: int) -> bytes:
    """A process of this machine; of others it is not known whether they live."""
    return f"{platform.node()} {pid}".encode()


def _alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        return True
    return True


def _take_back() -> None:
    while _marks:
        with suppress(OSError):
            _marks.pop().unlink()
