"""The scenarios that tell the interpretations of temperature, battery and wheels apart (S01 to S33).

Each case is a scenario under one choice; what it shows is the whole history of a status: the values,
each with the ms at which it begins.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache

import pytest

from rovercheck.spec_model.ambiguity import ambiguities
from rovercheck.spec_model.lang.domain import fixed
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems
from tests.interpretations.scenario import Blocks, Given, histories
from tests.interpretations.wider import widened

TENTHS, HUNDREDTHS = fixed(-20, 70, "0.1", "°C"), fixed(-1, 100, "0.01", "%")
WIDE = {
    "temp_reading": TENTHS, "temperature_degC": TENTHS,
    "batt_reading": HUNDREDTHS, "battery_pct": HUNDREDTHS,
}  # fmt: skip
"""The values that the scenarios name; the model has representatives of them."""

WHEELS = ("wheel_status_FL", "wheel_status_FR", "wheel_status_RL", "wheel_status_RR")
MASKS = ("critical_mask", "degraded_mask")
TEMP, BATT, FL = ("temp_status",), ("batt_status",), WHEELS[:1]
ALONE = {"temp_status": "temperature", "batt_status": "battery"}
LEVELS = {
    **{f"{name}_HEALTH_{level}": short for name in ("TEMP", "BATT")
       for level, short in (("OK", "OK"), ("DEGRADED", "DEG"), ("CRITICAL", "CRIT"))},
    "WHEEL_OK": "OK", "WHEEL_DEGRADED_ENCODER": "DEG", "WHEEL_CRITICAL_MOTOR": "CRIT",
}  # fmt: skip


@dataclass(frozen=True)
class Scenario:
    """What is given, what is watched, and what each choice of the interpretation shows.

    It runs on the chart alone where only its status is watched, else, or if said so, on the board.
    """

    interpretation: str
    number: int
    given: Blocks
    watched: Sequence[str]
    shows: Mapping[str, str]
    on: str = ""


def temp(celsius: float) -> Given:
    return {"temp_reading": celsius}


def batt(percent: float) -> Given:
    return {"batt_reading": percent}


def stale_temp(celsius: float, ms: int) -> Blocks:
    """The last valid interpretation at 0, then none."""
    return [(20, temp(celsius)), (ms, {"temp_update": False})]


def stale_batt(percent: float, ms: int) -> Blocks:
    return [(20, batt(percent)), (ms, {"batt_update": False})]


LOST: Given = {"hasNoFeedback_FL": True}
INCONSISTENT: Given = {"frame_isMotionConsistent": False}
BOTH: Given = {**LOST, **INCONSISTENT}
NO_LINK: Given = {"rx_update": False, "heartbeat_update": False}


SCENARIOS = [
    # --- temperature ---
    Scenario("S01", 1, [(3000, temp(70)), (100, temp(25))], TEMP, {
        "HOLD": "OK", "DEG-WHILE-PENDING": "DEG 3000 OK", "OK-DEFAULT": "OK",
        "CRIT-AT-ONCE": "CRIT 3000 OK"}),
    Scenario("S01", 2, [(1000, temp(57)), (3000, temp(70)), (100, temp(25))], TEMP, {
        "HOLD": "DEG 4000 OK", "DEG-WHILE-PENDING": "DEG 4000 OK",
        "OK-DEFAULT": "DEG 1000 OK", "CRIT-AT-ONCE": "DEG 1000 CRIT 4000 OK"}),
    Scenario("S02", 1, [(4020, temp(70)), (100, temp(25))], TEMP, {
        "GE": "DEG 4000 CRIT 4020 OK", "GT-STEP": "DEG 4020 OK", "COUNT": "DEG 3980 CRIT 4020 OK"}),
    Scenario("S03", 1, [(2000, temp(-20)), (2500, temp(70))], TEMP, {
        "UNION": "DEG 4000 CRIT", "PER-SIDE": "DEG"}),
    Scenario("S04", 1, [(3000, temp(70)), (20, temp(59)), (2000, temp(70))], TEMP, {
        "CONTINUOUS": "DEG", "CUMULATIVE": "DEG 4020 CRIT"}),
    Scenario("S05", 1, [(4020, temp(70)), (4100, temp(25))], TEMP, {
        "IMMEDIATE": "DEG 4000 CRIT 4020 OK", "SYMMETRIC": "DEG 4000 CRIT 8020 OK",
        "LATCH": "DEG 4000 CRIT"}),
    Scenario("S05", 2, [(4020, temp(70)), (4100, temp(57))], TEMP, {
        "IMMEDIATE": "DEG 4000 CRIT 4020 DEG", "SYMMETRIC": "DEG 4000 CRIT 8020 DEG",
        "LATCH": "DEG 4000 CRIT"}),
    Scenario("S06", 1, stale_temp(58, 9000), TEMP, {
        "AS-WRITTEN": "DEG 7020 CRIT", "ALL-60": "DEG 2020 CRIT"}),
    Scenario("S07", 1, stale_temp(64, 5000), TEMP, {"TEMP": "DEG 1020 CRIT", "RATE": "DEG 4000 CRIT"}),
    Scenario("S08", 1, stale_temp(64.8, 1000), TEMP, {
        "EQ": "DEG 500 CRIT 520 DEG", "GE": "DEG 500 CRIT", "GT": "DEG 520 CRIT"}),
    Scenario("S09", 1, stale_temp(64.2, 2000), TEMP, {
        "FROM-LAST": "DEG 820 CRIT", "FROM-0.5": "DEG 1320 CRIT"}),
    Scenario("S10", 1, stale_temp(64.9, 5000), TEMP, {
        "INSTANT": "DEG 500 CRIT", "SUSTAINED": "DEG 4000 CRIT"}),
    Scenario("S10", 2, stale_temp(59.9, 10_000), TEMP, {
        "INSTANT": "DEG 5120 CRIT", "SUSTAINED": "DEG 9120 CRIT"}),
    Scenario("S11", 1, stale_temp(50, 16_000), TEMP, {
        "MEASURED": "OK 15020 CRIT", "ESTIMATED": "OK 5000 DEG 14000 CRIT"}),
    Scenario("S12", 1, stale_temp(-16, 12_000), TEMP, {
        "MEASURED": "DEG 4000 CRIT", "ESTIMATED": "DEG 11020 OK"}),
    Scenario("S13", 1, stale_temp(20, 13_000), MASKS, {
        "TABLE2": "0, 0", "TABLE1-CRIT": "0 500 1, 0", "TABLE1-DEG": "0, 0 500 1"}),
    Scenario("S14", 1, stale_temp(64.5, 1000), TEMP, {"GT": "DEG 520 CRIT", "GE": "DEG 500 CRIT"}),
    # --- battery ---
    Scenario("S15", 1, [(6000, {**batt(10), **temp(25)})], BATT, {
        "PCT": "DEG 5000 CRIT", "TEMP": "DEG"}, "board1"),
    Scenario("S15", 2, [(6000, {**batt(80), **temp(10)})], BATT, {
        "PCT": "OK", "TEMP": "OK 5000 CRIT"}, "board1"),
    Scenario("S16", 1, [(6000, {**batt(10), "degraded_row_counts": False})], BATT, {
        "SEVERITY": "DEG 5000 CRIT", "TABLE-ORDER": "DEG", "NONDET": "DEG 5000 CRIT"}),
    Scenario("S16", 2, [(6000, {**batt(10), "degraded_row_counts": True})], BATT, {
        "SEVERITY": "DEG 5000 CRIT", "TABLE-ORDER": "DEG", "NONDET": "DEG"}),
    Scenario("S17", 1, [(100, batt(24))], BATT, {"HOLD": "OK", "OK-DEFAULT": "OK", "DEG-DEFAULT": "DEG"}),
    Scenario("S17", 2, [(100, batt(20)), (100, batt(24))], BATT, {
        "HOLD": "DEG", "OK-DEFAULT": "DEG 100 OK", "DEG-DEFAULT": "DEG"}),
    Scenario("S17", 3, [(5020, batt(10)), (100, batt(24))], BATT, {
        "HOLD": "DEG 5000 CRIT", "OK-DEFAULT": "DEG 5000 CRIT 5020 OK",
        "DEG-DEFAULT": "DEG 5000 CRIT 5020 DEG"}),
    Scenario("S18", 1, [(1000, batt(20)), (100, batt(80))], BATT, {
        "IMMEDIATE": "DEG 1000 OK", "FILTERED": "OK"}),
    Scenario("S19", 1, [(6000, batt(15))], BATT, {
        "AS-WRITTEN": "DEG 5000 CRIT", "UNIFORM-CLOSED": "DEG 5000 CRIT", "UNIFORM-OPEN": "DEG"}),
    Scenario("S19", 2, stale_batt(15.21, 1000), BATT, {  # exactly 15 at 500 ms
        "AS-WRITTEN": "DEG 520 CRIT", "UNIFORM-CLOSED": "DEG 500 CRIT", "UNIFORM-OPEN": "DEG 520 CRIT"}),
    Scenario("S20", 1, [(6000, batt(-1))], BATT, {"LITERAL": "DEG", "CLAMP": "DEG 5000 CRIT"}),
    Scenario("S21", 1, [(5020, batt(10)), (100, batt(80))], BATT, {
        "GE": "DEG 5000 CRIT 5020 OK", "GT-STEP": "DEG 5020 OK", "COUNT": "DEG 4980 CRIT 5020 OK"}),
    Scenario("S22", 1, [(5020, batt(10)), (100, batt(20)), (100, batt(26))], BATT, {
        "IMMEDIATE": "DEG 5000 CRIT 5020 DEG 5120 OK", "HYSTERESIS-25": "DEG 5000 CRIT 5120 OK",
        "LATCH": "DEG 5000 CRIT"}),
    Scenario("S23", 1, stale_batt(24.5, 5000), BATT, {"MEASURED": "OK", "ESTIMATED": "OK 3580 DEG"}),
    Scenario("S24", 1, stale_batt(15.2, 6000), BATT, {
        "FROM-LAST-INSTANT": "DEG 500 CRIT", "FROM-0.5-INSTANT": "DEG 980 CRIT",
        "FROM-LAST-SUSTAINED": "DEG 5500 CRIT"}),
    Scenario("S26", 1, stale_batt(80, 13_000), MASKS, {"TABLE2": "0, 0", "TABLE1": "0, 0 500 2"}),
    # --- wheels ---
    Scenario("S27", 1, [(100, INCONSISTENT)], WHEELS, {
        "HOLD": "OK, OK, OK, OK", "OK": "OK, OK, OK, OK", "DEG": "DEG, DEG, DEG, DEG"}),
    Scenario("S28", 1, [(100, BOTH)], FL, {"CONJ": "CRIT", "SEQ": "DEG 20 CRIT"}),
    Scenario("S29", 1, [(40, BOTH), (100, {})], FL, {"FOLLOW": "CRIT 40 OK", "LATCH": "CRIT"}),
    Scenario("S30", 1, [(40, BOTH), (100, LOST)], FL, {"FOLLOW": "CRIT 40 DEG", "LATCH": "CRIT"}),
    Scenario("S31", 1, [(20, INCONSISTENT), (200, NO_LINK), (100, {**NO_LINK, **LOST})], FL, {
        "LAST-VALUE": "DEG 220 CRIT", "IGNORE": "DEG 140 OK 220 DEG"}),
    Scenario("S32", 1, [(100, {"hasNoFeedback_FL": False})], FL, {
        "TRUE=NO-FEEDBACK": "OK", "TRUE=CORRESPONDENCE": "DEG"}),
    Scenario("S33", 1, [(100, LOST)], MASKS, {"VECTOR": "0, 8", "AGGREGATE": "0, 120"}),
]  # fmt: skip


CASES = [(scenario, choice) for scenario in SCENARIOS for choice in scenario.shows]


@pytest.mark.parametrize(
    ("scenario", "choice"), CASES, ids=[f"{s.interpretation}-{choice}-{s.number}" for s, choice in CASES]
)
def test_a_choice_shows_what_tells_it_apart(scenario: Scenario, choice: str) -> None:
    system = _system(scenario.on or ALONE.get(scenario.watched[0], "board1"), scenario.interpretation, choice)
    found = histories(system, scenario.given, scenario.watched)
    assert ", ".join(_short(history) for history in found) == scenario.shows[choice]


@cache
def _system(name: str, interpretation: str, choice: str) -> System:
    return widened(systems({interpretation: choice})[name], WIDE)


def _short(history: str) -> str:
    return " ".join(LEVELS.get(word, word) for word in history.split())


def test_every_choice_is_shown() -> None:
    mine = [id for id in ambiguities() if id.startswith("S") and int(id[1:]) <= 33]
    shown = {(s.interpretation, choice) for s in SCENARIOS for choice in s.shows}
    modelled = {
        (id, c) for id in mine for c in ambiguities()[id].choices if c not in ambiguities()[id].not_modelled
    }
    assert modelled - shown == {("S25", "PCT")}, "S25 has one choice that can be modelled"


def test_volts_have_no_limit() -> None:
    with pytest.raises(ModelError, match="no limit in volts"):
        systems({"S25": "VOLT"})
