"""The suites for faults fail where a fault is not killed, and where something is wrong without one."""

from collections.abc import Iterable

import pytest

from tests.faults import PatchSuite


class Blind(PatchSuite):
    """Its comparison sees nothing."""

    FAULTS = (lambda patch: None,)

    def wrong(self) -> Iterable[str]:
        return ()


class Nervous(Blind):
    """Its comparison always sees something."""

    def wrong(self) -> Iterable[str]:
        return ("always",)


def test_a_fault_that_survives_fails_the_suite(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(AssertionError):
        Blind().test_a_fault_is_killed(*Blind.FAULTS, monkeypatch)
    Nervous().test_a_fault_is_killed(*Nervous.FAULTS, monkeypatch)


def test_what_is_wrong_without_a_fault_fails_the_suite() -> None:
    Blind().test_nothing_is_wrong_without_a_fault()
    with pytest.raises(AssertionError):
        Nervous().test_nothing_is_wrong_without_a_fault()
