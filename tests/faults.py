"""Faults put in on purpose, and the suites which show that each of them is killed.

Whatever is faulty - an engine, a chart, a supervisor - a suite lists its ``FAULTS`` and says what kills one.
"""

from collections.abc import Iterable, Sequence
from typing import Any, ClassVar

import pytest


class FaultSuite:
    """Every fault of ``FAULTS`` is killed."""

    FAULTS: ClassVar[Sequence[Any]]

    def killed(self, fault: Any, patch: pytest.MonkeyPatch) -> bool:
        """Whether what tests for it notices the fault."""
        raise NotImplementedError

    def pytest_generate_tests(self, metafunc: pytest.Metafunc) -> None:
        if "fault" in metafunc.fixturenames:
            metafunc.parametrize("fault", self.FAULTS, ids=lambda f: getattr(f, "__name__", str(f)))

    def test_a_fault_is_killed(self, fault: Any, monkeypatch: pytest.MonkeyPatch) -> None:
        assert self.killed(fault, monkeypatch)


class PatchSuite(FaultSuite):
    """Faults of our own code, as functions that patch it: a comparison with something independent kills them.

    Each is a function of a ``MonkeyPatch``, named for what is wrong then.
    """

    def wrong(self) -> Iterable[str]:
        """What the comparison finds wrong; nothing where there is no fault."""
        raise NotImplementedError

    def killed(self, fault: Any, patch: pytest.MonkeyPatch) -> bool:
        fault(patch)
        return any(self.wrong())

    def test_nothing_is_wrong_without_a_fault(self) -> None:
        assert list(self.wrong()) == []
