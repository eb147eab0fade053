"""Every reading has its scenario: each choice that the charts can show is run, or a test says why not."""

import pytest

from rovercheck.spec_model.readings import Reading, readings
from tests.readings import test_board2, test_links_relay_references, test_monitors

SHOWN = {
    (scenario.reading, choice)
    for module in (test_board2, test_links_relay_references, test_monitors)
    for scenario in module.SCENARIOS
    for choice in scenario.shows
}
ELSEWHERE = {
    "E11": test_board2.test_E11_the_rover_turns_on_beside_an_obstacle,
    "E12": test_board2.test_E12_the_stop_comes_in_the_next_step,
}
"""Readings of properties only, told apart by properties in several forms."""


def shown(one: Reading) -> set[str]:
    """The choices of a reading that some test runs."""
    marks = getattr(ELSEWHERE.get(one.id), "pytestmark", [])
    by_properties = {str(case[0]) for mark in marks for case in mark.args[1]}
    return by_properties | {choice for reading, choice in SHOWN if reading == one.id}


@pytest.mark.parametrize("one", readings().values(), ids=list(readings()))
def test_every_choice_is_run_in_its_scenario(one: Reading) -> None:
    modelled = {choice for choice in one.choices if choice not in one.not_modelled}
    assert one.default in modelled
    assert modelled <= shown(one) or modelled == {one.default}, (
        "a reading with one choice tells nothing apart"
    )
