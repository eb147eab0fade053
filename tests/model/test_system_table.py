"""Systems are built when they are asked for, and what is wrong with one is told where it matters."""

from collections.abc import Iterator

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.model import rover as model
from rovercheck.checker.results.exit_code import Exit
from rovercheck.spec_model import rover
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.system_table import SystemTable

FAULT = "The change of the door does not fit."


def _broken() -> System:
    raise ModelError(FAULT)


def test_a_system_is_built_once_and_no_other_is() -> None:
    built: list[str] = []

    def door() -> System:
        built.append("door")
        return System("door", ())

    table = SystemTable(System("lamp", ()), ("door", door), ("broken", _broken))
    assert list(table) == ["lamp", "door", "broken"]
    assert "door" in table and "broken" in table and "window" not in table and not built
    assert table["door"] is table["door"]
    assert built == ["door"]
    with pytest.raises(ModelError, match=FAULT):
        list(table.values())
    with pytest.raises(KeyError):
        table["window"]


def test_a_name_used_twice_is_refused_before_anything_is_built() -> None:
    with pytest.raises(ModelError, match="Two systems are named 'door'; rename one of them"):
        SystemTable(System("door", ()), ("door", _broken))


def test_a_system_has_the_name_that_it_is_listed_by() -> None:
    table = SystemTable(("door", lambda: System("gate", ())))
    with pytest.raises(ModelError, match="listed as 'door' is named 'gate'"):
        table["door"]


@pytest.fixture
def with_a_fault(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The rover with one system more, which cannot be built."""
    real = rover._systems_of

    def found(module: str) -> SystemTable:
        return SystemTable(("broken", _broken)) if module == "broken" else real(module)

    _forget()
    monkeypatch.setattr(rover, "_systems_of", found)
    monkeypatch.setattr(rover, "BOARDS", (*rover.BOARDS, "broken"))
    yield
    _forget()


def _forget() -> None:
    rover._systems.cache_clear()
    model._rover.cache_clear()


@pytest.mark.usefixtures("with_a_fault")
def test_a_fault_of_a_system_is_told_by_a_check_of_the_whole(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "--no-store"]) is Exit.USAGE
    assert FAULT in capsys.readouterr().err
    assert run(["check", "PB1-11", "--no-store"]) is Exit.AS_EXPECTED
    assert FAULT not in capsys.readouterr().err
