"""Ctrl-C, or being told to end, while the program is still loading."""

import os
import signal
import sys
from collections.abc import Iterator, Sequence
from importlib.machinery import ModuleSpec
from types import ModuleType

import pytest

from rovercheck.__main__ import main
from rovercheck.checker.commands.shared.codes import Exit


class Interrupting:
    """A finder in whose search for the command line a signal comes."""

    def __init__(self, number: int) -> None:
        self._number = number

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if name == "rovercheck.checker.cli":
            os.kill(os.getpid(), self._number)
        return None


@pytest.fixture
def handlers_restored() -> Iterator[None]:
    """The handlers of the process of the tests are as before afterwards."""
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP)}
    for number in before:
        signal.signal(number, signal.SIG_DFL)
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.usefixtures("handlers_restored")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_signal_while_the_program_loads(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """SIGTERM ended it with -15, and nobody was told."""
    monkeypatch.delitem(sys.modules, "rovercheck.checker.cli", raising=False)
    monkeypatch.setattr(sys, "meta_path", [Interrupting(signal.Signals[name]), *sys.meta_path])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == Exit.INTERRUPTED
    assert capsys.readouterr().err == "Interrupted; nothing was written.\n"
