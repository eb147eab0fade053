"""Work in copies of this process: results, errors, copies that die, and the end of all of them."""

import subprocess
import sys
from functools import partial

import pytest

from rovercheck.checker.process.beside import beside

COPIED = """
import os, signal, sys, time
from functools import partial
from rovercheck.checker.process.beside import beside

BIG = "x" * 3_000_000
parent = os.getpid()

def work(number):
    if number == 2 and os.getpid() != parent:
        os.kill(os.getpid(), signal.SIGKILL)
    return number, os.getpid() == parent, BIG

found = dict(beside([partial(work, n) for n in range(5)], 2))
assert sorted(found) == [0, 1, 2, 3, 4]
assert [found[n][0] for n in range(5)] == [0, 1, 2, 3, 4]
assert [found[n][1] for n in range(5)] == [False, False, True, False, False]
assert all(found[n][2] == BIG for n in range(5))

begun = time.monotonic()
copies = beside([partial(time.sleep, s) for s in (0, 300, 300)], 3)
assert next(copies) == (0, None)
copies.close()
assert time.monotonic() - begun < 60
try:
    os.waitpid(-1, os.WNOHANG)
except ChildProcessError:
    print("no copy is left")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nothing is copied")
def test_copies_work_and_what_one_does_not_end_is_done_here() -> None:
    """In a process of its own: one with several threads is not copied."""
    done = subprocess.run(
        [sys.executable, "-c", COPIED], capture_output=True, text=True, timeout=120, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "no copy is left\n", "")


@pytest.mark.parametrize("at_once", [1, 4])
def test_an_error_is_raised_here(at_once: int) -> None:
    with pytest.raises(ZeroDivisionError):
        list(beside([partial(divmod, 1, 1), partial(divmod, 1, 0)], at_once))


def test_one_work_is_done_here() -> None:
    assert list(beside([partial(divmod, 7, 2)], 8)) == [(0, (3, 1))]
    assert not list(beside([], 8))
