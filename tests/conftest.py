"""Settings of the whole test suite: what processes of it find around them, and which tests come first."""

import gc
import os
import signal
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.profiles import register

os.environ["ROVERCHECK_CACHE"] = ""  # what is tested is compiled anew, except below `compiled_once`
if "PYTEST_XDIST_WORKER" not in os.environ:  # the processes of one suite share a folder; its first makes it
    _OURS = tempfile.TemporaryDirectory(prefix="rovercheck-tests-")
    os.environ["ROVERCHECK_TESTS_FOLDER"] = _OURS.name
_FOLDER = Path(os.environ["ROVERCHECK_TESTS_FOLDER"])
os.environ["ROVERCHECK_SECRET"] = str(_FOLDER / "cache-secret")  # the user's is no business of tests
# The command is found by its name, as in an environment that is activated: so it is called in what is shown.
os.environ["PATH"] = os.pathsep.join((str(Path(sys.executable).parent), os.environ.get("PATH", "")))

# Hundreds of processes load what is tested: its modules are compiled by the first of them, for all.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

for name in ("SIGINT", "SIGHUP"):  # a job in the background ignores them, and so would all that it starts
    number = getattr(signal, name, None)
    if number is not None and signal.getsignal(number) is signal.SIG_IGN:
        signal.signal(number, signal.default_int_handler if name == "SIGINT" else signal.SIG_DFL)

register()

gc.disable()  # while tests are collected: what that makes stays until the end


def pytest_collection_finish() -> None:
    """Collect garbage again, but never look through what is there by now."""
    gc.freeze()
    gc.enable()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Long tests first: one that begins late keeps the other processes waiting."""
    items.sort(key=lambda item: item.get_closest_marker("long") is None)


@pytest.fixture(scope="module")
def compiled_once() -> Iterator[None]:
    """Code of the same search is compiled once in the whole suite, and no verdict is kept.

    For tests of what commands do with answers.  Not where code is compiled with a fault on purpose: the key
    of an entry speaks of sources, so that other tests would get the faulty code.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROVERCHECK_CACHE", str(_FOLDER / "compiled"))
        patch.setenv("ROVERCHECK_STORE", "")
        yield


@pytest.fixture(scope="session")
def cc() -> str:
    """The C compiler; tests that need one are skipped, visibly, where there is none."""
    from rovercheck.checker.adapters.c_build import compiler

    found = compiler()
    if found is None:
        pytest.skip("there is no C compiler on this machine (cc, gcc, clang)")
    return found


@pytest.fixture(scope="module")
def solver_in_this_process() -> Iterator[None]:
    """The certifier's solver without a child process, for many small questions."""
    from tests.certifying import solving_here

    with solving_here():
        yield


@pytest.fixture(scope="module")
def engines_in_this_process() -> Iterator[None]:
    """Every engine without a child process, and the certifier's solver too."""
    from tests.engine_children import engines_here

    with engines_here():
        yield


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """One headless Chromium for all tests: a process can drive no second one meanwhile."""
    from playwright.sync_api import sync_playwright

    from tests.chromium import FLAGS, chromium

    program = chromium()
    if program is None:
        pytest.skip("No Chromium is installed: apt-get install chromium, or name one in $CHROMIUM.")
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=program, args=list(FLAGS))
        yield started
        started.close()
