"""Every interpretation has its scenario: each choice that charts can show is run, or a test says why not."""

import pytest

from rovercheck.spec_model.ambiguity import Ambiguity, ambiguities
from tests.interpretations import test_board2, test_links_relay_references, test_monitors

SHOWN = {
    (scenario.interpretation, choice)
    for module in (test_board2, test_links_relay_references, test_monitors)
    for scenario in module.SCENARIOS
    for choice in scenario.shows
}
ELSEWHERE = {
    "E11": test_board2.test_E11_the_rover_turns_on_beside_an_obstacle,
    "E12": test_board2.test_E12_the_stop_comes_in_the_next_step,
}
"""Interpretations of properties only, told apart by properties in several forms."""


def shown(one: Ambiguity) -> set[str]:
    """The choices of an interpretation that some test runs."""
    marks = getattr(ELSEWHERE.get(one.id), "pytestmark", [])
    by_properties = {str(case[0]) for mark in marks for case in mark.args[1]}
    return by_properties | {choice for interpretation, choice in SHOWN if interpretation == one.id}


@pytest.mark.parametrize("one", ambiguities().values(), ids=list(ambiguities()))
def test_every_choice_is_run_in_its_scenario(one: Ambiguity) -> None:
    modelled = {choice for choice in one.choices if choice not in one.not_modelled}
    assert one.default in modelled
    assert modelled <= shown(one) or modelled == {one.default}, (
        "a reading with one choice tells nothing apart"
    )
