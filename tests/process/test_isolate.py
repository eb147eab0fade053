"""Work in a child: messages arrive, and whatever the child does, it comes to an end."""

import ctypes
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from rovercheck.checker.process import isolate
from rovercheck.checker.process.fork_server import AVAILABLE, ForkServer
from rovercheck.checker.process.isolate import ChildStopped, Send, messages
from rovercheck.spec_model.lang.expr import flag
from rovercheck.spec_model.lang.walk import nodes

ROOT = Path(__file__).parents[2]


@pytest.fixture(
    params=["anew", pytest.param("forked", marks=pytest.mark.skipif(not AVAILABLE, reason="Linux"))]
)
def modules(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """What a child imports: nothing where it is started anew, something where it is forked."""
    if request.param == "anew":
        yield []
        return
    servers: list[ForkServer] = []
    monkeypatch.setattr(isolate, "_is_child", lambda: True)
    monkeypatch.setattr(isolate, "_servers", servers)
    yield ["json"]
    assert len(servers) == 1
    servers[0].close()


def _count(send: Send, most: int) -> None:
    print("a library that prints must not disturb")
    for n in range(most):
        send(n)


def _size(send: Send, expr: object) -> None:
    send(len(list(nodes(expr))))  # type: ignore[arg-type]


def _fail(_: Send) -> None:
    raise ValueError("no such thing")


def _exit(_: Send) -> None:
    os._exit(3)


def _fill(send: Send) -> None:
    send(len(bytearray(2 << 30)))


def _tell_and_sleep(send: Send, seconds: float) -> None:
    send(os.getpid())
    time.sleep(seconds)


class Unreadable(Exception):
    """Cannot be made again from what pickle keeps of it."""

    def __init__(self, first: str, _: str) -> None:
        super().__init__(first)


def _tell_unreadable(send: Send) -> None:
    send(Unreadable("a", "b"))
    time.sleep(60)


def _leave(_: Send) -> None:
    sys.exit(3)


def _signalled(_: Send, number: int) -> None:
    os.kill(os.getpid(), number)


def _tell_and_hold_the_lock(send: Send, seconds: int) -> None:
    """As a solver does that does not let other threads of Python run."""
    send(os.getpid())
    ctypes.PyDLL(None).sleep(seconds)


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def gone(pid: int, within: float = 5.0) -> bool:
    end = time.monotonic() + within
    while alive(pid) and time.monotonic() < end:
        time.sleep(0.02)
    return not alive(pid)


def test_messages_arrive_in_order(modules: list[str]) -> None:
    assert [m for m in messages(_count, 1000, modules=modules) if m is not None] == list(range(1000))


def test_a_deep_formula_reaches_the_child(modules: list[str]) -> None:
    expr = flag("a") & flag("b")
    for _ in range(2000):
        expr = ~expr
    assert [m for m in messages(_size, expr, modules=modules) if m is not None] == [2003]


@pytest.mark.parametrize(
    ("work", "reason"),
    [
        (_fail, "ValueError: no such thing"),
        (_exit, "the solver process ended with status 3"),
        (_leave, "SystemExit: 3"),
        (_tell_unreadable, "a message of the solver process cannot be read: TypeError"),
    ],
)
def test_a_failure_is_a_reason_and_no_traceback(work: object, reason: str, modules: list[str]) -> None:
    with pytest.raises(ChildStopped, match=reason):
        list(messages(work, seconds=30, modules=modules))  # type: ignore[arg-type]


@pytest.mark.skipif(sys.platform != "linux", reason="signals for real time")
def test_a_signal_without_a_name_is_a_reason_too(modules: list[str]) -> None:
    with pytest.raises(ChildStopped, match="ended by signal 40"):
        list(messages(_signalled, 40, seconds=30, modules=modules))


def test_no_module_is_taken_from_the_folder_we_are_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "tempfile.py").write_text("raise SystemExit", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert [m for m in messages(_count, 1) if m is not None] == [0]


@pytest.mark.skipif(sys.platform != "linux", reason="address space limits")
def test_the_memory_limit(modules: list[str]) -> None:
    with pytest.raises(ChildStopped, match="the memory limit is reached"):
        list(messages(_fill, memory=1 << 30, modules=modules))


def test_the_time_limit_kills_and_quiet_seconds_are_told(modules: list[str]) -> None:
    heard = []
    with pytest.raises(ChildStopped, match="time limit of 5 s"):
        for message in messages(_tell_and_sleep, 600, seconds=5, beat=0.2, modules=modules):
            heard.append(message)
    [pid] = [m for m in heard if m is not None]
    assert None in heard and gone(pid)


def test_nobody_listens_any_more(modules: list[str]) -> None:
    with closing(messages(_tell_and_sleep, 60, modules=modules)) as inbox:
        pid = next(m for m in inbox if m is not None)
    assert gone(pid)


PARENT = """
from contextlib import closing
from rovercheck.checker.process.isolate import messages
from tests.process import test_isolate
with closing(messages(test_isolate.{work}, 60)) as inbox:
    for message in inbox:
        if message is not None:
            print(message, flush=True)
"""


@pytest.mark.skipif(os.name != "posix", reason="signals")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_the_child_dies_with_its_parent(number: signal.Signals) -> None:
    assert gone(_child_of_one_killed("_tell_and_sleep", number))


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells of the end of a parent")
def test_the_child_dies_with_its_parent_while_no_python_runs_in_it() -> None:
    assert gone(_child_of_one_killed("_tell_and_hold_the_lock", signal.SIGKILL))


def _child_of_one_killed(work: str, number: signal.Signals) -> int:
    path = os.pathsep.join([str(ROOT), *filter(None, sys.path)])
    with subprocess.Popen(
        [sys.executable, "-c", PARENT.format(work=work)],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    ) as parent:
        assert parent.stdout is not None
        pid = int(parent.stdout.readline())
        assert alive(pid)
        parent.send_signal(number)
    return pid
