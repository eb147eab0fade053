"""A program at a terminal of its own, for tests of what people see there."""

import codecs
import fcntl
import os
import pty
import select
import struct
import subprocess
import sys
import tempfile
import termios
from collections.abc import Mapping, Sequence
from time import monotonic

import pyte

from tests.cli.warm import WarmProcess

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
    """Runs a command at a terminal; ``with`` it around the conversation.

    ``stdout`` and ``stderr`` are files to which one of the two goes instead of the terminal.
    """

    def __init__(
        self,
        command: Sequence[str],
        columns: int = 80,
        lines: int = 40,
        stdout: int | None = None,
        stderr: int | None = None,
        environment: Mapping[str, str] | None = None,
    ) -> None:
        self._ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", lines, columns, 0, 0))
        kept: Mapping[str, str] = {
            k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "FORCE_COLOR", "COLUMNS", "LINES")
        }
        env = {**kept, "TERM": "xterm-256color", **(environment or {})}
        self._process = self._started(command, theirs, stdout, stderr, env)
        os.close(theirs)
        self.seen = ""
        self._unfed = bytearray()
        self._decoder = codecs.getincrementaldecoder("utf-8")(errors="replace")
        self._read = 0
        self._screen = pyte.HistoryScreen(columns, lines, history=100_000, ratio=1)
        self._stream = pyte.ByteStream(self._screen)

    def _started(
        self,
        command: Sequence[str],
        theirs: int,
        stdout: int | None,
        stderr: int | None,
        env: Mapping[str, str],
    ) -> subprocess.Popen[bytes] | WarmProcess:
        return subprocess.Popen(
            [sys.executable, "-c", OWN_TERMINAL, *command],
            stdin=theirs,
            stdout=theirs if stdout is None else stdout,
            stderr=theirs if stderr is None else stderr,
            env=env,
            start_new_session=True,
        )

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

    def send(self, number: int) -> None:
        """Send a signal to the program."""
        self._process.send_signal(number)

    def ended(self) -> int:
        """The exit code, once the program has ended."""
        while self._more():
            pass
        return self._process.wait(PATIENCE)

    def shown(self) -> list[str]:
        """The lines on the terminal, after those that were scrolled away, without blanks at their ends."""
        screen = self._fed()
        columns = range(screen.columns)
        gone = ["".join(line[x].data for x in columns) for line in screen.history.top]
        return "\n".join(line.rstrip() for line in (*gone, *screen.display)).rstrip().split("\n")

    @property
    def clean(self) -> bool:
        """Whether a shell can go on: the cursor is shown, at the start of an empty line."""
        screen = self._fed()
        cursor = screen.cursor
        return not cursor.hidden and cursor.x == 0 and not screen.display[cursor.y].strip()

    @property
    def cursor_hidden(self) -> bool:
        """Whether the cursor is hidden now."""
        return bool(self._fed().cursor.hidden)

    def _fed(self) -> pyte.HistoryScreen:
        """The screen with all that was seen; it is slow, and many tests look at what was seen alone."""
        self._stream.feed(bytes(self._unfed))
        self._unfed.clear()
        return self._screen

    def _more(self) -> bool:
        ready, _, _ = select.select([self._ours], [], [], PATIENCE)
        try:
            data = os.read(self._ours, 65536) if ready else b""
        except OSError:  # the other end is closed
            return False
        self.seen += self._decoder.decode(data)  # a letter may come in two pieces
        self._unfed += data
        return bool(data)


class WarmTerminal(Terminal):
    """Runs a command of rovercheck, given by its arguments, that begins warm."""

    def _started(
        self,
        command: Sequence[str],
        theirs: int,
        stdout: int | None,
        stderr: int | None,
        env: Mapping[str, str],
    ) -> WarmProcess:
        assert stdout is None and stderr in (None, subprocess.DEVNULL)
        name = os.ttyname(theirs)
        return WarmProcess(command, (name, name, name if stderr is None else os.devnull), env)


def piped(*arguments: str) -> str:
    """What goes into a pipe, be it a result or a message, of a command that begins warm."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "pipe")
        os.mkfifo(name)
        reading = os.open(name, os.O_RDONLY | os.O_NONBLOCK)  # so that opening it waits for nobody
        os.set_blocking(reading, True)
        process = WarmProcess(arguments, (os.devnull, name, name), os.environ)
        with os.fdopen(reading, encoding="utf-8") as said:
            text = said.read()
        process.wait(PATIENCE)
    return text
