"""Every reading has its scenario: each choice that the charts can show is run, or a test says why not."""

import pytest

from spec_model.readings import Reading, readings
from tests.readings import test_board2, test_links_relay_references, test_monitors

SHOWN = {
    (scenario.reading, choice)
    for module in (test_board2, test_links_relay_references, test_monitors)
    for scenario in module.SCENARIOS
    for choice in scenario.shows
}
ELSEWHERE = {
    "E11": "test_a_stop_of_all_motion_or_of_forward_motion",
    "E12": "test_at_once",
}
"""Readings of properties only, told apart by properties in several forms; ids are those below."""


@pytest.mark.parametrize("one", readings().values(), ids=list(readings()))
def test_every_choice_is_run_in_its_scenario(one: Reading) -> None:
    modelled = {choice for choice in one.choices if choice not in one.not_modelled}
    assert one.default in modelled
    missing = {choice for choice in modelled if (one.id, choice) not in SHOWN}
    assert not missing or one.id in ELSEWHERE or len(modelled) == 1, missing
