"""Children forked from a warm process: as those that are started anew, and none outlives its parent."""

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from rovercheck.checker.process import isolate
from rovercheck.checker.process.fork_server import AVAILABLE, ForkedProcess, ForkServer, NoServer
from rovercheck.checker.process.isolate import ChildStopped, Send, messages
from tests.process.test_isolate import ROOT, alive, gone

pytestmark = pytest.mark.skipif(not AVAILABLE, reason="children are forked on Linux alone")
SELDOM_READ = "wave"


@pytest.fixture
def inside(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[ForkServer]]:
    """As in a child, whose own children are forked; the servers that it has."""
    servers: list[ForkServer] = []
    monkeypatch.setattr(isolate, "_is_child", lambda: True)
    monkeypatch.setattr(isolate, "_servers", servers)
    monkeypatch.setattr(isolate, "_servers_lost", [])
    yield servers
    for server in servers:
        server.close()


def tell(send: Send) -> None:
    send((os.getpid(), os.getppid(), SELDOM_READ in sys.modules))


def tell_and_sleep(send: Send) -> None:
    send((os.getpid(), os.getppid()))
    time.sleep(60)


def descriptors(send: Send) -> None:
    send(sorted(map(int, os.listdir("/proc/self/fd"))))


def first(work: object, modules: list[str]) -> tuple[int, ...]:
    return next(m for m in messages(work, modules=modules) if m is not None)  # type: ignore[arg-type]


def test_children_have_one_parent_which_has_read_the_module(inside: list[ForkServer]) -> None:
    told = [first(tell, [SELDOM_READ]) for _ in range(3)]
    assert len({pid for pid, _, _ in told}) == 3
    assert {(parent, read) for _, parent, read in told} == {(inside[0].pid, True)}


def test_a_module_of_a_later_child_is_read_too(inside: list[ForkServer]) -> None:
    assert first(tell, ["json"])[2] is False
    assert first(tell, [SELDOM_READ])[1:] == (inside[0].pid, True)


def test_without_modules_or_outside_of_a_child_none_is_forked(
    inside: list[ForkServer], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert first(tell, [])[1] == os.getpid()
    monkeypatch.setattr(isolate, "_is_child", lambda: False)
    assert first(tell, [SELDOM_READ])[1] == os.getpid()
    assert not inside


def test_a_module_that_is_not_there_is_reported_by_a_child_that_needs_it(inside: list[ForkServer]) -> None:
    assert first(tell, ["no_such_module"])[1] == os.getpid()
    assert not inside and len(isolate._servers_lost) == isolate._MOST_LOST


def test_a_server_that_died_is_replaced_and_its_children_say_so(inside: list[ForkServer]) -> None:
    with pytest.raises(ChildStopped, match="ended by SIGKILL"):
        for message in messages(tell_and_sleep, modules=["json"]):
            if message is not None:
                pid, parent = message
                os.kill(parent, signal.SIGKILL)
    assert gone(pid)
    assert first(tell, ["json"])[1] not in (parent, os.getpid())
    assert gone(parent)
    assert len(inside) == 1


def test_the_end_of_a_server_is_the_end_of_its_children(inside: list[ForkServer]) -> None:
    with closing(messages(tell_and_sleep, modules=["json"])) as inbox:
        pid, _ = next(m for m in inbox if m is not None)
        inside[0].close()
        assert gone(pid)


def test_a_child_holds_no_descriptor_of_another_one(inside: list[ForkServer]) -> None:
    alone = first(descriptors, ["json"])
    with closing(messages(tell_and_sleep, modules=["json"])) as inbox:
        next(m for m in inbox if m is not None)
        assert first(descriptors, ["json"]) == alone


def test_descriptors_are_given_back(inside: list[ForkServer]) -> None:
    counts = []
    for _ in range(3):
        first(tell, ["json"])
        counts.append(len(os.listdir("/proc/self/fd")))
    assert len(set(counts)) == 1
    assert len(os.listdir(f"/proc/{inside[0].pid}/fd")) < 12


def test_one_that_has_ended_is_not_signalled(inside: list[ForkServer]) -> None:
    server = ForkServer(isolate._environment())
    inside.append(server)
    with tempfile.TemporaryFile() as errors:
        process = server.fork(["json"], errors)
        process.stdin.close()  # no more orders: it ends
        assert process.wait() == 1
        process.kill()
        process.__exit__(None, None, None)


def test_a_server_that_cannot_be_started_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "executable", "/no/such/python")
    with pytest.raises(NoServer, match="No such file"):
        ForkServer({})


def test_without_one_children_are_started_anew(
    inside: list[ForkServer], monkeypatch: pytest.MonkeyPatch
) -> None:
    def none(*_: object) -> ForkedProcess:
        raise NoServer("not here")

    monkeypatch.setattr(ForkServer, "fork", none)
    assert first(tell, ["json"])[1] == os.getpid()


PARENT = """
from contextlib import closing
from rovercheck.checker.process import isolate
from tests.process import test_fork_server as here
isolate._is_child = lambda: True
with closing(isolate.messages(here.tell_and_sleep, modules=["json"])) as inbox:
    for message in inbox:
        if message is not None:
            print(*message, flush=True)
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_child_and_server_die_with_the_parent(number: signal.Signals) -> None:
    path = os.pathsep.join([str(ROOT), *filter(None, sys.path)])
    with subprocess.Popen(
        [sys.executable, "-c", PARENT],
        cwd=Path(ROOT),
        env={**os.environ, "PYTHONPATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    ) as parent:
        assert parent.stdout is not None
        pids = [int(pid) for pid in parent.stdout.readline().split()]
        assert len(pids) == 2 and all(map(alive, pids))
        parent.send_signal(number)
    assert all(map(gone, pids))
