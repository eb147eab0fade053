"""Processes forked from one that has imported what they need: a start of 10 ms in place of 1 s (Linux alone).

The server does nothing but import, fork and wait, in a single thread, so that a fork finds no lock held.
It ends when the pipe to its parent is closed, and what it forked dies with it.
"""

import os
import select
import signal
import socket
import struct
import subprocess
import sys
import threading
from collections.abc import Mapping, Sequence
from contextlib import suppress
from importlib import import_module
from types import TracebackType
from typing import IO

SERVER_MAIN = "from rovercheck.checker.process.fork_server import serve; serve()"
AVAILABLE = sys.platform == "linux" and hasattr(os, "pidfd_open")
_STATUS = struct.Struct("<q")
_FORK = b"fork"
_PATIENCE = 60.0
"""Seconds for the modules to be imported, after which a process is started without the server."""


class NoServer(Exception):
    """The server cannot be started, does not import the modules, or has died."""


class ForkedProcess:
    """A process that the server has forked, in the words of ``subprocess.Popen``.

    It is signalled by a descriptor, not by its number, which another process may have by then.
    """

    def __init__(self, pid: int, descriptor: int, stdin: IO[bytes], stdout: IO[bytes], end: socket.socket):
        self.pid = pid
        self.stdin = stdin
        self.stdout = stdout
        self._descriptor = descriptor
        self._end = end
        self._waiting = threading.Lock()
        self._status: int | None = None

    def wait(self) -> int:
        """Its status when it has ended: negative for a signal.  That of a lost server is SIGKILL."""
        with self._waiting:
            if self._status is None:
                with suppress(OSError):
                    told = self._end.recv(_STATUS.size)
                    self._status = _STATUS.unpack(told)[0] if told else None
                self._status = -signal.SIGKILL if self._status is None else self._status
            return self._status

    def kill(self) -> None:
        """End it, unless it has ended."""
        with suppress(ProcessLookupError):
            signal.pidfd_send_signal(self._descriptor, signal.SIGKILL)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, where: TracebackType | None
    ) -> None:
        """Wait for its end, and close what leads to it."""
        self.wait()
        os.close(self._descriptor)
        self._end.close()
        self.stdout.close()
        self.stdin.close()


class ForkServer:
    """The parent's side.  Raises ``NoServer`` where processes cannot be forked so."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        self._lock = threading.Lock()
        self._imported: set[str] = set()
        self._ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            try:
                self._process = subprocess.Popen(
                    [sys.executable, "-P", "-c", SERVER_MAIN, str(theirs.fileno())],
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                    env=environment,
                    pass_fds=[theirs.fileno()],
                )
            except OSError as error:
                self._ours.close()
                raise NoServer(str(error)) from error

    @property
    def pid(self) -> int:
        """Its number."""
        return self._process.pid

    def fork(self, modules: Sequence[str], errors: IO[bytes]) -> ForkedProcess:
        """A process that has imported the modules and waits for orders.  Raises ``NoServer``."""
        orders, stdin = os.pipe()
        stdout, messages = os.pipe()
        end, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        end.settimeout(_PATIENCE)
        try:
            with self._lock:
                for module in modules:
                    if module not in self._imported:
                        self._ours.send(module.encode())
                        self._imported.add(module)
                given = [orders, messages, errors.fileno(), theirs.fileno()]
                socket.send_fds(self._ours, [_FORK], given)
            theirs.close()
            number, [descriptor], _, _ = socket.recv_fds(end, _STATUS.size, 1)
        except (OSError, ValueError) as error:  # no descriptor came: the server has died
            end.close()
            os.close(stdin)
            os.close(stdout)
            raise NoServer("the process that forks others has ended") from error
        finally:
            theirs.close()
            os.close(orders)
            os.close(messages)
        end.settimeout(None)
        pid = _STATUS.unpack(number)[0]
        return ForkedProcess(pid, descriptor, os.fdopen(stdin, "wb"), os.fdopen(stdout, "rb"), end)

    def close(self) -> None:
        """End it, and with it what it forked."""
        self._ours.close()
        self._process.kill()
        self._process.wait()


# --- in the server -------------------------------------------------------------------------------


def serve() -> None:
    """The main program of the server: a message is a module to import, or the descriptors of a child."""
    asked = socket.socket(fileno=int(sys.argv[1]))
    woken, wake = os.pipe2(os.O_NONBLOCK | os.O_CLOEXEC)
    signal.set_wakeup_fd(wake)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    ends: dict[int, socket.socket] = {}
    while True:
        ready, _, _ = select.select([asked.fileno(), woken], [], [])
        if woken in ready:
            os.read(woken, 4096)
            _tell_ended(ends)
        if asked.fileno() in ready:
            message, given, _, _ = socket.recv_fds(asked, 4096, 4)
            if not message:
                os._exit(0)
            if not given:
                import_module(message.decode())
                continue
            pid = os.fork()
            if pid == 0:
                signal.set_wakeup_fd(-1)
                signal.signal(signal.SIGCHLD, signal.SIG_DFL)
                for descriptor in (woken, wake, asked.detach(), *(end.detach() for end in ends.values())):
                    os.close(descriptor)
                _become_child(given)
            end = socket.socket(fileno=given.pop())
            for descriptor in given:
                os.close(descriptor)
            ends[pid] = end
            opened = os.pidfd_open(pid)  # where that cannot be, the server ends, and its parent does without
            with suppress(OSError):  # nobody waits for it any more
                socket.send_fds(end, [_STATUS.pack(pid)], [opened])
            os.close(opened)


def _become_child(given: Sequence[int]) -> None:
    """What ``python -c`` of a child does, with these as standard input, output and errors."""
    from rovercheck.checker.process.child import child

    for standard, descriptor in enumerate(given[:3]):
        os.dup2(descriptor, standard)
    for descriptor in given:
        os.close(descriptor)
    try:
        child()
    finally:
        os._exit(1)


def _tell_ended(ends: dict[int, socket.socket]) -> None:
    """Tell the parent how each child that has ended did so."""
    for pid in list(ends):
        ended, status = os.waitpid(pid, os.WNOHANG)
        if ended:
            with ends.pop(pid) as end, suppress(OSError):
                end.send(_STATUS.pack(os.waitstatus_to_exitcode(status)))


__all__ = ["AVAILABLE", "SERVER_MAIN", "ForkServer", "ForkedProcess", "NoServer"]
