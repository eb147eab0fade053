"""What is read of a file is proved to be the same system, and one that is not is found."""

from collections.abc import Callable
from pathlib import Path

import pytest

from benchmarks.slx_equal import Beside, Likely, by_correspondence, by_induction, judged
from benchmarks.slx_verdicts import ReadAgain
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.edit import constant, in_expressions, in_system
from rovercheck.spec_model.rover import systems
from tests.export.outside import needs_abc

SECONDS = 120.0


@pytest.mark.parametrize("name", ["temperature", "relay", "backward"])
def test_what_is_read_of_a_file_is_the_same_system(name: str, tmp_path: Path) -> None:
    """With held conditions, times of states, and what is remembered of edges."""
    system = systems()[name]
    beside = Beside(system, ReadAgain(system, tmp_path))
    assert by_induction(beside, SECONDS) == ("the same", "k-induction")


@needs_abc
@pytest.mark.parametrize("name", ["temperature", "masks", "board1"])
def test_abc_proves_it_of_many_charts_at_once(name: str, tmp_path: Path) -> None:
    """All of Board 1 takes k-induction minutes."""
    system = systems()[name]
    beside = Beside(system, ReadAgain(system, tmp_path))
    assert judged(beside, tmp_path, SECONDS) == ("the same", "ABC")


@pytest.mark.parametrize(
    ("hidden", "found"),
    [
        ("Motion_2.Stop.In.duration1", "Motion_2_duration1"),
        ("Motion_2.Stop.In.after", "Safety_to_Motion_2.Motion_2.Stop.In.steps"),
        ("Motion.Stop.In.duration1", "Motion_duration1"),
        ("Relay.On.duration1", "Battery_to_Relay.Relay.On.held 1"),
        ("Relay.held1", "Relay_held1"),
        ("Motion.rising2", "Motion_was3"),
    ],
)
def test_names_tell_variables_that_no_run_tells_apart(hidden: str, found: str) -> None:
    """Of a state that no run enters each variable may be the timer: 12 systems were not known."""
    of_file = [
        "Safety_to_Motion_2.Motion_2.Stop.In.steps", "Safety_to_Motion.Motion.Stop.In.steps",
        "Motion_2_duration1", "Motion_duration1", "Battery_to_Relay.Relay.On.held 1", "Relay_held1",
        "Motion_was3", "Relay_was1",
    ]  # fmt: skip
    assert min(of_file, key=Likely(hidden).order) == found


@needs_abc
def test_abc_does_not_prove_it_of_another_limit(tmp_path: Path) -> None:
    system = systems()["heartbeat"]
    again = ReadAgain(in_system(system, "Monitor_heartbeat", _limit(120, 140)), tmp_path)
    assert not by_correspondence(*Beside(system, again).differing(), tmp_path, SECONDS)


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
    again = ReadAgain(in_system(system, part, _limit(*limits)), tmp_path)
    word, why = judged(Beside(system, again), tmp_path, SECONDS)
    assert word == said[0] and said[1] in why


def _limit(old: int, new: int) -> Callable[[Chart | Block], Chart]:
    def changed(chart: Chart | Block) -> Chart:
        assert isinstance(chart, Chart)
        return in_expressions(chart, constant(old, new))

    return changed
