"""Settings of the whole test suite: what processes of it find around them, and which tests come first."""

import gc
import os
import signal
import sys
import tempfile
from pathlib import Path

import pytest

from tests.profiles import register

os.environ["ROVERCHECK_CACHE"] = ""  # what is tested is compiled anew
_OURS = tempfile.TemporaryDirectory(prefix="rovercheck-tests-")
os.environ["ROVERCHECK_SECRET"] = str(Path(_OURS.name, "cache-secret"))  # the user's is no business of tests
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
