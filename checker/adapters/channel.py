"""A process that is spoken to line by line, and can be killed at any moment with all that it started."""

import os
import select
import signal
import subprocess
import time
import weakref
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import IO

from rovercheck.checker.adapters.lines import shown

LONGEST = 1 << 20
"""Bytes of an answer; a longer one is an error."""
CHUNK = 1 << 16
COMPLAINTS, COMPLAINT_LINES, COMPLAINT_WIDTH = 4096, 10, 200
"""Bytes of standard error that are kept, lines that are shown, and characters of each."""
MOST_READS = 32
"""A pipe holds 1 MiB at most; more would come from a process that has run away."""
GRACE = 1.0
"""Seconds to end, once there is nothing more to do."""
PAUSE = 0.005
"""Seconds between two looks whether it has ended."""


class BrokenChannel(Exception):
    """No answer, and none will come; the message says why, for a person, after "the process"."""


class Channel:
    """A process in a session of its own, so that Ctrl-C reaches its parent alone."""

    def __init__(self, command: Sequence[str], environment: Mapping[str, str] | None = None) -> None:
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            bufsize=0,
            env=environment,
            start_new_session=True,
        )
        self._end = weakref.finalize(self, _killed, self._process)  # also when the interpreter ends
        self._in, self._out, self._err = map(_number, _pipes(self._process))
        self._poll = select.poll()
        self._poll.register(self._out, select.POLLIN)
        self._poll.register(self._err, select.POLLIN)
        self._outbox, self._inbox, self._complaints = bytearray(), bytearray(), bytearray()
        self._over = False

    def send(self, lines: bytes) -> None:
        """Have lines written, without waiting.  Raises ``BrokenChannel`` if it said something unasked."""
        if not self._outbox and (self._inbox or (not self._over and self._moved(0) and self._inbox)):
            raise BrokenChannel(f"said {shown(bytes(self._inbox))} without being asked")
        self._outbox += lines
        self._write()

    def receive(self, seconds: float) -> bytes:
        """The next line of the process.  Raises ``BrokenChannel`` if none comes in time."""
        end = time.monotonic() + seconds
        while (length := self._inbox.find(b"\n")) < 0:
            if len(self._inbox) > LONGEST:
                raise BrokenChannel(f"answered more than {LONGEST:,} bytes without an end of line")
            if self._over:
                raise BrokenChannel(self._cause())
            left = end - time.monotonic()
            if left <= 0 or not self._moved(left):
                raise BrokenChannel(f"did not answer within {seconds:g} s")
        line = bytes(self._inbox[:length])
        del self._inbox[: length + 1]
        return line

    def complaints(self) -> list[str]:
        """The last lines of its standard error."""
        said = self._complaints.decode(errors="replace").strip().splitlines()
        return [line[:COMPLAINT_WIDTH] for line in said[-COMPLAINT_LINES:]]

    def close(self) -> None:
        """Tell the process that nothing more will come, and kill it if that does not end it."""
        with suppress(OSError):
            _pipes(self._process)[0].close()
        _ended(self._process, GRACE)
        self.kill()

    def kill(self) -> None:
        """End the process and all that it started, whatever they do."""
        if self._end.alive:
            self._end()
            self._drain()
            for pipe in _pipes(self._process):
                with suppress(OSError):
                    pipe.close()

    def _moved(self, seconds: float) -> bool:
        """Move bytes in all directions once; false if there were none to move in that time."""
        ready = self._poll.poll(seconds * 1000)
        for number, _ in ready:
            if number == self._in:
                self._write()
            elif number == self._out:
                self._hear()
            else:
                self._listen()
        return bool(ready)

    def _write(self) -> None:
        """Write what the pipe takes, and wait for room only if something is left."""
        try:
            while self._outbox:
                del self._outbox[: os.write(self._in, self._outbox)]
        except BlockingIOError:
            self._poll.register(self._in, select.POLLOUT)
            return
        except OSError:  # it no longer reads; its end explains why
            self._outbox.clear()
        with suppress(KeyError):
            self._poll.unregister(self._in)

    def _hear(self) -> None:
        heard = _read(self._out)
        self._inbox += heard or b""
        if heard == b"":
            self._over = True
            self._poll.unregister(self._out)

    def _listen(self) -> bool:
        """Keep the end of what it complains about; false when nothing more is there for now."""
        heard = _read(self._err)
        if heard == b"":
            with suppress(KeyError):
                self._poll.unregister(self._err)
        self._complaints += heard or b""
        del self._complaints[:-COMPLAINTS]
        return bool(heard)

    def _drain(self) -> None:
        """Read the last complaints of a process that has ended."""
        for _ in range(MOST_READS):
            if not self._listen():
                break

    def _cause(self) -> str:
        """Why nothing more comes."""
        where = f" in the middle of the line {shown(bytes(self._inbox))}" if self._inbox else ""
        status = _ended(self._process, GRACE)
        if status is None:
            return f"closed its standard output{where}"
        if status < 0:
            return f"was ended by {_signal(-status)}{where}"
        return f"ended with status {status}{where or ' without an answer'}"


def _pipes(process: subprocess.Popen[bytes]) -> tuple[IO[bytes], IO[bytes], IO[bytes]]:
    assert process.stdin is not None and process.stdout is not None and process.stderr is not None
    return process.stdin, process.stdout, process.stderr


def _number(pipe: IO[bytes]) -> int:
    """The descriptor of a pipe that is made to wait for nothing."""
    os.set_blocking(pipe.fileno(), False)
    return pipe.fileno()


def _read(number: int) -> bytes | None:
    """What is there to read: b"" at the end, None for nothing yet."""
    try:
        return os.read(number, CHUNK)
    except BlockingIOError:
        return None


def _signal(number: int) -> str:
    named = {s.value: s.name for s in signal.Signals}  # those for real time have no names
    said = signal.strsignal(number)
    return named.get(number, f"signal {number}") + (f" ({said})" if said else "")


def _ended(process: subprocess.Popen[bytes], seconds: float) -> int | None:
    """Its status if it ends in that time; all that it started is killed while its number is still its own."""
    until = time.monotonic() + seconds
    while process.returncode is None:
        if _has_ended(process):
            _killed(process)
        elif time.monotonic() >= until:
            return None
        else:
            time.sleep(PAUSE)
    return process.returncode


def _has_ended(process: subprocess.Popen[bytes]) -> bool:
    """Whether it has ended; where the system can tell, without giving its number away to another process."""
    if hasattr(os, "waitid"):
        return os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None
    return process.poll() is not None


def _killed(process: subprocess.Popen[bytes]) -> None:
    if process.returncode is not None:  # its number may belong to another process by now
        return
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
    with suppress(OSError):
        process.kill()
    process.wait()
