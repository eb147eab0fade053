"""What is read of a file is proved to be the same system, and one that is not is found."""

from pathlib import Path

import pytest

from benchmarks.slx_equal import Beside, judged
from benchmarks.slx_verdicts import ReadAgain
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.edit import constant, in_expressions, in_system
from rovercheck.spec_model.rover import systems

SECONDS = 120.0


@pytest.mark.parametrize("name", ["temperature", "relay", "backward"])
def test_what_is_read_of_a_file_is_the_same_system(name: str, tmp_path: Path) -> None:
    """With held conditions, times of states, and what is remembered of edges."""
    system = systems()[name]
    assert judged(Beside(system, ReadAgain(system, tmp_path)), SECONDS) == ("the same", "")


@pytest.mark.parametrize(
    ("name", "part", "limits", "said"),
    [
        ("heartbeat", "Monitor_heartbeat", (120, 140), ("differs", "b2_sup_status differs")),
        ("temperature", "Monitor_temperature", (60, 62), ("not known", "Monitor_temperature.held1")),
    ],
)
def test_a_file_with_another_limit_is_not(
    name: str, part: str, limits: tuple[int, int], said: tuple[str, str], tmp_path: Path
) -> None:
    """A timer of another condition is like none of the file."""
    system = systems()[name]

    def changed(chart: Chart | Block) -> Chart:
        assert isinstance(chart, Chart)
        return in_expressions(chart, constant(*limits))

    again = ReadAgain(in_system(system, part, changed), tmp_path)
    word, why = judged(Beside(system, again), SECONDS)
    assert word == said[0] and said[1] in why
