"""A program at a terminal of its own, for tests of what people see there."""

import os
import pty
import select
import subprocess
import sys
from collections.abc import Mapping, Sequence
from time import monotonic

OWN_TERMINAL = """
import fcntl, os, signal, sys, termios
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    signal.signal(number, signal.SIG_DFL)
signal.pthread_sigmask(signal.SIG_SETMASK, [])
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
os.execvp(sys.argv[1], sys.argv[1:])
"""
"""Makes the terminal the controlling one, so that Ctrl-C reaches the program, whatever the tests ignore."""
PATIENCE = 60.0
"""Seconds after which a test gives up; a test that passes never waits so long."""


class Terminal:
    """Runs a command at a terminal of 80 columns; ``with`` it around the conversation."""

    def __init__(self, command: Sequence[str], **environment: str) -> None:
        self._ours, theirs = pty.openpty()
        kept: Mapping[str, str] = {
            k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "FORCE_COLOR")
        }
        known = {**kept, "TERM": "xterm-256color", "COLUMNS": "80", "LINES": "40", **environment}
        self._process = subprocess.Popen(
            [sys.executable, "-c", OWN_TERMINAL, *command], stdin=theirs, stdout=theirs, stderr=theirs,
            env=known, start_new_session=True,
        )  # fmt: skip
        os.close(theirs)
        self.seen = ""
        self._read = 0

    def __enter__(self) -> "Terminal":
        return self

    def __exit__(self, *_: object) -> None:
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()
        os.close(self._ours)

    def type(self, text: str) -> None:
        """Type keys, control characters included."""
        os.write(self._ours, text.encode())

    def until(self, text: str) -> None:
        """Wait until this is shown after what was waited for before."""
        end = monotonic() + PATIENCE
        while text not in self.seen[self._read :]:
            if monotonic() > end or not self._more():
                raise AssertionError(f"{text!r} was not shown after:\n{self.seen}")
        self._read = self.seen.index(text, self._read) + len(text)

    def interrupt(self, text: str) -> None:
        """Press Ctrl-C until this is shown: readline misses one that comes just before it waits for keys.

        What was typed before must have been shown: a Ctrl-C drops keys that readline was told of and has
        not read, and then it waits for others, whatever it is sent.
        """
        end = monotonic() + PATIENCE
        while text not in self.seen[self._read :]:
            assert monotonic() < end, f"{text!r} was not shown after:\n{self.seen}"
            self.type("\x03")
            again = monotonic() + 5
            while text not in self.seen[self._read :] and (left := again - monotonic()) > 0:
                if select.select([self._ours], [], [], left)[0] and not self._more():
                    break
        self.until(text)

    def tell(self, number: int) -> None:
        """Send a signal until something is shown: readline misses one just before it waits for keys."""
        shown = len(self.seen)
        end = monotonic() + PATIENCE
        while len(self.seen) == shown:
            assert monotonic() < end, f"nothing was shown after the signal {number}"
            self._process.send_signal(number)
            if select.select([self._ours], [], [], 5)[0] and not self._more():
                break

    def ended(self) -> int:
        """The exit code, once the program has ended."""
        while self._more():
            pass
        return self._process.wait(PATIENCE)

    def _more(self) -> bool:
        ready, _, _ = select.select([self._ours], [], [], PATIENCE)
        try:
            data = os.read(self._ours, 65536) if ready else b""
        except OSError:  # the other end is closed
            return False
        self.seen += data.decode(errors="replace")
        return bool(data)
