"""Charts that are written as models of Simulink: what is read of the files does the same, step by step."""

from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.export.slx import simulink_of
from rovercheck.checker.model.drawn import read_simulink
from rovercheck.spec_model.lang.chart import Chart, Enabled, State
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import flag
from rovercheck.spec_model.lang.system import in_order
from tests.export.slx_runs import ROWS, differences, random_system
from tests.profiles import full

SYSTEMS = 120 if full() else 12


@pytest.mark.parametrize("part", range(2))
def test_a_random_system_read_again_does_the_same(tmp_path: Path, part: int) -> None:
    alike = 0
    for seed in range(part, SYSTEMS, 2):
        try:
            assert differences(random_system(seed), tmp_path, seed) == ROWS
            alike += 1
        except ModelError as error:
            assert "enters it again" in str(error)
    assert alike * 10 >= SYSTEMS // 2 * 8


@pytest.mark.parametrize("seed", [3, 5, 7, 12])
def test_a_random_system_written_in_python_again_does_the_same(tmp_path: Path, seed: int) -> None:
    """Out of the charts into a file of Simulink, and out of that into charts again."""
    assert differences(random_system(seed), tmp_path, seed, written=True) == ROWS


def test_an_enabled_subsystem_is_refused_with_its_parts() -> None:
    lamp = Chart("Lamp", [State("Off")], default="Off")
    with pytest.raises(ModelError, match="the subsystem of Lamp executes only while `on`"):
        simulink_of(in_order("Room", Enabled(flag("on"), lamp)))


def test_the_verb_writes_a_model_that_can_be_read(tmp_path: Path) -> None:
    assert run(["export", "--system", "receiver", "--format", "slx", "-o", str(tmp_path)]) == 0
    assert read_simulink(tmp_path / "receiver.slx")["sender_position"] is not None


def test_the_verb_takes_one_system(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["export", "PB1-15", "--format", "slx"]) == 4
    assert "write --system NAME" in capsys.readouterr().err
