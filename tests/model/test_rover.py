"""The list of systems: every one can be lowered, and each has a name of its own."""

import pytest

from rovercheck.spec_model import rover
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.rover import merged, systems
from rovercheck.spec_model.system_table import SystemTable


@pytest.mark.parametrize("name", systems())
def test_every_system_has_a_meaning(name: str) -> None:
    system = systems()[name]
    assert system.name == name
    assert system.text.endswith(".")
    assert lower(system).inputs
    assert not system.concrete or not systems()[system.concrete].over, "a violation must be a real run"


def test_two_systems_of_one_name_are_refused() -> None:
    one = systems()["relay"]
    with pytest.raises(ModelError, match="Two systems are named 'relay'"):
        merged([SystemTable(one), SystemTable(one)])


def test_a_ctrl_c_while_systems_are_read_leaves_none_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    everything, some = set(systems()), rover._Read({})

    def interrupted(module: str) -> object:
        raise KeyboardInterrupt

    with monkeypatch.context() as during, pytest.raises(KeyboardInterrupt):
        during.setattr(rover, "_systems_of", interrupted)
        len(some)
    assert set(some) == everything
