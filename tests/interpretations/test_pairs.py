"""Two interpretations at once: time in the critical range adds up whatever the temperature monitor does."""

import pytest

from rovercheck.spec_model.rover import systems
from tests.interpretations.scenario import Blocks, Given, histories

STALE: Given = {"temp_update": False}


def temp(celsius: int) -> Given:
    return {"temp_reading": celsius}


BY_ESTIMATE: Blocks = [(20, temp(59)), (7000, STALE), (3000, temp(66)), (5000, temp(57)), (2000, temp(66))]
"""Critical by its estimate, 3 s in the critical range before it is released, then again in that range."""

CASES = [
    ({"S04": "CUMULATIVE", "S65": "DEFAULT-OK"}, [(4100, temp(66))], 0, "OK 20 DEG 4000 CRIT"),
    ({"S04": "CUMULATIVE", "S05": "SYMMETRIC"}, BY_ESTIMATE, 400, "DEG 6020 CRIT 14020 DEG 16020 CRIT"),
]


@pytest.mark.parametrize(("choices", "given", "warm_up", "shown"), CASES)
def test_time_adds_up_in_every_step(choices: Given, given: Blocks, warm_up: int, shown: str) -> None:
    system = systems({id: str(choice) for id, choice in choices.items()})["temperature"]
    [status] = histories(system, given, ["temp_status"], warm_up=warm_up)
    assert status.replace("TEMP_HEALTH_", "").replace("CRITICAL", "CRIT").replace("DEGRADED", "DEG") == shown
