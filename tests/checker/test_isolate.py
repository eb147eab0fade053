"""Work in a child: messages arrive, and whatever the child does, it comes to an end."""

import os
import signal
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import pytest

from checker.isolate import Send, Stopped, messages
from spec_model.lang.expr import flag
from spec_model.lang.walk import nodes

ROOT = Path(__file__).parents[2]


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


def test_messages_arrive_in_order() -> None:
    assert [m for m in messages(_count, 1000) if m is not None] == list(range(1000))


def test_a_deep_formula_reaches_the_child() -> None:
    expr = flag("a") & flag("b")
    for _ in range(2000):
        expr = ~expr
    assert [m for m in messages(_size, expr) if m is not None] == [2003]


@pytest.mark.parametrize(
    ("work", "reason"),
    [(_fail, "ValueError: no such thing"), (_exit, "the solver process ended with status 3")],
)
def test_a_failure_is_a_reason_and_no_traceback(work: object, reason: str) -> None:
    with pytest.raises(Stopped, match=reason):
        list(messages(work))  # type: ignore[arg-type]


@pytest.mark.skipif(sys.platform != "linux", reason="address space limits")
def test_the_memory_limit() -> None:
    with pytest.raises(Stopped, match="the memory limit is reached"):
        list(messages(_fill, memory=1 << 30))


def test_the_time_limit_kills_and_quiet_seconds_are_told() -> None:
    heard, start = [], time.monotonic()
    with pytest.raises(Stopped, match="time limit of 2 s"):
        for message in messages(_tell_and_sleep, 60, seconds=2, beat=0.2):
            heard.append(message)
    assert time.monotonic() - start < 3
    [pid] = [m for m in heard if m is not None]
    assert None in heard and gone(pid)


def test_nobody_listens_any_more() -> None:
    with closing(messages(_tell_and_sleep, 60)) as inbox:
        pid = next(m for m in inbox if m is not None)
    assert gone(pid)


PARENT = """
from contextlib import closing
from checker.isolate import messages
from tests.checker.test_isolate import _tell_and_sleep
with closing(messages(_tell_and_sleep, 60)) as inbox:
    for message in inbox:
        if message is not None:
            print(message, flush=True)
"""


@pytest.mark.skipif(os.name != "posix", reason="signals")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_the_child_dies_with_its_parent(number: signal.Signals) -> None:
    path = os.pathsep.join([str(ROOT), *filter(None, sys.path)])
    with subprocess.Popen(
        [sys.executable, "-c", PARENT],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    ) as parent:
        assert parent.stdout is not None
        pid = int(parent.stdout.readline())
        assert alive(pid)
        parent.send_signal(number)
    assert gone(pid)
